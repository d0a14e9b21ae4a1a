// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/contacts.h"

#include <algorithm>

namespace parley::sim {
namespace {

Box boxOf(const Body& body, const Pose2& pose) { return boxAt(pose, body.length, body.width); }

}  // namespace

bool touchesSolid(const World& world, const std::vector<Box>& doors, const Box& box) {
  return world.overlapsSolid(box) ||
         std::any_of(doors.begin(), doors.end(), [&box](const Box& door) { return overlap(door, box); });
}

bool isStopped(const World& world, const Snapshot& snapshot, std::size_t self, const Box& box) {
  if (touchesSolid(world, snapshot.doors, box)) return true;
  for (std::size_t other = 0; other < snapshot.bodies.size(); ++other) {
    const Body& body = snapshot.bodies[other];
    if (other == self || !body.present) continue;
    const double reach = 0.5 * std::hypot(body.length, body.width) + box.circumradius();
    if ((body.state.pose.position() - box.center).squaredNorm() > reach * reach) continue;
    if (overlap(body.box(), box)) return true;
  }
  return false;
}

double clearance(const World& world, const Snapshot& snapshot, std::size_t self, double limit) {
  const Box box = snapshot.bodies[self].box();
  double nearest = world.distanceToSolid(box, limit);
  const auto isFar = [&box, &nearest](const Eigen::Vector2d& center, double radius) {
    return (center - box.center).norm() - radius - box.circumradius() >= nearest;
  };
  for (const Box& door : snapshot.doors) nearest = std::min(nearest, distance(door, box));
  for (std::size_t other = 0; other < snapshot.bodies.size(); ++other) {
    const Body& body = snapshot.bodies[other];
    if (other == self || !body.present || isFar(body.state.pose.position(), body.length + body.width)) continue;
    nearest = std::min(nearest, distance(body.box(), box));
  }
  for (const Disc& disc : snapshot.discs) {
    if (!isFar(disc.center, disc.radius)) nearest = std::min(nearest, distance(box, disc));
  }
  return nearest;
}

BodyState drivenUntilContact(const World& world, const Snapshot& snapshot, std::size_t self, const Twist2& command,
                             const MotionLimits& limits, double dt) {
  const Body& body = snapshot.bodies[self];
  const BodyState wanted = driven(body.state, command, limits, dt);
  if (!isStopped(world, snapshot, self, boxOf(body, wanted.pose))) return wanted;
  if (wanted.pose == body.state.pose || isStopped(world, snapshot, self, body.box())) return {body.state.pose, {}};
  // halve the step until the contact is found to some micrometres; the body ends just in it
  double free = 0.0, touching = 1.0;
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (free + touching);
    const bool stopped = isStopped(world, snapshot, self, boxOf(body, interpolate(body.state.pose, wanted.pose, middle)));
    (stopped ? touching : free) = middle;
  }
  return {interpolate(body.state.pose, wanted.pose, touching), {}};
}

}  // namespace parley::sim

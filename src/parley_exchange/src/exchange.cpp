// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/exchange.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "body_codec.h"
#include "checks.h"
#include "exchange_core.h"
#include "section_codec.h"

namespace parley {
namespace {

constexpr std::uint32_t kKeyframes = 8;         // [-] that are kept, enough for two encounters
constexpr std::size_t kMaxTrajectory = 100000;  // [-] points

template <class Options>
void collect(const Options& options, const std::string& source, std::vector<std::string>& problems) {
  const std::vector<std::string> more = checkOptions(options, source);
  problems.insert(problems.end(), more.begin(), more.end());
}

/// Throws with all problems.
void check(const ExchangeOptions& options, const ExchangeIdentity& identity) {
  std::vector<std::string> problems;
  if (!isName(identity.name)) {
    problems.push_back("exchange: name: '" + identity.name + "' must be 1 to 24 printable characters without blanks");
  }
  collect(options, "exchange", problems);
  collect(identity.footprint, "exchange: footprint", problems);
  collect(identity.limits, "exchange: limits", problems);
  if (options.beacon_rate_max < options.beacon_rate_min)
    problems.emplace_back("exchange: beacon_rate_max: below beacon_rate_min");
  if (options.trajectory_rate_max < options.trajectory_rate_min) {
    problems.emplace_back("exchange: trajectory_rate_max: below trajectory_rate_min");
  }
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
}

bool isMotion(const Odometry& odometry) {
  return isPlace(odometry.pose) && std::isfinite(odometry.stamp) && std::isfinite(odometry.twist.speed) &&
         std::isfinite(odometry.twist.turn_rate);
}

}  // namespace

Exchange::Exchange(const ExchangeOptions& options, const ExchangeIdentity& identity) {
  check(options, identity);
  core_ = std::make_unique<Core>(options, identity);
}
Exchange::~Exchange() = default;
Exchange::Exchange(Exchange&&) noexcept = default;
Exchange& Exchange::operator=(Exchange&&) noexcept = default;

bool Exchange::setOdometry(const Odometry& odometry, DriveState state) {
  if (!isMotion(odometry)) {
    ++core_->counters.inputs_refused;
    return false;
  }
  core_->odometry = odometry;
  core_->state = state;
  core_->map.drive(odometry.pose, odometry.stamp);
  return true;
}

bool Exchange::setTrajectory(const SampledTrajectory& trajectory, DriveState state) {
  const auto& points = trajectory.points();
  const bool usable = points.size() <= kMaxTrajectory &&
                      std::all_of(points.begin(), points.end(),
                                  [](const TrajectoryPoint& point) { return isPlace(point.pose) && std::isfinite(point.time); });
  if (!usable) {
    ++core_->counters.inputs_refused;
    return false;
  }
  core_->pace.setTrajectory(trajectory);
  core_->trajectory_state = state;
  return true;
}

bool Exchange::setIntent(const IntentMessage& intent) {
  const Plausibility plausible{core_->options.max_speed, core_->options.max_turn_rate};
  if (!plausible.holds(intent)) {
    ++core_->counters.inputs_refused;
    return false;
  }
  core_->pace.intentIs(intent);
  core_->intent = intent;
  return true;
}

bool Exchange::setConflicts(const std::vector<Conflict>& conflicts) {
  const Plausibility plausible{core_->options.max_speed, core_->options.max_turn_rate};
  const bool usable = conflicts.size() <= kMaxConflicts &&
                      std::all_of(conflicts.begin(), conflicts.end(), [&](const Conflict& c) { return plausible.holds(c); });
  if (!usable) {
    ++core_->counters.inputs_refused;
    return false;
  }
  core_->pace.setConflicts(conflicts);
  return true;
}

bool Exchange::setObservations(const std::vector<ObservationMessage>& scans, double now) {
  const Plausibility plausible{core_->options.max_speed, core_->options.max_turn_rate};
  const bool usable = std::isfinite(now) && std::all_of(scans.begin(), scans.end(),
                                                        [&](const ObservationMessage& scan) { return plausible.holds(scan); });
  if (!usable) {
    ++core_->counters.inputs_refused;
    return false;
  }
  core_->scans = scans;
  core_->scans_at = now;
  return true;
}

std::optional<std::uint32_t> Exchange::publishKeyframe(const Bytes& descriptor, const Pose2& T_odom_base, double stamp,
                                                       double now) {
  if (descriptor.size() > kMaxDescriptor || !isPlace(T_odom_base) || !std::isfinite(stamp)) {
    ++core_->counters.inputs_refused;
    return std::nullopt;
  }
  // Their sequence numbers count them; the record's id is their place in the ring.
  const Log* log = core_->keyframe_log.log();
  const std::uint32_t count = log == nullptr || log->records.empty() ? 0 : log->records.rbegin()->first;
  return core_->keyframe_log.write(RecordKind::kKeyframe, count % kKeyframes,
                                   encode(KeyframeBody{ticksOf(stamp), T_odom_base, descriptor}), now);
}

void Exchange::publishContours(const std::vector<OwnContour>& contours, double now) { core_->publishContours(contours, now); }

bool Exchange::setPeerPose(RobotId peer, const PeerPose& pose, double now) {
  const bool usable = core_->setPeerPose(peer, pose, now);
  if (!usable) ++core_->counters.inputs_refused;
  return usable;
}

bool Exchange::contest(const ContourName& contour, double now) { return core_->contest(contour, now); }

bool Exchange::moveAnchor(std::uint32_t id, const Pose2& T_odom_anchor, double now) {
  const bool usable = core_->map.moveAnchor(id, T_odom_anchor, now);
  if (!usable) ++core_->counters.inputs_refused;
  return usable;
}

void Exchange::addPacket(const Bytes& datagram, double now) { core_->addPacket(datagram, now); }
ExchangeOutput Exchange::step(double now) { return core_->step(now); }

RobotId Exchange::id() const { return core_->self; }
const ExchangeCounters& Exchange::counters() const { return core_->counters; }
std::size_t Exchange::storedBytes() const { return core_->store.totalBytes(); }

}  // namespace parley

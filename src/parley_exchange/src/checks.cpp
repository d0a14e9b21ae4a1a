// SPDX-License-Identifier: BSD-3-Clause
#include "checks.h"

#include <algorithm>
#include <cmath>

#include "body_codec.h"
#include "quantity.h"
#include "section_codec.h"

namespace parley {
namespace {

constexpr double kRoundedPosition = 0.03;  // [m] a step on the air can be longer by this than it was
constexpr double kRoundedYaw = 0.004;      // [rad] the same for a turn

using Vertex = Eigen::Matrix<std::int64_t, 2, 1>;

std::int64_t side(const Vertex& a, const Vertex& b, const Vertex& p) {
  const std::int64_t area = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool between(const Vertex& a, const Vertex& b, const Vertex& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

/// Exact, touching counts.
bool touch(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  const std::int64_t abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// Two segments that share b: the second folds back onto the first.
bool foldsBack(const Vertex& a, const Vertex& b, const Vertex& c) { return side(a, b, c) == 0 && (a - b).dot(c - b) > 0; }

}  // namespace

bool isPlace(const Eigen::Vector2d& position) { return position.allFinite() && position.cwiseAbs().maxCoeff() <= kPositionLimit; }

bool isPlace(const Pose2& pose) { return pose.isFinite() && isPlace(pose.position()); }

bool isOutline(const std::vector<Eigen::Vector2i>& vertices, bool closed) {
  const std::size_t n = vertices.size(), segments = closed ? n : n - 1;
  if (n < (closed ? 3U : 2U)) return false;
  std::vector<Vertex> points;
  points.reserve(n);
  for (const Eigen::Vector2i& vertex : vertices) points.push_back(vertex.cast<std::int64_t>());
  for (std::size_t i = 0; i < segments; ++i) {
    const Vertex &a = points[i], &b = points[(i + 1) % n];
    if (a == b) return false;
    const bool has_next = closed || i + 1 < segments;
    if (has_next && foldsBack(a, b, points[(i + 2) % n])) return false;
    for (std::size_t j = i + 2; j < segments; ++j) {
      if (closed && i == 0 && j == n - 1) continue;
      if (touch(a, b, points[j], points[(j + 1) % n])) return false;
    }
  }
  return true;
}

bool Plausibility::holds(const Beacon& beacon) const {
  const Footprint& footprint = beacon.footprint;
  const MotionLimits& limits = beacon.limits;
  const bool sane = footprint.length > 0.0 && footprint.width > 0.0 && limits.speed > 0.0 && limits.speed <= max_speed &&
                    limits.turn_rate > 0.0 && limits.turn_rate <= max_turn_rate && limits.acceleration > 0.0 &&
                    limits.turn_acceleration > 0.0;
  return sane && isName(beacon.name) && isPlace(beacon.pose) && std::abs(beacon.twist.speed) <= max_speed &&
         std::abs(beacon.twist.turn_rate) <= max_turn_rate;
}

bool Plausibility::holds(const TrajectoryMessage& trajectory) const {
  const double farthest = max_speed * trajectory.step + kRoundedPosition;
  const double widest = max_turn_rate * trajectory.step + kRoundedYaw;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    const Pose2& pose = trajectory.poses[i];
    if (!isPlace(pose)) return false;
    if (i == 0) continue;
    const Pose2& before = trajectory.poses[i - 1];
    if ((pose.position() - before.position()).norm() > farthest) return false;
    if (std::abs(angleBetween(before.yaw, pose.yaw)) > widest) return false;
  }
  return !trajectory.poses.empty() && trajectory.step > 0.0 && std::isfinite(trajectory.start);
}

bool Plausibility::holds(const IntentMessage& intent) const {
  return intent.priority >= 0.0 && std::isfinite(intent.priority) && intent.depth >= 0 && intent.depth <= kMaxDepth &&
         !intent.way.empty() && intent.way.size() <= kMaxWay &&
         std::all_of(intent.way.begin(), intent.way.end(), [](const Eigen::Vector2d& corner) { return isPlace(corner); });
}

bool Plausibility::holds(const Conflict& conflict) const {
  return conflict.cost >= 0.0 && conflict.lease >= 0.0 && (!conflict.place || isPlace(*conflict.place));
}

bool Plausibility::holds(const ObservationMessage& observations) const {
  return isPlace(observations.pose) && observations.age >= 0.0 &&
         std::all_of(observations.blobs.begin(), observations.blobs.end(), [](const Observation& blob) {
           return blob.range > 0.0 && blob.chord >= 0.0 && std::isfinite(blob.range + blob.bearing + blob.chord);
         });
}

bool Plausibility::holds(const ContourBody& contour) const {
  return contour.vertices.size() <= kMaxVertices && isOutline(contour.vertices, contour.closed) &&
         (contour.closed || !contour.hole);
}

bool Plausibility::holds(const AnchorBody& anchor) const {
  return isPlace(anchor.pose) && anchor.position_sigma > 0.0 && anchor.yaw_sigma > 0.0;
}

bool Plausibility::holds(const EdgeBody& edge) const {
  return isPlace(edge.T_anchor_peer.pose) && isCovariance(edge.T_anchor_peer.covariance);
}

bool Plausibility::holds(const Record& record) const {
  if (record.removed) return record.body.empty();
  if (record.body.size() > kMaxBody) return false;
  switch (record.kind) {
    case RecordKind::kContour: {
      const auto body = decodeContour(record.body);
      return body && holds(*body);
    }
    case RecordKind::kAnchor: {
      const auto body = decodeAnchor(record.body);
      return body && holds(*body);
    }
    case RecordKind::kEdge: {
      const auto body = decodeEdge(record.body);
      return body && holds(*body);
    }
    case RecordKind::kContest:
    case RecordKind::kEndorsement:
      return decodeReference(record.body).has_value();
    case RecordKind::kKeyframe: {
      const auto body = decodeKeyframe(record.body);
      return body && isPlace(body->pose);
    }
  }
  return true;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "peer_outlines.h"

#include <algorithm>
#include <cmath>

#include "body_codec.h"
#include "outline.h"

namespace parley {
namespace {

constexpr double kMaxSigma = 0.15;       // [m] what is less certain stands for nothing
constexpr double kSampleSpacing = 0.25;  // [m]

/// Standard deviation in the worst direction. [m]
double worstSigma(const Eigen::Matrix2d& covariance) {
  const double spread = std::hypot(0.5 * (covariance(0, 0) - covariance(1, 1)), covariance(0, 1));
  return std::sqrt(std::max(0.0, 0.5 * covariance.trace() + spread));
}

}  // namespace

void PeerOutlines::update(const std::map<RobotId, PeerPose>& poses, const RecordStore& store, const References& references,
                          const std::map<RobotId, int>& revisions) {
  for (auto layer = layers_.begin(); layer != layers_.end();) {
    const auto pose = poses.find(layer->first);
    const bool stays = pose != poses.end() && pose->second.state == EdgeState::kConfirmed;
    layer = stays ? std::next(layer) : layers_.erase(layer);
  }
  for (const auto& pose : poses) {
    const Log* log = store.find({pose.first, RecordStream::kMap});
    if (log == nullptr || pose.second.state != EdgeState::kConfirmed) continue;
    Layer& layer = layers_[pose.first];
    const PoseEstimate& now = pose.second.T_odom_peer;
    const int revision = revisions.at(pose.first);
    const bool same_pose = layer.T_odom_peer.pose == now.pose && layer.T_odom_peer.covariance == now.covariance;
    if (layer.revision == revision && layer.epoch == log->epoch && same_pose) continue;
    layer.revision = revision;
    layer.epoch = log->epoch;
    layer.T_odom_peer = now;
    draw(layer, pose.first, *log, references);
  }
}

void PeerOutlines::draw(Layer& layer, RobotId peer, const Log& log, const References& references) const {
  layer.outlines.clear();
  for (const auto& stored : log.records) {
    const Record& record = stored.second.record;
    if (record.kind != RecordKind::kContour || record.removed) continue;
    const ContourName name{peer, record.id, record.sequence};
    const auto contour = decodeContour(record.body);
    const StoredRecord* anchor = contour ? log.find(RecordKind::kAnchor, contour->anchor) : nullptr;
    if (anchor == nullptr || anchor->record.removed || references.contestOf(name)) continue;
    const Pose2 T_peer_anchor = decodeAnchor(anchor->record.body)->pose;
    const double sigma = worstSigma(pointCovariance(layer.T_odom_peer, T_peer_anchor.position()));
    if (!(sigma <= kMaxSigma)) continue;
    Outline outline{name, transformed(layer.T_odom_peer.pose * T_peer_anchor, polygonOf(*contour)), contour->closed, {}, {}, 0.0};
    outline.tolerance = distance_ + 2.0 * sigma;
    outline.low = outline.high = outline.polygon.front();
    for (const Eigen::Vector2d& point : outline.polygon) {
      outline.low = outline.low.cwiseMin(point);
      outline.high = outline.high.cwiseMax(point);
    }
    layer.outlines.push_back(std::move(outline));
  }
}

const PeerOutlines::Outline* PeerOutlines::near(const Layer& layer, const Eigen::Vector2d& point) const {
  for (const Outline& outline : layer.outlines) {
    const bool in_box = ((point - outline.low).array() >= -outline.tolerance).all() &&
                        ((point - outline.high).array() <= outline.tolerance).all();
    if (in_box && distanceTo(outline.polygon, outline.closed, point) <= outline.tolerance) return &outline;
  }
  return nullptr;
}

std::vector<ContourName> PeerOutlines::covering(const Polygon& polygon, bool closed) const {
  const std::vector<Eigen::Vector2d> samples = samplesOf(polygon, closed, kSampleSpacing);
  for (const auto& layer : layers_) {
    std::vector<ContourName> names;
    const bool all = std::all_of(samples.begin(), samples.end(), [&](const Eigen::Vector2d& sample) {
      const Outline* outline = near(layer.second, sample);
      if (outline != nullptr && std::find(names.begin(), names.end(), outline->name) == names.end())
        names.push_back(outline->name);
      return outline != nullptr;
    });
    if (all) return names;
  }
  return {};
}

std::uint32_t PeerOutlines::epochOf(RobotId origin) const { return layers_.at(origin).epoch; }

}  // namespace parley

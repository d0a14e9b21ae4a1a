// SPDX-License-Identifier: BSD-3-Clause
#include "own_map.h"

#include <algorithm>
#include <limits>
#include <set>

#include "body_codec.h"
#include "checks.h"
#include "outline.h"

namespace parley {
namespace {

bool isUsable(const OwnContour& contour) {
  return contour.polygon.size() >= (contour.closed ? 3U : 2U) && contour.polygon.size() <= 4096 &&
         std::all_of(contour.polygon.begin(), contour.polygon.end(), [](const Eigen::Vector2d& p) { return isPlace(p); });
}

/// Longer side of its upright box. [m]
double extentOf(const Polygon& polygon) {
  Eigen::Vector2d low = polygon.front(), high = polygon.front();
  for (const Eigen::Vector2d& p : polygon) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

}  // namespace

void OwnMap::drive(const Pose2& T_odom_base, double now) {
  const auto current = anchors_.find(current_anchor_);
  const double distance = current == anchors_.end() ? 0.0 : (current->second.position() - T_odom_base.position()).norm();
  if (current != anchors_.end() && distance < options_.anchor_distance) return;
  // Where the robot has been before there is an anchor already.
  for (const auto& anchor : anchors_) {
    if ((anchor.second.position() - T_odom_base.position()).norm() > 0.5 * options_.anchor_distance) continue;
    current_anchor_ = anchor.first;
    return;
  }
  const std::uint32_t id = log_.freeId(RecordKind::kAnchor);
  writeAnchor(id, T_odom_base, distance, now);
}

void OwnMap::writeAnchor(std::uint32_t id, const Pose2& pose, double distance, double now) {
  AnchorBody body{pose, std::max(1e-3, options_.drift * distance), std::max(1e-4, options_.yaw_drift * distance)};
  const Bytes bytes = encode(body);
  const Bytes* before = log_.body(RecordKind::kAnchor, id);
  if (before != nullptr && *before == bytes) return;
  if (!log_.write(RecordKind::kAnchor, id, bytes, now)) return;
  // What peers have is what counts: contours are placed relative to it.
  anchors_[id] = decodeAnchor(bytes)->pose;
  anchor_steps_[id] = distance;
  if (before == nullptr) current_anchor_ = id;
}

bool OwnMap::moveAnchor(std::uint32_t id, const Pose2& T_odom_anchor, double now) {
  if (anchors_.count(id) == 0 || !isPlace(T_odom_anchor)) return false;
  writeAnchor(id, T_odom_anchor, anchor_steps_[id], now);
  for (auto& entry : contours_) entry.second.settled = false;
  return true;
}

std::optional<std::uint32_t> OwnMap::nearestAnchor(const Eigen::Vector2d& p_odom) const {
  std::optional<std::uint32_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& anchor : anchors_) {
    const double distance = (anchor.second.position() - p_odom).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = anchor.first;
  }
  return nearest;
}

int OwnMap::publish(const std::vector<OwnContour>& contours, const PeerOutlines& outlines, References& references, double now) {
  int refused = 0;
  std::set<std::int64_t> present;
  for (const OwnContour& contour : contours) {
    const auto known = contours_.find(contour.key);
    const bool full = known == contours_.end() && contours_.size() >= static_cast<std::size_t>(options_.max_records);
    if (full || !isUsable(contour)) {
      ++refused;
      continue;
    }
    if (extentOf(contour.polygon) < options_.contour_extent) continue;
    present.insert(contour.key);
    const auto [entry, is_new] = contours_.try_emplace(contour.key);
    Published& published = entry->second;
    if (is_new) published.appeared_at = now;
    published.missing_since = -1.0;
    const bool same = contour.polygon == published.given.polygon && contour.closed == published.given.closed &&
                      contour.hole == published.given.hole;
    published.settled = published.settled && same;
    if (!same) published.changed_at = now;
    const bool accepted = update(published, contour, outlines, references, now);
    published.given = contour;
    if (!accepted) ++refused;
  }
  withdrawMissing(present, now);
  return refused;
}

/// At once and then once an interval, but not while it changes, as all does that a robot drives past: for up to two intervals.
bool OwnMap::isDue(const Published& published, double now) const {
  const bool is_first = published.looked_at < published.appeared_at;
  const double since = now - (is_first ? published.appeared_at : published.looked_at);
  if (!is_first && since < options_.contour_interval) return false;
  return now - published.changed_at >= options_.contour_settle || since >= 2.0 * options_.contour_interval;
}

bool OwnMap::update(Published& published, const OwnContour& contour, const PeerOutlines& outlines, References& references,
                    double now) {
  if (!isDue(published, now)) return true;
  if (published.ids.empty()) {
    published.looked_at = now;
    const std::vector<ContourName> others = outlines.covering(contour.polygon, contour.closed);
    for (const ContourName& other : others) {
      if (references.endorsements(other) >= options_.max_endorsements) continue;
      references.add(RecordKind::kEndorsement, other, outlines.epochOf(other.origin), log_, now);
    }
    return !others.empty() || write(published, contour, now);
  }
  published.settled = published.settled || !differs(published, contour);
  if (published.settled && !isContested(published, references)) return true;
  published.settled = false;
  published.looked_at = now;
  return write(published, contour, now);
}

bool OwnMap::differs(const Published& published, const OwnContour& contour) const {
  const auto anchor = anchors_.find(published.anchor);
  if (anchor == anchors_.end() || contour.closed != published.given.closed || contour.hole != published.given.hole) return true;
  return !agree(transformed(anchor->second, published.polygon), contour.polygon, contour.closed, options_.contour_tolerance);
}

bool OwnMap::isContested(const Published& published, const References& references) const {
  return std::any_of(published.ids.begin(), published.ids.end(), [&](std::uint32_t id) {
    const StoredRecord* stored = log_.log()->find(RecordKind::kContour, id);
    const auto contest = references.contestOf({log_.self(), id, stored->record.sequence});
    // Seen again since: the contest was wrong, or the thing is back.
    return contest && published.given.seen > *contest;
  });
}

bool OwnMap::write(Published& published, const OwnContour& contour, double now) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : contour.polygon) middle += point / static_cast<double>(contour.polygon.size());
  const auto anchor = nearestAnchor(middle);
  if (!anchor) return false;
  const Polygon local = transformed(anchors_.at(*anchor).inverse(), contour.polygon);
  const std::vector<ContourBody> pieces = cutOutline(local, contour.closed, contour.hole, *anchor);
  while (published.ids.size() > pieces.size()) {
    log_.remove(RecordKind::kContour, published.ids.back(), now);
    published.ids.pop_back();
  }
  published.anchor = *anchor;
  published.polygon = local;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::uint32_t id = i < published.ids.size() ? published.ids[i] : log_.freeId(RecordKind::kContour);
    if (!log_.write(RecordKind::kContour, id, encode(pieces[i]), now)) return false;
    if (i >= published.ids.size()) published.ids.push_back(id);
  }
  return !pieces.empty();
}

void OwnMap::withdrawMissing(const std::set<std::int64_t>& present, double now) {
  for (auto entry = contours_.begin(); entry != contours_.end();) {
    Published& published = entry->second;
    if (present.count(entry->first) == 0 && published.missing_since < 0.0) published.missing_since = now;
    if (published.missing_since < 0.0 || now - published.missing_since < options_.tombstone_delay) {
      ++entry;
      continue;
    }
    for (const std::uint32_t id : published.ids) log_.remove(RecordKind::kContour, id, now);
    entry = contours_.erase(entry);
  }
}

std::optional<std::int64_t> OwnMap::keyOf(std::uint32_t record_id) const {
  for (const auto& entry : contours_) {
    const std::vector<std::uint32_t>& ids = entry.second.ids;
    if (std::find(ids.begin(), ids.end(), record_id) != ids.end()) return entry.first;
  }
  return std::nullopt;
}

}  // namespace parley

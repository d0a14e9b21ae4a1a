// SPDX-License-Identifier: BSD-3-Clause
#include "global_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parley {
namespace {

constexpr int kDirections = 180;       // [-] bins of the histograms
constexpr std::size_t kRotations = 6;  // [-]
constexpr double kCell = 0.2;          // [m]
constexpr double kReach = 7.6;         // [m] how far the peer may be
constexpr std::size_t kProbes = 100;   // [-] of the peer's points are tried
constexpr double kLeastHits = 0.25;    // [-]
constexpr std::size_t kPlaces = 16;    // [-] that are refined a little
constexpr std::size_t kModes = 6;      // [-] that are refined to the end
constexpr double kOverlap = 0.3;       // [-] of the points must match

using Histogram = std::array<double, kDirections>;

int directionOf(double angle) {
  return std::min(static_cast<int>((wrapAngle(angle) + kPi) / (2.0 * kPi) * kDirections), kDirections - 1);
}

Histogram normalsOf(const std::vector<SurfacePoint>& points) {
  Histogram raw{}, smooth{};
  for (const SurfacePoint& point : points) {
    raw[static_cast<std::size_t>(directionOf(std::atan2(point.normal.y(), point.normal.x())))] += 1.0;
  }
  for (int i = 0; i < kDirections; ++i) {
    const auto at = [&](int bin) { return raw[static_cast<std::size_t>((bin + kDirections) % kDirections)]; };
    smooth[static_cast<std::size_t>(i)] = 0.25 * at(i - 1) + 0.5 * at(i) + 0.25 * at(i + 1);
  }
  return smooth;
}

/// Turns by which the peer's normals fit on the own ones, best first. [rad]
std::vector<double> rotationsOf(const Histogram& own, const Histogram& peer) {
  Histogram correlation{};
  for (std::size_t shift = 0; shift < kDirections; ++shift) {
    for (std::size_t i = 0; i < kDirections; ++i) correlation[shift] += peer[i] * own[(i + shift) % kDirections];
  }
  std::vector<std::size_t> maxima;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double before = correlation[(i + kDirections - 1) % kDirections], after = correlation[(i + 1) % kDirections];
    if (correlation[i] > before && correlation[i] >= after) maxima.push_back(i);
  }
  std::stable_sort(maxima.begin(), maxima.end(), [&](std::size_t a, std::size_t b) { return correlation[a] > correlation[b]; });
  maxima.resize(std::min(maxima.size(), kRotations));
  std::vector<double> rotations;
  rotations.reserve(maxima.size());
  for (const std::size_t shift : maxima) rotations.push_back(2.0 * kPi * static_cast<double>(shift) / kDirections);
  return rotations;
}

/// Occupied cells about a place, each grown by its neighbours, so that every second shift suffices.
class PooledGrid {
 public:
  PooledGrid(const std::vector<SurfacePoint>& points, const Eigen::Vector2d& center) : center_(center), cells_(kSide * kSide, 0) {
    for (const SurfacePoint& point : points) {
      const long column = cellOf(point.position.x() - center.x()), row = cellOf(point.position.y() - center.y());
      for (long r = row - 1; r <= row + 1; ++r) {
        for (long c = column - 1; c <= column + 1; ++c) {
          if (c >= 0 && r >= 0 && c < kSide && r < kSide) cells_[static_cast<std::size_t>(r * kSide + c)] = 1;
        }
      }
    }
  }
  int hits(const std::vector<Eigen::Vector2i>& probes, int dx, int dy) const {
    int count = 0;
    for (const Eigen::Vector2i& probe : probes) {
      const long c = probe.x() + dx, r = probe.y() + dy;
      if (c >= 0 && r >= 0 && c < kSide && r < kSide) count += cells_[static_cast<std::size_t>(r * kSide + c)];
    }
    return count;
  }
  static long cellOf(double offset) { return static_cast<long>(std::floor(offset / kCell)) + kSide / 2; }

 private:
  static constexpr long kSide = 160;  // [-]
  Eigen::Vector2d center_;
  std::vector<std::uint8_t> cells_;
};

struct Place {
  Pose2 pose;
  int score = 0;  // [-]
};

bool isBetter(const Place& a, const Place& b) { return a.score > b.score; }

void keepBest(std::vector<Place>& places, std::size_t count) {
  std::stable_sort(places.begin(), places.end(), isBetter);
  places.resize(std::min(places.size(), count));
}

/// Places on the grid with many hits, as poses of the peer's odom frame.
std::vector<Place> placesOf(const SurfaceMap& own, const SurfaceMap& peer, const std::vector<SurfacePoint>& points,
                            const Eigen::Vector2d& here, const Eigen::Vector2d& there) {
  const PooledGrid grid(own.index.points(), here);
  std::vector<Place> places;
  const int reach = static_cast<int>(kReach / kCell);
  for (const double rotation : rotationsOf(normalsOf(own.index.points()), normalsOf(peer.index.points()))) {
    const Pose2 turn{0.0, 0.0, rotation};
    std::vector<Eigen::Vector2i> probes;
    for (const SurfacePoint& point : points) {
      const Eigen::Vector2d p = turn * Eigen::Vector2d(point.position - there);
      probes.emplace_back(static_cast<int>(PooledGrid::cellOf(p.x())), static_cast<int>(PooledGrid::cellOf(p.y())));
    }
    for (int dy = -reach; dy <= reach; dy += 2) {
      for (int dx = -reach; dx <= reach; dx += 2) {
        const int hits = grid.hits(probes, dx, dy);
        if (hits < kLeastHits * static_cast<double>(probes.size())) continue;
        const Eigen::Vector2d p = here + kCell * Eigen::Vector2d(dx, dy) - turn * there;
        places.push_back({{p.x(), p.y(), wrapAngle(rotation)}, hits});
      }
    }
  }
  keepBest(places, kPlaces * 4);
  return places;
}

bool isSameMode(const Pose2& a, const Pose2& b, const Eigen::Vector2d& there) {
  return ((a * there) - (b * there)).norm() < 0.35 && std::abs(angleBetween(a.yaw, b.yaw)) < radians(8.0);
}

/// Refines and scores; keeps one of those that came to the same pose.
std::vector<Place> refined(const SurfaceMap& own, const SurfaceMap& peer, const std::vector<SurfacePoint>& points,
                           const std::vector<Place>& places, const Eigen::Vector2d& there, int iterations, std::size_t votes) {
  std::vector<Place> modes;
  for (const Place& place : places) {
    const ScanMatch match = refineMatch(own.index, points, unobserved(place.pose, place.pose * there), iterations);
    if (!match.converged) continue;
    const Pose2& pose = match.estimate.pose;
    const auto is_same = [&](const Place& other) { return isSameMode(other.pose, pose, there); };
    if (std::any_of(modes.begin(), modes.end(), is_same)) continue;
    modes.push_back({pose, voteOnFreeSpace(own.submap, peer.submap, pose, votes).score()});
  }
  return modes;
}

/// Grid places so near to a better one that they would be refined to the same pose are left out.
std::vector<Place> thinned(const std::vector<Place>& places, const Eigen::Vector2d& there) {
  std::vector<Place> kept;
  for (const Place& place : places) {
    const auto is_near = [&](const Place& other) {
      return ((other.pose * there) - (place.pose * there)).norm() < 0.5 &&
             std::abs(angleBetween(other.pose.yaw, place.pose.yaw)) < 0.1;
    };
    if (kept.size() < kPlaces && std::none_of(kept.begin(), kept.end(), is_near)) kept.push_back(place);
  }
  return kept;
}

}  // namespace

std::optional<PoseInformation> searchGlobally(const SurfaceMap& own, const SurfaceMap& peer,
                                              const RelativeLocalizationOptions& options) {
  if (own.sample.empty() || peer.sample.empty()) return std::nullopt;
  const Eigen::Vector2d here = own.submap.scans().back().T_odom_scan.position();
  const Eigen::Vector2d there = peer.submap.scans().back().T_odom_scan.position();
  const std::vector<SurfacePoint> points = peer.submap.sample(kProbes);
  std::vector<Place> modes = refined(own, peer, points, thinned(placesOf(own, peer, points, here, there), there), there, 4, 60);
  keepBest(modes, kModes);
  modes = refined(own, peer, points, modes, there, 12, 240);
  keepBest(modes, kModes);
  if (modes.empty()) return std::nullopt;
  const Pose2& best = modes.front().pose;
  const ScanMatch match = refineMatch(own.index, peer.sample, unobserved(best, best * there));
  const FreeSpaceVote vote = voteOnFreeSpace(own.submap, peer.submap, match.estimate.pose);
  const double gap = modes.size() < 2 ? 1e9 : static_cast<double>(modes[0].score - std::max(modes[1].score, 0));
  const bool is_good = match.converged && vote.matches >= options.matches_alone &&
                       vote.violationShare() <= options.max_violations && vote.matches >= kOverlap * vote.points &&
                       match.observability.share >= options.min_observability && gap >= options.ambiguity_gap * vote.points;
  if (!is_good) return std::nullopt;
  return match.estimate;
}

}  // namespace parley

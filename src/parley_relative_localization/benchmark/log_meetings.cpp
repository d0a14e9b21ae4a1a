// SPDX-License-Identifier: BSD-3-Clause
#include "log_meetings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parley::study {
namespace {

constexpr double kRoom = 0.2;     // [m] that a scan saw beyond the middle of a body
constexpr double kBeside = 0.15;  // [m] to each side of it

}  // namespace

bool hasInView(const LogScan& scan, const Eigen::Vector2d& place, double reach) {
  const Eigen::Vector2d p = scan.T_map_base.inverse() * place;
  const double range = p.norm(), bearing = std::atan2(p.y(), p.x());
  if (range > reach || range < kBeside) return false;
  const double half = std::asin(kBeside / range);
  const auto index = [&](double b) { return std::lround((b - scan.angle_min) / scan.angle_increment); };
  const long from = index(bearing - half), to = index(bearing + half);
  if (from < 0 || to >= static_cast<long>(scan.ranges.size())) return false;
  return std::all_of(scan.ranges.begin() + from, scan.ranges.begin() + to + 1,
                     [&](float seen) { return static_cast<double>(seen) > range + kRoom; });
}

std::vector<Meeting> findMeetings(const CarmenLog& log, int apart, double nearest, double farthest) {
  std::vector<Meeting> meetings;
  const int count = static_cast<int>(log.scans.size());
  for (int i = 0; i < count; ++i) {
    const LogScan& a = log.scans[static_cast<std::size_t>(i)];
    for (int j = i + apart; j < count; ++j) {
      const LogScan& b = log.scans[static_cast<std::size_t>(j)];
      const Eigen::Vector2d pa = a.T_map_base.position(), pb = b.T_map_base.position();
      const double distance = (pb - pa).norm();
      if (distance < nearest || distance > farthest) continue;
      if (hasInView(a, pb, farthest) && hasInView(b, pa, farthest)) meetings.push_back({i, j});
    }
  }
  return meetings;
}

Stretch stretchAbout(const CarmenLog& log, int scan, int reach, bool backwards) {
  return {std::max(scan - reach, 0), std::min(scan + reach, static_cast<int>(log.scans.size()) - 1), scan, backwards};
}

double distanceBetween(const CarmenLog& log, const Stretch& a, const Stretch& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = a.first; i <= a.last; ++i) {
    const Eigen::Vector2d p = log.scans[static_cast<std::size_t>(i)].T_map_base.position();
    for (int j = b.first; j <= b.last; ++j) {
      least = std::min(least, (log.scans[static_cast<std::size_t>(j)].T_map_base.position() - p).norm());
    }
  }
  return least;
}

}  // namespace parley::study

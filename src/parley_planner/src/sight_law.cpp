// SPDX-License-Identifier: BSD-3-Clause
#include "sight_law.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace parley {

namespace {

constexpr double kCell = 0.1;                // [m]
constexpr int kStraight = 10;                // units of cost across a cell's side
constexpr int kDiagonal = 14;                // and across its corner
constexpr double kUnit = kCell / kStraight;  // [m]
constexpr int kFar = static_cast<int>(kFarGap / kUnit);
constexpr int kSlowPrice = 2;           // [-] times as dear where an intruder would have to graze walls
constexpr double kVisibleMargin = 0.1;  // [m] a ray must pass a place by this much
constexpr double kWallBehind = 0.3;     // [m] behind the robot's middle nothing comes past it
constexpr double kWallHalfWidth = 1.2;  // [m]
constexpr double kLeaving = 0.3;        // [m/s]
constexpr int kNewTrack = 4;            // scans before a thing's velocity is believed
constexpr double kTrackRim = 0.5;       // [m] its own returns close the cells round a thing off up to here

int cost(double metres) { return static_cast<int>(std::lround(metres / kUnit)); }

}  // namespace

SightLaw::SightLaw(const SightLawOptions& options, const MotionLimits& limits) : options_(options), limits_(limits) {}

void SightLaw::reset() {
  possible_.clear();
  gaps_.clear();
  updated_at_ = -1e9;
}

SightLaw::Mask SightLaw::carriedOver(const GridFrame& frame) const {
  Mask mask(static_cast<std::size_t>(frame.width * frame.height), 1);
  if (possible_.empty()) return mask;
  const int dx = static_cast<int>(std::lround((frame.origin.x() - frame_.origin.x()) / kCell));
  const int dy = static_cast<int>(std::lround((frame.origin.y() - frame_.origin.y()) / kCell));
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Eigen::Vector2i before(x + dx, y + dy);
      if (frame_.contains(before)) {
        mask[static_cast<std::size_t>(frame.indexOf({x, y}))] = possible_[static_cast<std::size_t>(frame_.indexOf(before))];
      }
    }
  }
  return mask;
}

SightLaw::Mask SightLaw::hidden(const ObstacleScan& scan, const Pose2& T_odom_scan) const {
  // A robot whose disc covers a place that is seen through is not there.
  Mask visible(possible_.size(), 0);
  const Pose2 T_scan_odom = T_odom_scan.inverse();
  const double c = std::cos(T_scan_odom.yaw), s = std::sin(T_scan_odom.yaw);
  const auto bins = static_cast<double>(scan.binCount());
  for (int y = 0, i = 0; y < frame_.height; ++y) {
    for (int x = 0; x < frame_.width; ++x, ++i) {
      const Eigen::Vector2d p = frame_.centerOf({x, y});
      const double rx = T_scan_odom.x + c * p.x() - s * p.y() - scan.origin.x();
      const double ry = T_scan_odom.y + s * p.x() + c * p.y() - scan.origin.y();
      const double distance = rx * rx + ry * ry;
      if (distance > scan.range_max * scan.range_max || scan.ranges.empty()) continue;
      const double turn = (std::atan2(ry, rx) + kPi) / (2.0 * kPi);
      const auto bin = std::min(static_cast<std::size_t>(turn * bins), scan.binCount() - 1);
      const double reach = static_cast<double>(scan.ranges[bin]) - kVisibleMargin;
      visible[static_cast<std::size_t>(i)] = reach > 0.0 && distance < reach * reach;  // NaN sees nothing
    }
  }
  const int radius = static_cast<int>(std::lround(options_.intruder_radius / kCell));
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  const cv::Mat seen(frame_.height, frame_.width, CV_8UC1, visible.data());
  Mask grown(visible.size());
  cv::Mat result(frame_.height, frame_.width, CV_8UC1, grown.data());
  cv::dilate(seen, result, disc);
  std::transform(grown.begin(), grown.end(), grown.begin(), [](std::uint8_t v) { return static_cast<std::uint8_t>(!v); });
  return grown;
}

SightLaw::Mask SightLaw::middleOfWays(const std::vector<float>& rooms) const {
  const int reach = static_cast<int>(std::lround(options_.intruder_clearance / kCell));
  const cv::Mat room(frame_.height, frame_.width, CV_32FC1, const_cast<float*>(rooms.data()));
  cv::Mat roomiest;
  cv::dilate(room, roomiest, cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1}));
  Mask middle(rooms.size());
  for (std::size_t i = 0; i < middle.size(); ++i) {
    const float best = roomiest.ptr<float>()[i];
    middle[i] = rooms[i] >= std::min(static_cast<float>(options_.intruder_clearance), 0.8F * best);
  }
  return middle;
}

SightLaw::Costs SightLaw::spread(const Costs& sources, const Mask& prices, int most) const {
  Costs costs = sources;
  std::vector<std::vector<int>> buckets(static_cast<std::size_t>(most + 1));
  const int w = frame_.width, h = frame_.height;
  const auto priceOf = [&](int x, int y) {
    return x < 0 || y < 0 || x >= w || y >= h ? 0 : static_cast<int>(prices[static_cast<std::size_t>(y * w + x)]);
  };
  for (int i = 0; i < w * h; ++i) {
    const int start = costs[static_cast<std::size_t>(i)];
    if (start > most) continue;
    // Cells inside a source are surrounded by it and have nowhere to spread to.
    const int x = i % w, y = i / w;
    const auto deeper = [&](int nx, int ny) {
      return nx >= 0 && ny >= 0 && nx < w && ny < h && costs[static_cast<std::size_t>(ny * w + nx)] <= start;
    };
    const bool inner = deeper(x - 1, y) && deeper(x + 1, y) && deeper(x, y - 1) && deeper(x, y + 1);
    if (!inner) buckets[static_cast<std::size_t>(start)].push_back(i);
  }
  for (int level = 0; level <= most; ++level) {
    for (std::size_t k = 0; k < buckets[static_cast<std::size_t>(level)].size(); ++k) {
      const int i = buckets[static_cast<std::size_t>(level)][k];
      if (costs[static_cast<std::size_t>(i)] != level) continue;
      const int x = i % w, y = i / w;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int price = priceOf(x + dx, y + dy);
          if (price == 0 || (dx == 0 && dy == 0)) continue;
          const int next = level + price * (dx != 0 && dy != 0 ? kDiagonal : kStraight);
          int& known = costs[static_cast<std::size_t>(i + dy * w + dx)];
          if (next > most || next >= known) continue;
          known = next;
          buckets[static_cast<std::size_t>(next)].push_back(i + dy * w + dx);
        }
      }
    }
  }
  return costs;
}

void SightLaw::observe(const Surroundings& surroundings, const ObstacleScan& scan, const Pose2& T_odom_scan,
                       const std::vector<TrackedObject>& tracks, const Pose2& pose, double now) {
  const GridFrame& window = surroundings.frame();
  GridFrame frame;
  frame.resolution = kCell;
  frame.origin = (window.origin / kCell).array().round().matrix() * kCell;
  frame.width = static_cast<int>(window.size().x() / kCell);
  frame.height = static_cast<int>(window.size().y() / kCell);
  possible_ = carriedOver(frame);
  frame_ = frame;

  std::vector<float> rooms(possible_.size());
  for (int i = 0; i < static_cast<int>(rooms.size()); ++i) {
    rooms[static_cast<std::size_t>(i)] =
        static_cast<float>(surroundings.obstacles().at(frame_.centerOf({i % frame_.width, i / frame_.width})));
  }
  const Mask middle = middleOfWays(rooms);
  Mask prices(possible_.size(), 0);
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const double room = static_cast<double>(rooms[i]);
    if (room >= options_.intruder_radius - 0.5 * kCell) prices[i] = room < options_.intruder_clearance ? kSlowPrice : 1;
  }
  // Where an unseen one can have driven since the last time.
  Costs sources(possible_.size(), 2 * kFar);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (possible_[i] && prices[i]) sources[i] = 0;
  }
  const double elapsed = std::clamp(now - updated_at_, 0.0, 1.0);
  const Costs driven = spread(sources, prices, std::min(kFar, cost(options_.intruder_speed * elapsed)));
  const Mask unseen = hidden(scan, T_odom_scan);
  // How far off it is from everywhere; nothing comes through the robot from behind.
  for (std::size_t i = 0; i < sources.size(); ++i) {
    possible_[i] = prices[i] && unseen[i] && driven[i] <= kFar;
    sources[i] = possible_[i] && middle[i] ? 0 : 2 * kFar;
    const Eigen::Vector2i cell(static_cast<int>(i) % frame_.width, static_cast<int>(i) / frame_.width);
    const Eigen::Vector2d p_base = pose.inverse() * frame_.centerOf(cell);
    if (std::abs(p_base.y()) < kWallHalfWidth && p_base.x() < -kWallBehind && p_base.x() > -kWallBehind - 0.3) {
      prices[i] = 0;
      sources[i] = 2 * kFar;
    }
  }
  for (const TrackedObject& track : tracks) {
    const Eigen::Vector2d there = track.position + track.velocity * (now - track.stamp);
    const Eigen::Vector2d towards = (pose.position() - there).normalized();
    // What stands now may drive off the next moment: only what clearly leaves is no danger.
    const bool may_come = track.has_moved && track.velocity.dot(towards) > -kLeaving;
    if (may_come || track.observations < kNewTrack) addIntruder(there, track.radius + kTrackRim, prices, sources);
  }
  gaps_ = spread(sources, prices, kFar);
  updated_at_ = now;
}

void SightLaw::addIntruder(const Eigen::Vector2d& there, double reach, const Mask& prices, Costs& sources) const {
  const Eigen::Vector2i low = frame_.cellOf(there - Eigen::Vector2d::Constant(reach));
  const Eigen::Vector2i high = frame_.cellOf(there + Eigen::Vector2d::Constant(reach));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (!frame_.contains({x, y}) || prices[static_cast<std::size_t>(frame_.indexOf({x, y}))] == 0) continue;
      const double distance = (frame_.centerOf({x, y}) - there).norm();
      if (distance > reach) continue;
      int& known = sources[static_cast<std::size_t>(frame_.indexOf({x, y}))];
      known = std::min(known, cost(distance));
    }
  }
}

double SightLaw::speedFor(double gap) const {
  const double free = std::max(0.0, gap - options_.contact_distance);
  const double a = limits_.acceleration, t = options_.reaction_time;
  return std::max(options_.least_speed, a * (std::sqrt(t * t + free / a) - t));
}

double SightLaw::gapAt(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2i cell = frame_.cellOf(p_odom);
  if (gaps_.empty() || !frame_.contains(cell)) return 0.0;
  return std::min(kFarGap, gaps_[static_cast<std::size_t>(frame_.indexOf(cell))] * kUnit);
}

bool SightLaw::possibleAt(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2i cell = frame_.cellOf(p_odom);
  return !frame_.contains(cell) || possible_.empty() || possible_[static_cast<std::size_t>(frame_.indexOf(cell))];
}

std::vector<double> SightLaw::bounds(const ReferencePath& path, double start_s, double speed) const {
  const double grace = options_.look_ahead_time * std::max(0.0, speed);
  std::vector<double> bounds;
  for (const double s : path.arcLengths()) {
    bounds.push_back(speedFor(gapAt(path.at(std::max(start_s, s - grace)).position)));
  }
  return bounds;
}

}  // namespace parley

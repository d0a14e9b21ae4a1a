// SPDX-License-Identifier: BSD-3-Clause
#include "sight_law.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "bearing.h"

namespace parley {

namespace {

constexpr double kCell = 0.1;                              // [m]
constexpr double kUnit = kCell / CostSpreader::kStraight;  // [m]
constexpr int kFar = static_cast<int>(kFarGap / kUnit);
constexpr int kSlowPrice = 2;           // [-] times as dear off the middle of the way, where an intruder would drive slowly
constexpr double kVisibleMargin = 0.1;  // [m] a ray must pass a place by this much
constexpr double kWallBehind = 0.3;     // [m] behind the robot's middle, as it drives, nothing comes past it
constexpr double kWallDepth = 0.3;      // [m]
constexpr double kWallHalfWidth = 1.2;  // [m]
constexpr double kLeaving = 0.3;        // [m/s]
constexpr double kNever = 1e18;         // [s]
constexpr double kFreshReach = 0.6;     // [m] round new returns, where ways may be wider than they look
constexpr double kJump = 0.2;           // [m] of range between neighbours: one thing ends and another begins
constexpr int kNewTrack = 4;            // scans before a thing's velocity is believed
constexpr double kYoung = 2.0;          // [s] since first sight
constexpr double kWalking = 0.3;        // [m/s]
constexpr double kWalkerMemory = 2.0;   // [s] somebody who stands may walk on as before
constexpr double kForgetting = 0.2;     // [m/s^2]
constexpr double kWalkerGap = 0.2;      // [m] who walks past further aside does not walk into the robot
constexpr double kStandingGrace = 0.3;  // [m] less than on one that drives is enough on one that may start
constexpr double kTrackRim = 0.5;       // [m] its own returns close the cells round a thing off up to here

int cost(double metres) { return static_cast<int>(std::lround(metres / kUnit)); }

}  // namespace

SightLaw::SightLaw(const SightLawOptions& options, const MotionLimits& limits) : options_(options), limits_(limits) {}

void SightLaw::reset() {
  possible_.clear();
  lost_.clear();
  prices_.clear();
  gaps_.clear();
  gaps_behind_.clear();
  dates_.clear();
  walkers_.clear();
  updated_at_ = -1e9;
}

template <class Value>
std::vector<Value> SightLaw::carriedOver(const std::vector<Value>& grid, const GridFrame& frame, Value fresh) const {
  std::vector<Value> carried(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height), fresh);
  if (grid.empty()) return carried;
  const int dx = static_cast<int>(std::lround((frame.origin.x() - frame_.origin.x()) / kCell));
  const int dy = static_cast<int>(std::lround((frame.origin.y() - frame_.origin.y()) / kCell));
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Eigen::Vector2i before(x + dx, y + dy);
      if (!frame_.contains(before)) continue;
      carried[static_cast<std::size_t>(frame.indexOf({x, y}))] = grid[static_cast<std::size_t>(frame_.indexOf(before))];
    }
  }
  return carried;
}

SightLaw::Mask SightLaw::visible(const ObstacleScan& scan, const Pose2& T_odom_scan) const {
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
      const double turn = (bearingOf(rx, ry) + kPi) / (2.0 * kPi);
      const auto bin = std::min(static_cast<std::size_t>(turn * bins), scan.binCount() - 1);
      const double reach = static_cast<double>(scan.ranges[bin]) - kVisibleMargin;
      visible[static_cast<std::size_t>(i)] = reach > 0.0 && distance < reach * reach;  // NaN sees nothing
    }
  }
  return visible;
}

SightLaw::Mask SightLaw::hidden(const Mask& visible) const {
  const int radius = static_cast<int>(std::lround(options_.intruder_radius / kCell));
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  const cv::Mat seen(frame_.height, frame_.width, CV_8UC1, const_cast<std::uint8_t*>(visible.data()));
  Mask grown(visible.size());
  cv::Mat result(frame_.height, frame_.width, CV_8UC1, grown.data());
  cv::dilate(seen, result, disc);
  std::transform(grown.begin(), grown.end(), grown.begin(), [](std::uint8_t v) { return static_cast<std::uint8_t>(!v); });
  return grown;
}

void SightLaw::dateReturns(const ObstacleScan& scan, const Pose2& T_odom_scan, const Mask& visible, double now) {
  for (std::size_t i = 0; i < dates_.size(); ++i) {
    if (visible[i]) dates_[i] = kNever;
  }
  for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
    if (!std::isfinite(scan.ranges[bin])) continue;
    const Eigen::Vector2i cell = frame_.cellOf(T_odom_scan * scan.pointAt(bin, static_cast<double>(scan.ranges[bin])));
    if (!frame_.contains(cell)) continue;
    double& date = dates_[static_cast<std::size_t>(frame_.indexOf(cell))];
    date = std::min(date, now);
  }
}

std::vector<float> SightLaw::roomsOf(const Surroundings& surroundings, double now) const {
  const int w = frame_.width, h = frame_.height;
  cv::Mat1d dates(h, w, const_cast<double*>(dates_.data())), oldest;
  cv::erode(dates, oldest, cv::Mat());  // of a cell and its neighbours: noise scatters returns over two
  cv::Mat1b fresh(h, w, static_cast<std::uint8_t>(0));
  Mask stands(dates_.size(), 0);
  std::vector<float> rooms(dates_.size());
  for (int y = 0, i = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x, ++i) {
      const double room = surroundings.obstacles().at(frame_.centerOf({x, y}));
      rooms[static_cast<std::size_t>(i)] = static_cast<float>(room);
      fresh(y, x) = dates(y, x) < kNever && oldest(y, x) > now - options_.proof_time;
      stands[static_cast<std::size_t>(i)] = room < 0.75 * kCell && !fresh(y, x);
    }
  }
  if (cv::countNonZero(fresh) == 0) return rooms;
  const DistanceField without(frame_, stands);
  const int reach = static_cast<int>(std::lround(kFreshReach / kCell));
  cv::dilate(fresh, fresh, cv::Mat(), {-1, -1}, reach);
  for (int y = 0, i = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x, ++i) {
      float& room = rooms[static_cast<std::size_t>(i)];
      if (fresh(y, x)) room = std::max(room, without.atCell(x, y));
    }
  }
  return rooms;
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
  return spreader_.spread(sources, prices, frame_.width, frame_.height, most);
}

void SightLaw::observe(const Surroundings& surroundings, const ObstacleScan& scan, const Pose2& T_odom_scan,
                       const std::vector<TrackedObject>& tracks, const Pose2& pose, double now) {
  const GridFrame& window = surroundings.frame();
  GridFrame frame;
  frame.resolution = kCell;
  frame.origin = (window.origin / kCell).array().round().matrix() * kCell;
  frame.width = static_cast<int>(window.size().x() / kCell);
  frame.height = static_cast<int>(window.size().y() / kCell);
  possible_ = carriedOver<std::uint8_t>(possible_, frame, 1);
  lost_ = carriedOver<std::uint8_t>(lost_, frame, 0);
  dates_ = carriedOver(dates_, frame, kNever);
  frame_ = frame;

  const Mask seen_through = visible(scan, T_odom_scan);
  dateReturns(scan, T_odom_scan, seen_through, now);
  const std::vector<float> rooms = roomsOf(surroundings, now);
  const Mask middle = middleOfWays(rooms);
  Mask prices(possible_.size(), 0);
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const bool fits = static_cast<double>(rooms[i]) >= options_.intruder_radius - 0.5 * kCell;
    if (fits) prices[i] = middle[i] ? 1 : kSlowPrice;
  }
  const Mask unseen = hidden(seen_through);
  possible_ = driven(possible_, prices, unseen, now - updated_at_);
  followLost(tracks, prices, unseen, now);
  followWalkers(tracks, now);
  hidden_.assign(possible_.size(), 2 * kFar);
  for (std::size_t i = 0; i < hidden_.size(); ++i) {
    if ((possible_[i] && middle[i]) || lost_[i]) hidden_[i] = 0;
  }
  pose_ = pose;
  prices_ = std::move(prices);
  seen_ = seenFrom(tracks, dated(scan, T_odom_scan, now), now);
  updated_at_ = now;
  gaps_.clear();
  gaps_behind_.clear();
}

const SightLaw::Costs& SightLaw::gaps(bool backwards) const {
  Costs& known = backwards ? gaps_behind_ : gaps_;
  if (known.empty() && !prices_.empty()) known = gapsAhead(backwards ? -1.0 : 1.0);
  return known;
}

SightLaw::Costs SightLaw::gapsAhead(double direction) const {
  Mask prices = prices_;
  Costs hidden = hidden_, seen = seen_;
  const Pose2 T_base_odom = pose_.inverse();
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const Eigen::Vector2i cell(static_cast<int>(i) % frame_.width, static_cast<int>(i) / frame_.width);
    const Eigen::Vector2d p_base = T_base_odom * frame_.centerOf(cell);
    const double behind = -direction * p_base.x() - kWallBehind;
    if (std::abs(p_base.y()) > kWallHalfWidth || behind < 0.0 || behind > kWallDepth) continue;
    prices[i] = 0;
    hidden[i] = 2 * kFar;
    if (!seen.empty()) seen[i] = 2 * kFar;
  }
  Costs gaps = spread(hidden, prices, kFar);
  if (team_known_) {
    // What is hidden does not drive at the robot: this one has all of the gap to stop in, not half.
    const int contact = cost(options_.contact_distance);
    for (int& gap : gaps) gap = std::min(2 * kFar, gap + std::max(0, gap - contact));
  } else {
    // The robot drives its own half of the gap, off the middle of the way or not.
    gaps = spreader_.halfPriced(gaps, prices, frame_.width, frame_.height, kFar);
  }
  if (seen.empty()) return gaps;
  // What is seen is there already: that ways are narrow makes it no slower to meet.
  std::transform(prices.begin(), prices.end(), prices.begin(), [](std::uint8_t p) { return p ? std::uint8_t{1} : p; });
  const Costs to_seen = spread(seen, prices, kFar);
  for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = std::min(gaps[i], to_seen[i]);
  return gaps;
}

SightLaw::Costs SightLaw::seenFrom(const std::vector<TrackedObject>& tracks, const std::vector<DatedReturn>& returns,
                                   double now) const {
  Costs sources(prices_.size(), 2 * kFar);
  const std::vector<FreshPiece> fresh = freshPieces(returns, options_.intruder_length, kJump);
  const std::vector<FreshPiece> emerging = emergingPieces(returns, options_.intruder_length, kJump);
  bool any = !fresh.empty() || !emerging.empty();
  for (const TrackedObject& track : tracks) {
    const Eigen::Vector2d there = track.position + track.velocity * (now - track.stamp);
    const Eigen::Vector2d towards = (pose_.position() - there).normalized();
    // What stands now may drive off the next moment: only what clearly leaves is no danger.
    const bool may_come = track.has_moved && track.velocity.dot(towards) > -kLeaving;
    if (!may_come && track.observations >= kNewTrack) continue;
    addIntruder(there, track.radius + kTrackRim, 0.0, sources);
    any = true;
  }
  const auto addPieces = [&](const std::vector<FreshPiece>& pieces, double grace) {
    for (const FreshPiece& piece : pieces) addIntruder(piece.middle, 0.5 * piece.chord + kTrackRim, grace, sources);
  };
  addPieces(fresh, 0.0);
  addPieces(emerging, kStandingGrace);
  return any ? sources : Costs{};
}

SightLaw::Mask SightLaw::driven(const Mask& from, const Mask& prices, const Mask& unseen, double elapsed) {
  Costs sources(from.size(), 2 * kFar);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] && prices[i]) sources[i] = 0;
  }
  const int most = cost(std::clamp(options_.intruder_speed * elapsed, 0.0, kFarGap));
  const Costs reached = spread(sources, prices, most);
  Mask result(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) result[i] = prices[i] && unseen[i] && reached[i] <= kFar;
  return result;
}

void SightLaw::followLost(const std::vector<TrackedObject>& tracks, const Mask& prices, const Mask& unseen, double now) {
  if (now > lost_until_) {
    lost_.assign(lost_.size(), 0);
  } else {
    lost_ = driven(lost_, prices, unseen, now - updated_at_);
  }
  for (const TrackedObject& track : tracks) {
    if (!track.has_moved) continue;
    lost_until_ = now + options_.memory_time;
    const Eigen::Vector2i middle = frame_.cellOf(track.position);
    const int reach = static_cast<int>(std::ceil(track.radius / kCell));
    for (int y = middle.y() - reach; y <= middle.y() + reach; ++y) {
      for (int x = middle.x() - reach; x <= middle.x() + reach; ++x) {
        if (!frame_.contains({x, y}) || (frame_.centerOf({x, y}) - track.position).norm() > track.radius) continue;
        const auto cell = static_cast<std::size_t>(frame_.indexOf({x, y}));
        lost_[cell] = prices[cell] && unseen[cell];
      }
    }
  }
}

double SightLaw::ageOf(const Eigen::Vector2d& p_odom, double now) const {
  const Eigen::Vector2i cell = frame_.cellOf(p_odom);
  double oldest = kNever;
  for (int y = cell.y() - 1; y <= cell.y() + 1; ++y) {
    for (int x = cell.x() - 1; x <= cell.x() + 1; ++x) {
      if (frame_.contains({x, y})) oldest = std::min(oldest, dates_[static_cast<std::size_t>(frame_.indexOf({x, y}))]);
    }
  }
  return oldest < kNever ? now - oldest : kNever;
}

std::vector<DatedReturn> SightLaw::dated(const ObstacleScan& scan, const Pose2& T_odom_scan, double now) const {
  std::vector<DatedReturn> returns;
  for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
    const double range = static_cast<double>(scan.ranges[bin]);
    if (!std::isfinite(range)) continue;
    const Eigen::Vector2d p_odom = T_odom_scan * scan.pointAt(bin, range);
    const double age = ageOf(p_odom, now);
    returns.push_back({p_odom, range, age < options_.proof_time, age < kYoung, static_cast<int>(bin)});
  }
  return returns;
}

void SightLaw::addIntruder(const Eigen::Vector2d& there, double reach, double grace, Costs& sources) const {
  const Eigen::Vector2i low = frame_.cellOf(there - Eigen::Vector2d::Constant(reach));
  const Eigen::Vector2i high = frame_.cellOf(there + Eigen::Vector2d::Constant(reach));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (!frame_.contains({x, y}) || prices_[static_cast<std::size_t>(frame_.indexOf({x, y}))] == 0) continue;
      const double distance = (frame_.centerOf({x, y}) - there).norm();
      if (distance > reach) continue;
      int& known = sources[static_cast<std::size_t>(frame_.indexOf({x, y}))];
      known = std::min(known, cost(distance + grace));
    }
  }
}

double SightLaw::speedFor(double gap) const {
  const double free = std::max(0.0, gap - options_.contact_distance);
  const double a = limits_.acceleration, t = options_.reaction_time;
  return std::max(options_.least_speed, a * (std::sqrt(t * t + free / a) - t));
}

double SightLaw::gapAt(const Eigen::Vector2d& p_odom, bool backwards) const {
  const Eigen::Vector2i cell = frame_.cellOf(p_odom);
  const Costs& known = gaps(backwards);
  if (known.empty() || !frame_.contains(cell)) return 0.0;
  return std::min(kFarGap, known[static_cast<std::size_t>(frame_.indexOf(cell))] * kUnit);
}

bool SightLaw::possibleAt(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2i cell = frame_.cellOf(p_odom);
  return !frame_.contains(cell) || possible_.empty() || possible_[static_cast<std::size_t>(frame_.indexOf(cell))];
}

void SightLaw::followWalkers(const std::vector<TrackedObject>& tracks, double now) {
  std::map<int, Walker> walkers;
  for (const TrackedObject& track : tracks) {
    if (track.id < 0) continue;
    Walker walker;
    if (const auto known = walkers_.find(track.id); known != walkers_.end()) walker = known->second;
    walker.position = track.position;
    walker.radius = track.radius;
    if (const double speed = track.velocity.norm(); track.moving && speed > kWalking) {
      walker.direction = track.velocity / speed;
      walker.speed =
          std::max(speed, now - walker.walked < kWalkerMemory ? walker.speed - kForgetting * (now - walker.walked) : 0.0);
      walker.walked = now;
    }
    if (walker.speed > 0.0 && now - walker.walked < kWalkerMemory) walkers[track.id] = walker;
  }
  walkers_ = std::move(walkers);
}

double SightLaw::speedBesideWalkers(const Eigen::Vector2d& p_odom, bool backwards) const {
  double bound = limits_.speed;
  const double a = limits_.acceleration, t = options_.reaction_time;
  for (const auto& [id, walker] : walkers_) {
    if (((pose_.inverse() * walker.position).x() < 0.0) != backwards) continue;
    const Eigen::Vector2d to = p_odom - walker.position;
    const double aside = std::abs(walker.direction.x() * to.y() - walker.direction.y() * to.x());
    if (aside > walker.radius + options_.half_width + kWalkerGap) continue;
    // v t + v^2 / 2a for the robot, and the walker's way until the robot stands.
    const double free = to.norm() - walker.radius - options_.half_length - walker.speed * t;
    const double b = t + walker.speed / a;
    const double speed = free > 0.0 ? a * (std::sqrt(b * b + 2.0 * free / a) - b) : 0.0;
    bound = std::min(bound, std::max(options_.least_speed, speed));
  }
  return bound;
}

std::vector<double> SightLaw::bounds(const ReferencePath& path, double start_s, double speed, bool backwards) const {
  const double grace = options_.look_ahead_time * std::max(0.0, backwards ? -speed : speed);
  std::vector<double> bounds;
  for (const double s : path.arcLengths()) {
    const Eigen::Vector2d place = path.at(std::max(start_s, s - grace)).position;
    bounds.push_back(std::min(speedFor(gapAt(place, backwards)), speedBesideWalkers(place, backwards)));
  }
  return bounds;
}

}  // namespace parley

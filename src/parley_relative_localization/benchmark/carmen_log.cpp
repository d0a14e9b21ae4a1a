// SPDX-License-Identifier: BSD-3-Clause
#include "carmen_log.h"

#include <zlib.h>

#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace parley::study {
namespace {

constexpr int kMostBeams = 20000;  // [-] a scan with more is a broken line

std::optional<LogScan> parseScan(std::istringstream& words) {
  int count = 0;
  if (!(words >> count) || count < 2 || count > kMostBeams) return std::nullopt;
  LogScan scan;
  scan.ranges.resize(static_cast<std::size_t>(count));
  for (float& range : scan.ranges) {
    if (!(words >> range)) return std::nullopt;
  }
  Pose2& pose = scan.T_map_base;
  if (!(words >> pose.x >> pose.y >> pose.yaw) || !pose.isFinite()) return std::nullopt;
  pose.yaw = wrapAngle(pose.yaw);
  // An odd number of beams has both ends of the half circle, an even one the right end alone.
  scan.angle_min = -0.5 * kPi;
  scan.angle_increment = kPi / (count % 2 == 1 ? count - 1 : count);
  return scan;
}

struct WheelReading {
  Pose2 pose;
  double stamp = 0.0;  // [s] 0 where the reading is a correction
  bool is_known = false;
};

WheelReading parseWheels(std::istringstream& words) {
  WheelReading reading;
  double speed = 0.0, turn_rate = 0.0, acceleration = 0.0;
  words >> reading.pose.x >> reading.pose.y >> reading.pose.yaw >> speed >> turn_rate >> acceleration >> reading.stamp;
  reading.is_known = !words.fail() && reading.pose.isFinite();
  return reading;
}

/// The motion from one reading to the next, at the end of the way from a scan.
void addMotion(const WheelReading& from, const WheelReading& to, std::vector<Pose2>& way) {
  if (!from.is_known || to.stamp == 0.0) return;
  way.push_back((way.empty() ? Pose2{} : way.back()) * (from.pose.inverse() * to.pose));
}

std::string textOf(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::string text;
  char part[65536];
  int length = 0;
  while ((length = gzread(file.get(), part, sizeof(part))) > 0) text.append(part, static_cast<std::size_t>(length));
  if (length < 0) throw std::runtime_error(path + ": cannot be read");
  return text;
}

}  // namespace

CarmenLog parseCarmenLog(const std::string& name, const std::string& text) {
  CarmenLog log;
  log.name = name;
  std::istringstream lines(text);
  WheelReading last;  // since the newest scan
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "FLASER") {
      auto scan = parseScan(words);
      log.malformed += scan ? 0 : 1;
      if (!scan) continue;
      log.scans.push_back(std::move(*scan));
      last.is_known = false;
    } else if (kind == "ODOM") {
      const WheelReading reading = parseWheels(words);
      log.malformed += reading.is_known ? 0 : 1;
      if (!reading.is_known || log.scans.empty()) continue;
      addMotion(last, reading, log.scans.back().way);
      last = reading;
    }
  }
  return log;
}

CarmenLog readCarmenLog(const std::string& path) {
  const std::string file = path.substr(path.rfind('/') + 1);
  CarmenLog log = parseCarmenLog(file.substr(0, file.find('.')), textOf(path));
  if (log.scans.empty()) throw std::runtime_error(path + ": no scan in it");
  return log;
}

}  // namespace parley::study

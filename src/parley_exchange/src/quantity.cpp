// SPDX-License-Identifier: BSD-3-Clause
#include "quantity.h"

#include <algorithm>
#include <cmath>

namespace parley {

std::int64_t codeOf(double value, const Quantity& quantity) {
  const std::int64_t limit = std::int64_t{1} << (quantity.has_sign ? quantity.bits - 1 : quantity.bits);
  const double code = std::round(value / quantity.step);
  if (std::isnan(code)) return 0;
  const double low = quantity.has_sign ? -static_cast<double>(limit) : 0.0;
  return static_cast<std::int64_t>(std::clamp(code, low, static_cast<double>(limit - 1)));
}

std::int64_t codeOf(double value, const LogQuantity& quantity) {
  if (!(value > quantity.base)) return 0;
  const double code = std::ceil(std::log2(value / quantity.base) * quantity.per_octave - 1e-6);
  return static_cast<std::int64_t>(std::min(code, static_cast<double>((1 << quantity.bits) - 1)));
}

std::int64_t angleCode(double angle, int bits) {
  const double turns = std::isfinite(angle) ? angle / (2.0 * kPi) : 0.0;
  const double count = static_cast<double>(std::int64_t{1} << bits);
  const auto code = static_cast<std::int64_t>(std::round((turns - std::floor(turns)) * count));
  return code & ((std::int64_t{1} << bits) - 1);
}

double angleOf(std::int64_t code, int bits) {
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  const std::int64_t centred = code >= half ? code - 2 * half : code;
  return static_cast<double>(centred) * kPi / static_cast<double>(half);
}

void write(BitWriter& writer, double value, const Quantity& quantity) {
  writer.bits(static_cast<std::uint64_t>(codeOf(value, quantity)), quantity.bits);
}

void write(BitWriter& writer, double value, const LogQuantity& quantity) {
  writer.bits(static_cast<std::uint64_t>(codeOf(value, quantity)), quantity.bits);
}

void writeAngle(BitWriter& writer, double angle, int bits) {
  writer.bits(static_cast<std::uint64_t>(angleCode(angle, bits)), bits);
}

void writePose(BitWriter& writer, const Pose2& pose, const Quantity& position, int yaw_bits) {
  write(writer, pose.x, position);
  write(writer, pose.y, position);
  writeAngle(writer, pose.yaw, yaw_bits);
}

std::int64_t readSigned(BitReader& reader, int bits) {
  const auto code = static_cast<std::int64_t>(reader.bits(bits));
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  return code >= half ? code - 2 * half : code;
}

double read(BitReader& reader, const Quantity& quantity) {
  const std::int64_t code =
      quantity.has_sign ? readSigned(reader, quantity.bits) : static_cast<std::int64_t>(reader.bits(quantity.bits));
  return static_cast<double>(code) * quantity.step;
}

double read(BitReader& reader, const LogQuantity& quantity) {
  return quantity.base * std::exp2(static_cast<double>(reader.bits(quantity.bits)) / quantity.per_octave);
}

double readAngle(BitReader& reader, int bits) { return angleOf(static_cast<std::int64_t>(reader.bits(bits)), bits); }

Pose2 readPose(BitReader& reader, const Quantity& position, int yaw_bits) {
  Pose2 pose;
  pose.x = read(reader, position);
  pose.y = read(reader, position);
  pose.yaw = readAngle(reader, yaw_bits);
  return pose;
}

int bestOrder(const std::vector<std::int32_t>& values) {
  int best = 0;
  long least = -1;
  for (int order = 0; order <= 7; ++order) {
    long sum = 0;
    for (const std::int32_t value : values) sum += golombLength(zigZag(value), order);
    if (least >= 0 && sum >= least) continue;
    least = sum;
    best = order;
  }
  return best;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_exchange/bit_stream.h"
#include "parley_geometry/pose2.h"

namespace parley {

/// How a number goes on the air: multiples of a step in so many bits, two's complement where it has a sign.
struct Quantity {
  double step;  // [unit of the number]
  int bits;     // [-]
  bool has_sign;
};

/// A positive number on a logarithmic scale: base * 2^(code / per_octave).
struct LogQuantity {
  double base;     // [unit of the number] the least
  int per_octave;  // [-]
  int bits;        // [-]
};

constexpr Quantity kCoarsePosition{0.01, 20, true};  // [m]
constexpr Quantity kFinePosition{0.005, 22, true};   // [m]
constexpr Quantity kEdgePosition{0.002, 22, true};   // [m]
constexpr double kPositionLimit = 4000.0;            // [m] what all of them can hold
constexpr int kCoarseYawBits = 12;                   // [-] of a full turn
constexpr int kFineYawBits = 14;                     // [-]
constexpr int kEdgeYawBits = 16;                     // [-]

/// The nearest code; what is out of range is cut. NaN gives 0.
std::int64_t codeOf(double value, const Quantity& quantity);
/// Rounded up, so that an uncertainty never shrinks.
std::int64_t codeOf(double value, const LogQuantity& quantity);
/// In [0, 2^bits).
std::int64_t angleCode(double angle, int bits);
/// In [-pi, pi).
double angleOf(std::int64_t code, int bits);

void write(BitWriter& writer, double value, const Quantity& quantity);
void write(BitWriter& writer, double value, const LogQuantity& quantity);
void writeAngle(BitWriter& writer, double angle, int bits);
void writePose(BitWriter& writer, const Pose2& pose, const Quantity& position, int yaw_bits);

double read(BitReader& reader, const Quantity& quantity);
double read(BitReader& reader, const LogQuantity& quantity);
double readAngle(BitReader& reader, int bits);
Pose2 readPose(BitReader& reader, const Quantity& position, int yaw_bits);
/// Two's complement.
std::int64_t readSigned(BitReader& reader, int bits);

/// The order in [0, 7] that makes the codes shortest.
int bestOrder(const std::vector<std::int32_t>& values);

}  // namespace parley

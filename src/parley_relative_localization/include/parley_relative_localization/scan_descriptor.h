// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "parley_geometry/scan.h"

namespace parley {

constexpr int kPolarBins = 360;                   // [-]
constexpr std::size_t kMaxDescriptorBytes = 512;  // [-] longer ones are refused unread

/// A scan in 360 bearing bins of 8 bits, counter-clockwise from -pi: what is sent of a keyframe. It keeps free space.
struct PolarScan {
  static constexpr std::uint8_t kUnknown = 0;  // not looked at, or something that moves
  static constexpr std::uint8_t kFree = 255;   // nothing up to range_max

  double range_max = 0.0;                        // [m]
  std::array<std::uint8_t, kPolarBins> codes{};  // kUnknown, kFree, or 1 to 254: range in 254ths of range_max

  bool isHit(int bin) const { return codeAt(bin) != kUnknown && codeAt(bin) != kFree; }
  bool isUnknown(int bin) const { return codeAt(bin) == kUnknown; }
  std::uint8_t codeAt(int bin) const { return codes[static_cast<std::size_t>(bin)]; }
  /// [m] of a hit; range_max where free.
  double rangeAt(int bin) const { return isHit(bin) ? range_max * codeAt(bin) / 254.0 : range_max; }

  static double bearingOf(int bin) { return -kPi + (bin + 0.5) * 2.0 * kPi / kPolarBins; }
  static int binOf(double bearing);
  /// The bin counted around: -1 is the last one.
  static int wrapBin(int bin) { return (bin % kPolarBins + kPolarBins) % kPolarBins; }
};

/// What the lidar stage saw, thinned to 360 bins. With `keep_transient` also what moves, else that is unknown.
PolarScan polarScanOf(const ObstacleScan& scan, bool keep_transient);

/// Entropy coded: 80 to 190 bytes indoors. Lossless but for range_max, which is kept to 0.1 m and up to 25.5 m.
std::vector<std::uint8_t> encodeScan(const PolarScan& scan);

/// nullopt for bytes that encodeScan cannot have written; never reads past them.
std::optional<PolarScan> decodeScan(const std::vector<std::uint8_t>& bytes);

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/random_stream.h"

#include <cmath>

namespace parley::sim {
namespace {

/// FNV-1a, one text after another with a byte between that no text holds.
std::uint64_t hashOf(std::uint64_t seed, const std::string& robot, const std::string& purpose) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&hash](std::uint8_t byte) { hash = (hash ^ byte) * 1099511628211ULL; };
  for (int shift = 0; shift < 64; shift += 8) mix(static_cast<std::uint8_t>(seed >> shift));
  for (const char c : robot) mix(static_cast<std::uint8_t>(c));
  mix(0);
  for (const char c : purpose) mix(static_cast<std::uint8_t>(c));
  return hash;
}

/// The last steps of splitmix64: hashes that differ in few bits make seeds that differ in many.
std::uint64_t scrambled(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, const std::string& robot, const std::string& purpose)
    : engine_(scrambled(hashOf(seed, robot, purpose))) {}

double RandomStream::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double RandomStream::uniform(double low, double high) { return low + (high - low) * uniform(); }

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  // Marsaglia's polar method
  double x = 0.0, y = 0.0, square = 0.0;
  do {
    x = uniform(-1.0, 1.0);
    y = uniform(-1.0, 1.0);
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(square) / square);
  spare_ = y * scale;
  has_spare_ = true;
  return x * scale;
}

}  // namespace parley::sim

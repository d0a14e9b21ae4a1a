// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parley {

using Bytes = std::vector<std::uint8_t>;

/// Writes numbers of any width one after the other, the most significant bit first.
class BitWriter {
 public:
  /// The lowest `count` bits of `value`; count in [0, 64].
  void bits(std::uint64_t value, int count);
  void flag(bool value) { bits(value ? 1 : 0, 1); }
  /// Exponential Golomb code of an order in [0, 15]: short for small values. `value` below 2^31.
  void golomb(std::uint32_t value, int order);
  /// The same for signed values within +-2^30: 0, -1, 1, -2, ...
  void signedGolomb(std::int32_t value, int order);
  /// Zeros up to the next byte, then the bytes as they are.
  void bytes(const Bytes& bytes);

  std::size_t bitCount() const { return bit_count_; }
  /// What was written, the last byte filled with zeros.
  const Bytes& data() const { return data_; }

 private:
  Bytes data_;
  std::size_t bit_count_ = 0;
};

/// Reads what BitWriter wrote. Past the end, or at a code that is too long, everything reads as 0 and ok() stays false.
class BitReader {
 public:
  BitReader(const std::uint8_t* data, std::size_t size) : data_(data), bit_size_(8 * size) {}
  explicit BitReader(const Bytes& bytes) : BitReader(bytes.data(), bytes.size()) {}

  std::uint64_t bits(int count);
  bool flag() { return bits(1) != 0; }
  std::uint32_t golomb(int order);
  std::int32_t signedGolomb(int order);
  Bytes bytes(std::size_t count);

  bool ok() const { return ok_; }
  void fail() { ok_ = false; }
  std::size_t remainingBits() const { return bit_size_ - position_; }
  std::size_t position() const { return position_; }

 private:
  const std::uint8_t* data_;
  std::size_t bit_size_;      // [-]
  std::size_t position_ = 0;  // [-] of the next bit
  bool ok_ = true;
};

/// Bits that BitWriter::golomb spends.
int golombLength(std::uint32_t value, int order);

/// 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
inline std::uint32_t zigZag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ (value < 0 ? 0xffffffffU : 0U);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parley {

/// How likely a bit is set, learnt as bits go by. Integers alone, so that all machines learn the same.
class AdaptiveBit {
 public:
  explicit AdaptiveBit(std::uint32_t probability = 32768) : probability_(probability) {}

  std::uint32_t probability() const { return probability_; }
  /// Fast at first, slower once there is something to lose.
  void learn(bool bit);

 private:
  std::uint32_t probability_;  // [-] of a set bit, in 65536ths
  std::uint32_t seen_ = 0;     // [-]
};

/// Binary arithmetic coding: a bit of probability p costs log2(1/p) bits.
class RangeEncoder {
 public:
  void encode(bool bit, AdaptiveBit& model);
  void encodeRaw(bool bit);
  /// The bytes; nothing may be encoded after it.
  std::vector<std::uint8_t> finish();

 private:
  void narrow(bool bit, std::uint32_t probability);

  std::uint32_t low_ = 0, high_ = 0xFFFFFFFFU;
  std::vector<std::uint8_t> bytes_;
};

/// Reads what RangeEncoder wrote. Behind the end it reads zeros, so that any bytes decode to something.
class RangeDecoder {
 public:
  RangeDecoder(const std::uint8_t* bytes, std::size_t size);

  bool decode(AdaptiveBit& model);
  bool decodeRaw();

 private:
  bool narrow(std::uint32_t probability);
  std::uint8_t next() { return position_ < size_ ? bytes_[position_++] : std::uint8_t{0}; }

  const std::uint8_t* bytes_;
  std::size_t size_;          // [-]
  std::size_t position_ = 0;  // [-]
  std::uint32_t low_ = 0, high_ = 0xFFFFFFFFU, code_ = 0;
};

}  // namespace parley

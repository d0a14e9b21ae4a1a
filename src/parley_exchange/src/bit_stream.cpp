// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/bit_stream.h"

#include <cassert>

namespace parley {
namespace {

int bitLength(std::uint64_t value) {
  int length = 0;
  for (; value != 0; value >>= 1) ++length;
  return length;
}

}  // namespace

void BitWriter::bits(std::uint64_t value, int count) {
  assert(count >= 0 && count <= 64);
  for (int i = count - 1; i >= 0; --i) {
    if (bit_count_ % 8 == 0) data_.push_back(0);
    if ((value >> i) & 1U) data_.back() = static_cast<std::uint8_t>(data_.back() | (0x80U >> (bit_count_ % 8)));
    ++bit_count_;
  }
}

void BitWriter::golomb(std::uint32_t value, int order) {
  assert(order >= 0 && order <= 15);
  const std::uint64_t shifted = static_cast<std::uint64_t>(value) + (1ULL << order);
  const int length = bitLength(shifted);
  bits(0, length - 1 - order);
  bits(shifted, length);
}

void BitWriter::signedGolomb(std::int32_t value, int order) { golomb(zigZag(value), order); }

void BitWriter::bytes(const Bytes& bytes) {
  bit_count_ = 8 * data_.size();
  data_.insert(data_.end(), bytes.begin(), bytes.end());
  bit_count_ += 8 * bytes.size();
}

std::uint64_t BitReader::bits(int count) {
  assert(count >= 0 && count <= 64);
  if (!ok_ || remainingBits() < static_cast<std::size_t>(count)) {
    ok_ = false;
    return 0;
  }
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i, ++position_) {
    value = (value << 1) | ((data_[position_ / 8] >> (7 - position_ % 8)) & 1U);
  }
  return value;
}

std::uint32_t BitReader::golomb(int order) {
  int zeros = 0;
  while (ok_ && !flag()) {
    if (++zeros + order > 31) fail();
  }
  if (!ok_) return 0;
  const int rest = zeros + order;
  const std::uint64_t shifted = (1ULL << rest) | bits(rest);
  return ok_ ? static_cast<std::uint32_t>(shifted - (1ULL << order)) : 0;
}

std::int32_t BitReader::signedGolomb(int order) {
  const std::uint32_t value = golomb(order);
  return static_cast<std::int32_t>(value >> 1) ^ -static_cast<std::int32_t>(value & 1U);
}

Bytes BitReader::bytes(std::size_t count) {
  const std::size_t begin = (position_ + 7) / 8;
  if (!ok_ || 8 * (begin + count) > bit_size_) {
    ok_ = false;
    return {};
  }
  position_ = 8 * (begin + count);
  return Bytes(data_ + begin, data_ + begin + count);
}

int golombLength(std::uint32_t value, int order) {
  const int length = bitLength(static_cast<std::uint64_t>(value) + (1ULL << order));
  return 2 * length - 1 - order;
}

}  // namespace parley

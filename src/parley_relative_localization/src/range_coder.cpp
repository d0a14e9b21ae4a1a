// SPDX-License-Identifier: BSD-3-Clause
#include "range_coder.h"

#include <algorithm>

namespace parley {
namespace {

constexpr std::uint32_t kOne = 65536;        // [-] probability of what is certain
constexpr std::uint32_t kLeast = 512;        // [-] least probability, so that the rare stays affordable
constexpr std::uint32_t kHalf = kOne / 2;    // [-]
constexpr std::uint32_t kSlowest = 24;       // [-] bits over which a settled model averages
constexpr std::uint32_t kTop = 0xFF000000U;  // the byte that is written next

/// The last value of the interval that stands for a set bit.
std::uint32_t split(std::uint32_t low, std::uint32_t high, std::uint32_t probability) {
  return low + static_cast<std::uint32_t>((static_cast<std::uint64_t>(high - low) * probability) >> 16U);
}

}  // namespace

void AdaptiveBit::learn(bool bit) {
  const std::uint32_t weight = std::min(seen_ + 5, kSlowest);
  if (bit) {
    probability_ += (kOne - kLeast - probability_) / weight;
  } else {
    probability_ -= (probability_ - kLeast) / weight;
  }
  ++seen_;
}

void RangeEncoder::narrow(bool bit, std::uint32_t probability) {
  const std::uint32_t middle = split(low_, high_, probability);
  if (bit) {
    high_ = middle;
  } else {
    low_ = middle + 1;
  }
  while (((low_ ^ high_) & kTop) == 0) {
    bytes_.push_back(static_cast<std::uint8_t>(high_ >> 24U));
    low_ <<= 8U;
    high_ = (high_ << 8U) | 0xFFU;
  }
}

void RangeEncoder::encode(bool bit, AdaptiveBit& model) {
  narrow(bit, model.probability());
  model.learn(bit);
}

void RangeEncoder::encodeRaw(bool bit) { narrow(bit, kHalf); }

std::vector<std::uint8_t> RangeEncoder::finish() {
  // The first bytes of low and high differ, so one more byte, with zeros behind it, lies between them.
  if (low_ > 0) bytes_.push_back(static_cast<std::uint8_t>((low_ >> 24U) + 1));
  while (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
  return bytes_;
}

RangeDecoder::RangeDecoder(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), size_(size) {
  for (int i = 0; i < 4; ++i) code_ = (code_ << 8U) | next();
}

bool RangeDecoder::narrow(std::uint32_t probability) {
  const std::uint32_t middle = split(low_, high_, probability);
  const bool bit = code_ <= middle;
  if (bit) {
    high_ = middle;
  } else {
    low_ = middle + 1;
  }
  while (((low_ ^ high_) & kTop) == 0) {
    low_ <<= 8U;
    high_ = (high_ << 8U) | 0xFFU;
    code_ = (code_ << 8U) | next();
  }
  return bit;
}

bool RangeDecoder::decode(AdaptiveBit& model) {
  const bool bit = narrow(model.probability());
  model.learn(bit);
  return bit;
}

bool RangeDecoder::decodeRaw() { return narrow(kHalf); }

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/seal.h"

#include <sodium.h>

#include <cassert>
#include <stdexcept>

namespace parley {
namespace {

constexpr std::size_t kMaxKeys = 256;  // [-]
constexpr char kPurpose[] = "parley 1";

using Nonce = std::array<std::uint8_t, crypto_aead_chacha20poly1305_IETF_NPUBBYTES>;

void appendNumber(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

std::uint32_t numberAt(const Bytes& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = (number << 8) | bytes[at + i];
  return number;
}

/// Eight zeros and the counter.
Nonce nonceOf(std::uint32_t counter) {
  Nonce nonce{};
  for (std::size_t i = 0; i < 4; ++i) nonce[8 + i] = static_cast<std::uint8_t>(counter >> (24 - 8 * i));
  return nonce;
}

}  // namespace

std::optional<FrameHeader> readHeader(const Bytes& frame) {
  if (frame.size() < kFrameBytes || frame.size() > kMaxDatagram || frame[0] != kWireVersion) return std::nullopt;
  return FrameHeader{numberAt(frame, 1), numberAt(frame, 5), numberAt(frame, 9)};
}

Sealer::Sealer(const TeamKey& team_key) : team_key_(team_key) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot start on this machine");
}

const Sealer::Key& Sealer::keyOf(const FrameHeader& header) {
  const auto name = std::make_pair(header.sender, header.boot);
  const auto known = keys_.find(name);
  if (known != keys_.end()) return known->second;
  if (keys_.size() >= kMaxKeys) keys_.clear();
  Bytes message(kPurpose, kPurpose + sizeof(kPurpose) - 1);
  appendNumber(message, header.sender);
  appendNumber(message, header.boot);
  Key key{};
  crypto_generichash(key.data(), key.size(), message.data(), message.size(), team_key_.data(), team_key_.size());
  return keys_.emplace(name, key).first->second;
}

Bytes Sealer::seal(const FrameHeader& header, const Bytes& plain) {
  assert(plain.size() + kFrameBytes <= kMaxDatagram);
  Bytes frame{kWireVersion};
  appendNumber(frame, header.sender);
  appendNumber(frame, header.boot);
  appendNumber(frame, header.counter);
  frame.resize(kFrameBytes + plain.size());
  const Nonce nonce = nonceOf(header.counter);
  crypto_aead_chacha20poly1305_ietf_encrypt(frame.data() + kHeaderBytes, nullptr, plain.data(), plain.size(), frame.data(),
                                            kHeaderBytes, nullptr, nonce.data(), keyOf(header).data());
  return frame;
}

std::optional<Bytes> Sealer::open(const FrameHeader& header, const Bytes& frame) {
  Bytes plain(frame.size() - kFrameBytes);
  const Nonce nonce = nonceOf(header.counter);
  const int result = crypto_aead_chacha20poly1305_ietf_decrypt(plain.data(), nullptr, nullptr, frame.data() + kHeaderBytes,
                                                               frame.size() - kHeaderBytes, frame.data(), kHeaderBytes,
                                                               nonce.data(), keyOf(header).data());
  return result == 0 ? std::make_optional(plain) : std::nullopt;
}

}  // namespace parley

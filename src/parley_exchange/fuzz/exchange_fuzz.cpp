// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>

#include "parley_exchange/exchange.h"
#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"

using namespace parley;

/// Any bytes, as a member of the team could seal them: decoded, printed, encoded again, and given to an exchange.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kMaxDatagram - kFrameBytes) return 0;
  const Bytes plain(data, data + size);
  const PacketContent content = decodePacket(plain);
  describe(content);
  const Bytes again = encodePacket(content);
  if (encodePacket(decodePacket(again)) != again) __builtin_trap();

  ExchangeIdentity identity;
  identity.name = "victim";
  identity.key = simulatedTeamKey(1);
  identity.footprint = {0.8, 0.4};
  identity.limits = {2.0, 1.5, 2.0, 4.0};
  Exchange exchange(ExchangeOptions(), identity);
  exchange.setOdometry({}, DriveState::kStopped);
  Sealer sealer(identity.key);
  for (std::uint32_t counter = 1; counter <= 2; ++counter) exchange.addPacket(sealer.seal({77, 1, counter}, plain), counter);
  exchange.step(3.0);
  for (const RobotId origin : exchange.origins()) {
    exchange.contoursOf(origin);
    exchange.anchorsOf(origin);
    exchange.keyframesOf(origin, 3.0);
  }
  for (const PeerState& peer : exchange.peers(3.0)) exchange.trajectoryOf(peer.id, 3.0);
  exchange.edges();
  return 0;
}

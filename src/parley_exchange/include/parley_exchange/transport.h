// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "parley_exchange/bit_stream.h"

namespace parley {

/// Carries datagrams, or loses them. Neither call waits. Time is that of the caller; what needs none ignores it.
class Transport {
 public:
  virtual ~Transport() = default;

  /// To everybody in reach. False if it could not be sent, which `problem` explains.
  virtual bool send(const Bytes& datagram, double now) = 0;
  /// What has come by now, in the order of arrival.
  virtual std::vector<Bytes> receive(double now) = 0;
  /// Why the last send or receive failed; empty if it did not.
  virtual std::string problem() const { return {}; }
};

}  // namespace parley

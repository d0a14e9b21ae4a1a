// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "parley_exchange/transport.h"

namespace parley {

/// A radio within one process: what one end sends, all others receive.
class LoopbackBus {
 public:
  /// An end, which may outlive the bus. Each holds at most 1000 datagrams that were not received; older ones are lost.
  std::unique_ptr<Transport> connect();

 private:
  struct Queue;
  struct Ends;
  class End;
  std::shared_ptr<Ends> ends_;
};

}  // namespace parley

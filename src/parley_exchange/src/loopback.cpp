// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/loopback.h"

#include <algorithm>

namespace parley {
namespace {

constexpr std::size_t kMaxQueue = 1000;  // [-]

}  // namespace

struct LoopbackBus::Queue {
  std::deque<Bytes> datagrams;
};

struct LoopbackBus::Ends {
  std::vector<std::weak_ptr<Queue>> queues;
};

class LoopbackBus::End : public Transport {
 public:
  explicit End(std::shared_ptr<Ends> ends) : ends_(std::move(ends)), own_(std::make_shared<Queue>()) {
    ends_->queues.push_back(own_);
  }

  bool send(const Bytes& datagram, double /*now*/) override {
    auto& queues = ends_->queues;
    queues.erase(std::remove_if(queues.begin(), queues.end(), [](const auto& queue) { return queue.expired(); }), queues.end());
    for (const auto& other : queues) {
      const std::shared_ptr<Queue> queue = other.lock();
      if (queue == own_) continue;
      queue->datagrams.push_back(datagram);
      if (queue->datagrams.size() > kMaxQueue) queue->datagrams.pop_front();
    }
    return true;
  }

  std::vector<Bytes> receive(double /*now*/) override {
    std::vector<Bytes> datagrams(own_->datagrams.begin(), own_->datagrams.end());
    own_->datagrams.clear();
    return datagrams;
  }

 private:
  std::shared_ptr<Ends> ends_;
  std::shared_ptr<Queue> own_;
};

std::unique_ptr<Transport> LoopbackBus::connect() {
  if (!ends_) ends_ = std::make_shared<Ends>();
  return std::make_unique<End>(ends_);
}

}  // namespace parley

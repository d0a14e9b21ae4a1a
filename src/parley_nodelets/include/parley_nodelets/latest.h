// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <utility>

namespace parley {

/// The newest message of a topic: callbacks put it in, the worker takes it out. `Pointer` is a shared pointer.
template <class Pointer>
class Latest {
 public:
  void put(Pointer message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    message_ = std::move(message);
  }

  /// The message, once; null if there is none since the last call.
  Pointer take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(message_, Pointer());
  }

 private:
  std::mutex mutex_;
  Pointer message_;
};

}  // namespace parley

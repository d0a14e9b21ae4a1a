// SPDX-License-Identifier: BSD-3-Clause
#include "replay_window.h"

#include <algorithm>

namespace parley {

bool ReplayWindow::accept(std::uint32_t counter) {
  if (counter == 0) return false;
  if (highest_ == 0) first_ = counter;
  if (counter > highest_) {
    const std::uint32_t step = counter - highest_;
    seen_ = step < kSize ? seen_ << step : std::bitset<kSize>();
    highest_ = counter;
  }
  const std::uint32_t back = highest_ - counter;
  if (back >= kSize || seen_[back]) return false;
  seen_[back] = true;
  return true;
}

double ReplayWindow::receivedShare() const {
  if (highest_ == 0) return 0.0;
  const std::size_t span = std::min<std::size_t>(64, highest_ - std::min(first_, highest_) + 1);
  std::size_t received = 0;
  for (std::size_t i = 0; i < span; ++i) received += seen_[i] ? 1 : 0;
  return static_cast<double>(received) / static_cast<double>(span);
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/progress.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace parley::sim {

Progress::Progress(std::ostream& stream, bool terminal)
    : stream_(stream), terminal_(terminal), start_(std::chrono::steady_clock::now()) {}

void Progress::note(const FleetRunner& runner) {
  const Simulation& simulation = runner.simulation();
  const double period = terminal_ ? 0.5 : 5.0;  // [s] simulated
  if (simulation.time() + 1e-9 < next_) return;
  next_ += period;
  const auto& records = simulation.referee().records();
  const auto reached = std::count_if(records.begin(), records.end(), [](const RobotRecord& r) { return r.reached; });
  const int collisions = simulation.referee().collisions(ContactKind::kStatic) +
                         simulation.referee().collisions(ContactKind::kRobot) +
                         simulation.referee().collisions(ContactKind::kMoving);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), "%7.1f of %.0f s, %d of %d reached, %d collisions, %.1f x real time", simulation.time(),
                simulation.scenario().duration, static_cast<int>(reached), static_cast<int>(records.size()), collisions,
                wall > 0.0 ? simulation.time() / wall : 0.0);
  stream_ << (terminal_ ? "\r" : "") << line.data() << (terminal_ ? "   " : "\n") << std::flush;
  line_open_ = terminal_;
}

void Progress::finish() {
  if (line_open_) stream_ << '\n' << std::flush;
  line_open_ = false;
}

}  // namespace parley::sim

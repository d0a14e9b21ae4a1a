// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/trace.h"

#include <array>
#include <cstdio>

#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

constexpr long kSteps = 5;  // of the simulation between two rows of a robot

}  // namespace

Trace::Trace(const std::string& file) : stream_(file) {
  if (!stream_) throw InputError("--trace: " + file + ": cannot be written");
  stream_ << "time,robot,x,y,yaw,speed,turn_rate,state\n";
}

void Trace::note(const FleetRunner& runner) {
  if (calls_++ % kSteps != 0) return;
  const Simulation& simulation = runner.simulation();
  for (std::size_t i = 0; i < simulation.truth().bodies.size(); ++i) {
    const Body& body = simulation.truth().bodies[i];
    if (!body.present) continue;
    const auto& [pose, twist] = body.state;
    std::array<char, 160> numbers{};
    std::snprintf(numbers.data(), numbers.size(), "%.4f,%.4f,%.5f,%.4f,%.4f", pose.x, pose.y, pose.yaw, twist.speed,
                  twist.turn_rate);
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.2f", simulation.time());
    stream_ << time.data() << ',' << simulation.scenario().robots[i].name << ',' << numbers.data() << ','
            << toString(runner.state(i)) << '\n';
  }
}

}  // namespace parley::sim

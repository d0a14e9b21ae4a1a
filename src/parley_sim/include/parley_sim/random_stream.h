// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace parley::sim {

/// Random numbers for one purpose of one robot. The seed, the robot's name and the purpose alone decide them, so that
/// nobody's noise depends on who else is there. Generator and distributions are fixed, the standard library's differ.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, const std::string& robot, const std::string& purpose);

  double uniform();                         // in [0, 1)
  double uniform(double low, double high);  // in [low, high)
  double normal();                          // mean 0, standard deviation 1

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace parley::sim

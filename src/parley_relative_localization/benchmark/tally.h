// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "study.h"

namespace parley::study {

/// The value below which a share of the values lies; 0 of none.
double quantile(std::vector<double> values, double share);

/// Sums over the encounters of a world, or of all.
struct Tally {
  int encounters = 0, confirmed = 0, early = 0, tentative = 0, wrong = 0, elsewhere = 0, wrong_elsewhere = 0;  // [-]
  int tentative_wrong = 0;  // [-] when first tentative
  std::vector<double> translation, rotation, travel, seconds, bytes, descriptors, consistency, steps;
  std::vector<double> tentative_translation, tentative_rotation;  // of those that were right

  void add(const Outcome& outcome);
  void addElsewhere(const Outcome& outcome);

  static void printHead();
  void print(const std::string& name) const;
  std::string json() const;
};

}  // namespace parley::study

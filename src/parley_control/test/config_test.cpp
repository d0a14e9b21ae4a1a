// SPDX-License-Identifier: BSD-3-Clause
#include "parley_control/control_options.h"
#include "parley_geometry/option_conformance.h"

namespace parley {

TEST(ControlOptions, theFileHoldsTheDefaults) {
  expectFileHoldsDefaults<ControlOptions>(PACKAGE_DIRECTORY "/../../config/control.yaml");
}

TEST(ControlOptions, theReadmeHoldsTheTable) { expectTableIn<ControlOptions>(PACKAGE_DIRECTORY "/README.md"); }

TEST(ControlOptions, defaultsAreWithinTheirRanges) { expectDefaultsInRange<ControlOptions>(); }

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

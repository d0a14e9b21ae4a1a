// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/option_conformance.h"
#include "parley_relative_localization/relative_localization_options.h"

namespace parley {

TEST(RelativeLocalizationOptions, theFileHoldsTheDefaults) {
  expectFileHoldsDefaults<RelativeLocalizationOptions>(RELATIVE_LOCALIZATION_YAML);
}

TEST(RelativeLocalizationOptions, theReadmeHoldsTheTable) {
  expectTableIn<RelativeLocalizationOptions>(RELATIVE_LOCALIZATION_README);
}

TEST(RelativeLocalizationOptions, defaultsAreWithinTheirRanges) { expectDefaultsInRange<RelativeLocalizationOptions>(); }

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/option_conformance.h"
#include "parley_lidar/lidar_options.h"

namespace parley {

TEST(LidarOptions, theFileHoldsTheDefaults) { expectFileHoldsDefaults<LidarOptions>(PARLEY_CONFIG_DIR "/lidar.yaml"); }

TEST(LidarOptions, theReadmeHoldsTheTable) {
  expectTableIn<LidarOptions>(PARLEY_LIDAR_DIR "/README.md");
  expectTableIn<LidarMount>(PARLEY_LIDAR_DIR "/README.md");
}

TEST(LidarOptions, defaultsAreWithinTheirRanges) {
  expectDefaultsInRange<LidarOptions>();
  expectDefaultsInRange<LidarMount>();
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/option_conformance.h"
#include "parley_topology/topology_options.h"

namespace parley {

TEST(TopologyOptions, theFileHoldsTheDefaults) { expectFileHoldsDefaults<TopologyOptions>(TOPOLOGY_YAML); }

TEST(TopologyOptions, theReadmeHoldsTheTable) { expectTableIn<TopologyOptions>(TOPOLOGY_README); }

TEST(TopologyOptions, defaultsAreWithinTheirRanges) { expectDefaultsInRange<TopologyOptions>(); }

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

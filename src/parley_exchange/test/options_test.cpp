// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/exchange_options.h"
#include "parley_geometry/option_conformance.h"

namespace parley {

TEST(ExchangeOptions, theFileHoldsTheDefaults) {
  expectFileHoldsDefaults<ExchangeOptions>(PACKAGE_DIRECTORY "/../../config/exchange.yaml");
}

TEST(ExchangeOptions, theReadmeHoldsTheTable) { expectTableIn<ExchangeOptions>(PACKAGE_DIRECTORY "/README.md"); }

TEST(ExchangeOptions, defaultsAreWithinTheirRanges) { expectDefaultsInRange<ExchangeOptions>(); }

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

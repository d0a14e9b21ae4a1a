// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/arguments.h"

#include <gtest/gtest.h>

#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

std::string messageOf(const std::vector<std::string>& words) {
  try {
    parseArguments(words);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ArgumentsTest, takesEverythingInAnyOrder) {
  const Arguments a =
      parseArguments({"--quiet", "--set",  "radio.range=3", "s.yaml", "--seed",   "12",    "--variant", "reactive",
                      "--set",   "seed=4", "--json",        "r.json", "--trace",  "t.csv", "--picture", "p.png",
                      "--bag",   "b.bag",  "--bag-robot",   "x",      "--config", "c"});
  EXPECT_TRUE(a.quiet);
  EXPECT_EQ(a.scenario, "s.yaml");
  EXPECT_EQ(a.variant, "reactive");
  ASSERT_EQ(a.overrides.size(), 3u);
  EXPECT_EQ(a.overrides[0], Override("radio.range", "3"));
  EXPECT_EQ(a.overrides[2], Override("seed", "12"));  // last
  EXPECT_EQ(a.json + a.trace + a.picture + a.bag + a.bag_robot + a.config, "r.jsont.csvp.pngb.bagxc");
  EXPECT_EQ(parseArguments({"s.yaml"}).variant, "full");
  EXPECT_TRUE(parseArguments({"--help"}).help);
}

TEST(ArgumentsTest, manyMomentsMayBeExplained) {
  const Arguments a = parseArguments({"--explain", "3.5", "x", "s.yaml", "--explain", "0", "y"});
  ASSERT_EQ(a.questions.size(), 2u);
  EXPECT_EQ(a.questions[0].time, 3.5);
  EXPECT_EQ(a.questions[0].robot + a.questions[1].robot, "xy");
}

TEST(ArgumentsTest, aValueMayHoldAnEqualsSign) {
  EXPECT_EQ(parseArguments({"s.yaml", "--set", "a.b=c=d"}).overrides[0], Override("a.b", "c=d"));
}

TEST(ArgumentsTest, saysWhatIsWrong) {
  EXPECT_EQ(messageOf({}), "SCENARIO.yaml: is missing; see fleet_run --help");
  EXPECT_EQ(messageOf({"a.yaml", "b.yaml"}), "b.yaml: one scenario at a time, there is a.yaml already");
  EXPECT_EQ(messageOf({"a.yaml", "--fast"}), "--fast: unknown argument; see fleet_run --help");
  EXPECT_EQ(messageOf({"a.yaml", "--seed"}), "--seed: its value is missing");
  EXPECT_EQ(messageOf({"a.yaml", "--seed", "-1"}), "--seed: -1: must be a whole number from 0 on");
  EXPECT_EQ(messageOf({"a.yaml", "--seed", "1.5"}), "--seed: 1.5: must be a whole number from 0 on");
  EXPECT_EQ(messageOf({"a.yaml", "--set", "x"}), "--set: x: must be KEY=VALUE");
  EXPECT_EQ(messageOf({"a.yaml", "--set", "=x"}), "--set: =x: must be KEY=VALUE");
  EXPECT_EQ(messageOf({"a.yaml", "--variant", "best"}),
            "--variant: best: must be full, no_sharing, no_conflict_resolution or reactive");
  EXPECT_EQ(messageOf({"a.yaml", "--picture", "p.bmp"}), "--picture: p.bmp: must end in .png");
  EXPECT_EQ(messageOf({"a.yaml", "--bag-robot", "x"}), "--bag-robot: needs --bag");
  EXPECT_EQ(messageOf({"a.yaml", "--explain", "3"}), "--explain: needs TIME and ROBOT");
  EXPECT_EQ(messageOf({"a.yaml", "--explain", "soon", "x"}), "--explain: soon: must be a time in seconds from 0 on");
  EXPECT_EQ(messageOf({"a.yaml", "--explain", "", "x"}), "--explain: : must be a time in seconds from 0 on");
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

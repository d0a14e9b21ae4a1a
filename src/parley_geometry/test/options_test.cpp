// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/options.h"

#include <gtest/gtest.h>

#include <limits>

#include "parley_geometry/footprint.h"
#include "parley_geometry/motion.h"
#include "parley_geometry/status.h"

namespace parley {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Sample {
  double rate = 10.0;
  int count = 3;
  bool loud = false;
  std::string name = "robot";

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("rate", rate, "Hz", 0.5, 50.0, "how often");
    v.integer("count", count, "-", 1, 8, "how many");
    v.flag("loud", loud, "whether it speaks");
    v.text("name", name, "who it is");
  }
};

TEST(Options, loadWhatIsGivenAndKeepTheRest) {
  Sample sample;
  const auto problems = loadOptions(sample, {{"rate", 25.5}, {"loud", true}, {"name", std::string("r2")}}, "file");
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(sample.rate, 25.5);
  EXPECT_EQ(sample.count, 3);
  EXPECT_TRUE(sample.loud);
  EXPECT_EQ(sample.name, "r2");
}

TEST(Options, aWholeNumberWillDoForANumberButNotTheOtherWayRound) {
  Sample sample;
  EXPECT_TRUE(loadOptions(sample, {{"rate", 20L}, {"count", 5L}}, "file").empty());
  EXPECT_EQ(sample.rate, 20.0);
  EXPECT_EQ(sample.count, 5);
  EXPECT_EQ(loadOptions(sample, {{"count", 5.0}}, "file").size(), 1u);
}

TEST(Options, allProblemsAreReportedAtOnce) {
  Sample sample;
  const OptionValues values{{"rate", 51.0}, {"count", 0L}, {"loud", std::string("yes")}, {"name", 3L}, {"speed", 1.0}};
  const auto problems = loadOptions(sample, values, "robot.yaml");
  const std::vector<std::string> expected{
      "robot.yaml: rate: value 51 is not within [0.5, 50] Hz", "robot.yaml: count: value 0 is not within [1, 8] -",
      "robot.yaml: loud: must be true or false", "robot.yaml: name: must be text", "robot.yaml: speed: unknown key"};
  EXPECT_EQ(problems, expected);
}

TEST(Options, wrongTypesAreRefused) {
  for (const OptionValue& value : {OptionValue(true), OptionValue(std::string("10"))}) {
    Sample sample;
    EXPECT_EQ(loadOptions(sample, {{"rate", value}}, "f"), std::vector<std::string>{"f: rate: must be a number"});
    EXPECT_EQ(loadOptions(sample, {{"count", value}}, "f"), std::vector<std::string>{"f: count: must be a whole number"});
  }
}

TEST(Options, theRangeIncludesItsEndsAndNothingElse) {
  for (const double good : {0.5, 50.0}) {
    Sample sample;
    EXPECT_TRUE(loadOptions(sample, {{"rate", good}}, "f").empty()) << good;
  }
  for (const double bad : {0.4999, 50.001, -kInfinity, kInfinity, kNaN}) {
    Sample sample;
    EXPECT_EQ(loadOptions(sample, {{"rate", bad}}, "f").size(), 1u) << bad;
  }
  Sample sample;
  EXPECT_EQ(loadOptions(sample, {{"count", 1L << 40}}, "f").size(), 1u) << "does not fit an int";
}

TEST(Options, listAndReadBack) {
  Sample sample;
  sample.rate = 12.25;
  sample.count = 7;
  sample.loud = true;
  sample.name = "";
  Sample copy;
  EXPECT_TRUE(loadOptions(copy, valuesOf(listOptions(sample)), "f").empty());
  EXPECT_EQ(copy.rate, 12.25);
  EXPECT_EQ(copy.count, 7);
  EXPECT_TRUE(copy.loud);
  EXPECT_EQ(copy.name, "");
}

TEST(Options, valuesSetInCodeAreChecked) {
  Sample sample;
  EXPECT_TRUE(checkOptions(sample, "code").empty());
  for (const double bad : {99.0, kNaN, -kInfinity}) {
    sample.rate = bad;
    EXPECT_EQ(checkOptions(sample, "code").size(), 1u) << bad;
  }
}

TEST(Options, robotsHaveNoDefault) {
  EXPECT_EQ(checkOptions(Footprint{}, "footprint").size(), 2u);
  EXPECT_EQ(checkOptions(MotionLimits{}, "limits").size(), 4u);
  EXPECT_TRUE(checkOptions(Footprint{0.8, 0.4}, "footprint").empty());
  EXPECT_TRUE(checkOptions(MotionLimits{2.0, 1.57, 2.0, 3.0}, "limits").empty());
}

TEST(Options, tableHasARowForEach) {
  const std::string expected =
      "| option | default | unit | range | what it does |\n"
      "|---|---|---|---|---|\n"
      "| `rate` | 10 | Hz | 0.5 .. 50 | how often |\n"
      "| `count` | 3 | - | 1 .. 8 | how many |\n"
      "| `loud` | false | - |  | whether it speaks |\n"
      "| `name` | robot | - |  | who it is |\n";
  EXPECT_EQ(optionTable(listOptions(Sample{})), expected);
}

TEST(Status, namesAreThoseOfTheTraces) {
  EXPECT_STREQ(toString(DriveState::kDriving), "driving");
  EXPECT_STREQ(toString(DriveState::kNoOdometry), "no_odometry");
  EXPECT_STREQ(toString(DriveState::kDead), "dead");
  const Status<DriveState> status(DriveState::kBlocked, "a door");
  EXPECT_TRUE(status.is(DriveState::kBlocked));
  EXPECT_FALSE(status.is(DriveState::kDriving));
  EXPECT_EQ(status.text, "a door");
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

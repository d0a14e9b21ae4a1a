// SPDX-License-Identifier: BSD-3-Clause
#include "planar_binning.h"

#include <gtest/gtest.h>

#include <limits>

#include "world.h"

namespace parley::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kFreeRange = std::numeric_limits<float>::infinity();

BinnedScan binned(const RangeScan& scan, const OdometryAt& robot, const LidarMount& mount = {}, LidarOptions options = {}) {
  const auto motion = ScanMotion::over(recorded(robot, scan.stamp, scan.stamp + 0.2), scan.stamp, durationOf(scan), mount);
  return PlanarBinning(options, kRobot, mount).bin(scan, *motion);
}

OdometryAt still() { return level(standing(0.0, 0.0)); }

RangeScan uniform(int beams, float range, double angle_min = -kPi, double view = 2.0 * kPi) {
  return {1.0, angle_min, view / beams, 0.0, 0.05, 4.0, std::vector<float>(static_cast<std::size_t>(beams), range)};
}

double bearingOf(std::size_t bin, std::size_t bins) {
  return -kPi + (static_cast<double>(bin) + 0.5) * 2.0 * kPi / static_cast<double>(bins);
}

TEST(PlanarBinning, CircleRoomSeenFromItsMiddleIsACircle) {
  const BinnedScan scan = binned(uniform(720, 3.0F), still());
  for (const float range : scan.ranges) EXPECT_EQ(range, 3.0F);
  EXPECT_EQ(scan.points.size(), 720U);
  EXPECT_EQ(scan.valid, 720);
  EXPECT_EQ(scan.beam_width, 1);
}

/// From (x, 0) in a circle of radius R: the exact distance to the wall.
TEST(PlanarBinning, CircleRoomSeenFromAsideIsExactForAnyMountAndBeamCount) {
  std::mt19937 random(3);
  const double radius = 3.0;
  const World world{{}, {{circle(radius, 2000)}}};
  for (const int beams : {181, 360, 719, 720, 1440}) {
    for (const double yaw : {0.0, 0.7, -3.0}) {
      Lidar lidar;
      lidar.beams = beams;
      lidar.mount = {0.3, -0.1, 0.5, yaw};
      const BinnedScan scan = binned(scanned(world, still(), lidar, 1.0, random), still(), lidar.mount);
      for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
        const Eigen::Vector2d d = Pose2{0.0, 0.0, bearingOf(bin, scan.ranges.size())}.direction();
        const double b = scan.origin.dot(d);
        const double exact = -b + std::sqrt(b * b + radius * radius - scan.origin.squaredNorm());
        ASSERT_NEAR(scan.ranges[bin], exact, 0.35 * 2.0 * kPi / beams + 0.002) << beams << " beams, bin " << bin;
      }
    }
  }
}

TEST(PlanarBinning, OutsideTheViewNothingIsKnown) {
  const BinnedScan scan = binned(uniform(181, kFreeRange, -0.5 * kPi, kPi), still());
  for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
    const double bearing = bearingOf(bin, scan.ranges.size());
    if (std::abs(std::abs(bearing) - 0.5 * kPi) < 0.02) continue;
    EXPECT_EQ(std::isnan(scan.ranges[bin]), std::abs(bearing) > 0.5 * kPi) << bearing;
  }
}

TEST(PlanarBinning, ReadingsByRep117) {
  struct Case {
    float reading;
    float expected;
    int dropped;
  };
  const float inf = std::numeric_limits<float>::infinity();
  // The lidar is ahead of the robot, so that what is close ahead of it is no part of the robot.
  for (const Case& c : {Case{kNan, kNan, 720}, Case{inf, inf, 0}, Case{4.0F, inf, 0}, Case{9.0F, inf, 0}, Case{-inf, 0.05F, 0},
                        Case{0.01F, 0.05F, 0}, Case{0.0F, kNan, 720}, Case{-1.0F, kNan, 720}}) {
    const BinnedScan scan = binned(uniform(720, c.reading), still(), {0.46, 0.0, 0.5, 0.0});
    const float ahead = scan.ranges[360];
    EXPECT_TRUE(ahead == c.expected || (std::isnan(ahead) && std::isnan(c.expected))) << c.reading << " gave " << ahead;
    EXPECT_EQ(scan.dropped, c.dropped) << c.reading;
  }
}

TEST(PlanarBinning, RangeMaxItselfIsFreeThoughItIsNoFloat) {
  RangeScan scan = uniform(720, 4.1F);
  scan.range_max = 4.1;
  EXPECT_TRUE(std::isinf(binned(scan, still()).ranges[10]));
}

TEST(PlanarBinning, MaxRangeCropsToFreeSpace) {
  LidarOptions options;
  options.max_range = 2.0;
  const BinnedScan scan = binned(uniform(720, 3.0F), still(), {}, options);
  EXPECT_EQ(scan.range_max, 2.0);
  EXPECT_TRUE(std::isinf(scan.ranges[0]));
  EXPECT_TRUE(scan.points.empty());
}

TEST(PlanarBinning, TheRobotItselfIsNoObstacleAndHidesWhatIsBehind) {
  RangeScan scan = uniform(720, 2.0F);
  for (std::size_t i = 100; i < 110; ++i) scan.ranges[i] = 0.15F;
  const BinnedScan result = binned(scan, still());
  for (std::size_t i = 100; i < 110; ++i) EXPECT_TRUE(std::isnan(result.ranges[i]));
  EXPECT_EQ(result.ranges[99], 2.0F);
  EXPECT_EQ(result.ranges[110], 2.0F);
}

TEST(PlanarBinning, MoreBeamsThanBinsKeepTheNearest) {
  RangeScan scan = uniform(7200, 3.0F);
  scan.ranges[3604] = 1.0F;
  const BinnedScan result = binned(scan, still());
  EXPECT_EQ(result.ranges[360], 1.0F);
  EXPECT_EQ(result.next_ranges[360], 3.0F);
  EXPECT_EQ(result.ranges[359], 3.0F);
}

TEST(PlanarBinning, ClockwiseBeamsAreSortedTheOtherWay) {
  RangeScan scan = uniform(720, 3.0F, kPi);
  scan.angle_increment = -scan.angle_increment;
  scan.ranges[180] = 1.0F;  // at +90 degrees
  const BinnedScan result = binned(scan, still());
  EXPECT_EQ(std::count(result.ranges.begin(), result.ranges.end(), 1.0F), 1);
  EXPECT_TRUE(result.ranges[540] == 1.0F || result.ranges[539] == 1.0F);
}

/// A scan taken in turning and driving, put together, must show the room as seen from its last place.
TEST(PlanarBinning, DeskewedScanShowsTheRoomFromWhereItEnded) {
  std::mt19937 random(5);
  const World world{box({-3.0, -2.5}, {3.2, 2.0}), {}};
  for (const double turn_rate : {-1.57, 0.0, 1.57}) {
    const OdometryAt robot = level(driving({0.2, 0.1, 0.4}, 2.0, turn_rate));
    Lidar lidar;
    lidar.duration = 0.1;
    lidar.mount = {0.2, 0.05, 0.4, 0.3};
    const BinnedScan scan = binned(scanned(world, robot, lidar, 0.3, random), robot, lidar.mount);
    const Pose2 end = robot(0.3 + lidar.duration).pose;
    const Pose2 eye = end * Pose2{scan.origin.x(), scan.origin.y(), 0.0};
    int unseen = 0;
    for (std::size_t bin = 0; bin < scan.ranges.size(); ++bin) {
      unseen += std::isnan(scan.ranges[bin]) ? 1 : 0;
      if (std::isnan(scan.ranges[bin])) continue;
      double error = kInf;  // a bin is half a degree wide: anything the wall shows within it is right
      for (double offset = -1.0; offset <= 1.0; offset += 0.25) {
        const double angle = bearingOf(bin, 720) + offset * 2.0 * kPi / 720 + eye.yaw;
        const double exact = cast(world.walls, {eye.x, eye.y, 0.4}, {std::cos(angle), std::sin(angle), 0.0});
        const bool free = std::isinf(scan.ranges[bin]);
        error = std::min(error, free ? std::max(0.0, scan.range_max - exact) : std::abs(scan.ranges[bin] - exact));
      }
      ASSERT_LT(error, 0.02) << "bin " << bin << " turning at " << turn_rate;
    }
    EXPECT_LT(unseen, 30) << "at the seam a turn away from it leaves a gap";
    EXPECT_NEAR(scan.range_max, 4.0 - 0.2, 0.02) << "the lidar moved 0.2 m, so it sees that much less far";
  }
}

TEST(PlanarBinning, DrivingTearsNoStripes) {
  std::mt19937 random(6);
  const World world{{}, {{circle(3.0, 400)}}};
  for (const int beams : {181, 360, 720, 1000}) {
    const OdometryAt robot = level(driving({0.0, 0.0, 0.0}, 2.0, 0.0));
    Lidar lidar;
    lidar.beams = beams;
    lidar.duration = 0.1;
    const BinnedScan scan = binned(scanned(world, robot, lidar, 0.0, random), robot);
    // At the seam behind the robot first and last beam are a scan's time apart.
    for (std::size_t bin = 30; bin < 690; ++bin) ASSERT_FALSE(std::isnan(scan.ranges[bin])) << beams << ", bin " << bin;
  }
}

TEST(PlanarBinning, BeamsOnTheFloorAreNoObstacleAndNotFreeBeyond) {
  std::mt19937 random(8);
  const OdometryAt braking = [](double t) { return Odometry{t, {}, {}, 0.0, 0.12}; };
  Lidar lidar;
  lidar.mount = {0.0, 0.0, 0.3, 0.0};
  const BinnedScan scan =
      binned(scanned({box({-20.0, -20.0}, {20.0, 20.0}), {}}, braking, lidar, 0.0, random), braking, lidar.mount);
  EXPECT_TRUE(std::isnan(scan.ranges[360])) << "ahead the floor is met at 2.5 m";
  EXPECT_TRUE(std::isinf(scan.ranges[0])) << "behind the lidar looks up";
  EXPECT_TRUE(std::isinf(scan.ranges[180])) << "aside it looks level";
  EXPECT_TRUE(scan.points.empty());
}

TEST(PlanarBinning, AVeryLowLidarSeesObstacles) {
  const LidarMount low{0.0, 0.0, 0.06, 0.0};
  const OdometryAt shaken = [](double t) { return Odometry{t, {}, {}, 0.003, -0.002}; };
  const BinnedScan scan = binned(uniform(720, 2.0F), shaken, low);
  for (const float range : scan.ranges) EXPECT_NEAR(range, 2.0F, 1e-3);
}

TEST(PlanarProblem, SaysWhatIsWrong) {
  const LidarOptions options;
  const auto problem = [&](auto change) {
    RangeScan scan = uniform(360, 1.0F);
    change(scan);
    return planarProblem(scan, options);
  };
  EXPECT_EQ(problem([](RangeScan&) {}), "");
  EXPECT_NE(problem([](RangeScan& s) { s.ranges.clear(); }), "");
  EXPECT_NE(problem([](RangeScan& s) { s.ranges.resize(20001); }), "");
  for (const double bad : {std::nan(""), kInf, -kInf, 1e300}) {
    EXPECT_NE(problem([&](RangeScan& s) { s.angle_min = bad; }), "") << bad;
    EXPECT_NE(problem([&](RangeScan& s) { s.angle_increment = bad; }), "") << bad;
    EXPECT_NE(problem([&](RangeScan& s) { s.time_increment = bad; }), "") << bad;
    EXPECT_NE(problem([&](RangeScan& s) { s.range_min = bad; }), "") << bad;
  }
  EXPECT_NE(problem([](RangeScan& s) { s.angle_increment = 0.0; }), "");
  EXPECT_NE(problem([](RangeScan& s) { s.angle_increment = 1.0; }), "");
  EXPECT_NE(problem([](RangeScan& s) { s.time_increment = -0.001; }), "");
  EXPECT_NE(problem([](RangeScan& s) { s.time_increment = 0.01; }), "");
  EXPECT_NE(problem([](RangeScan& s) { s.range_min = 5.0; }), "");
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_NE(problem([&](RangeScan& s) { s.range_max = bad; }), "") << bad;
  }
}

}  // namespace
}  // namespace parley::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

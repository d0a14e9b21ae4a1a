// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/committed_plan.h"

#include <gtest/gtest.h>

#include "parley_robot/periodic.h"

namespace parley {
namespace {

PlanResult planTo(double x, double start_time) {
  PlanResult result;
  result.status = {PlanCode::kDriving, ""};
  result.keep_committed = false;
  result.trajectory = SampledTrajectory({{start_time, {}, {}}, {start_time + 1.0, {x, 0.0, 0.0}, {}}});
  return result;
}

TEST(CommittedPlan, TakesEffectAtItsStartTime) {
  CommittedPlan plan;
  plan.offer(planTo(1.0, 0.05), 0.0, 0.05);
  plan.advance(0.04);
  EXPECT_TRUE(plan.trajectory().empty());
  plan.advance(0.05);
  ASSERT_FALSE(plan.trajectory().empty());
  EXPECT_EQ(plan.state(), DriveState::kDriving);
  EXPECT_EQ(plan.stamp(), 0.0);
  EXPECT_EQ(plan.count(), 1);
}

TEST(CommittedPlan, KeepingConfirmsWithoutReplacing) {
  CommittedPlan plan;
  plan.offer(planTo(1.0, 0.05), 0.0, 0.05);
  plan.advance(0.05);
  PlanResult keep = planTo(9.0, 0.15);
  keep.keep_committed = true;
  plan.offer(keep, 0.1, 0.15);
  plan.advance(0.15);
  EXPECT_EQ(plan.trajectory().points().back().pose.x, 1.0);
  EXPECT_EQ(plan.stamp(), 0.1);
  EXPECT_EQ(plan.count(), 1);
}

TEST(CommittedPlan, FailureWithoutTrajectoryLeavesTheCommittedOneAndItsAge) {
  CommittedPlan plan;
  plan.offer(planTo(1.0, 0.05), 0.0, 0.05);
  plan.advance(0.05);
  PlanResult failed;
  failed.status = {PlanCode::kNoPath, "walled in"};
  failed.keep_committed = false;
  plan.offer(failed, 0.1, 0.15);
  plan.advance(0.2);
  EXPECT_EQ(plan.trajectory().points().back().pose.x, 1.0);
  EXPECT_EQ(plan.stamp(), 0.0);
  EXPECT_EQ(plan.state(), DriveState::kBlocked);
  EXPECT_EQ(plan.reason(), "walled in");
}

TEST(CommittedPlan, ClearForgetsAllButTheCount) {
  CommittedPlan plan;
  plan.offer(planTo(1.0, 0.05), 0.0, 0.05);
  plan.advance(0.05);
  plan.clear();
  EXPECT_TRUE(plan.trajectory().empty());
  EXPECT_EQ(plan.count(), 1);
}

TEST(CommittedPlan, EveryPlanCodeHasAState) {
  EXPECT_EQ(driveStateOf(PlanCode::kDriving), DriveState::kDriving);
  EXPECT_EQ(driveStateOf(PlanCode::kArrived), DriveState::kArrived);
  EXPECT_EQ(driveStateOf(PlanCode::kNoRoute), DriveState::kNoRoute);
  EXPECT_EQ(driveStateOf(PlanCode::kNoPath), DriveState::kBlocked);
  EXPECT_EQ(driveStateOf(PlanCode::kBlocked), DriveState::kBlocked);
  EXPECT_EQ(driveStateOf(PlanCode::kWaiting), DriveState::kWaiting);
  EXPECT_EQ(driveStateOf(PlanCode::kYielding), DriveState::kYielding);
  EXPECT_EQ(driveStateOf(PlanCode::kEscaping), DriveState::kEscaping);
}

TEST(Periodic, RunsAtItsRateAndDoesNotBurstAfterAPause) {
  Periodic timer(10.0);
  int runs = 0;
  for (int i = 0; i < 100; ++i) runs += timer.due(i * 0.02) ? 1 : 0;
  EXPECT_EQ(runs, 20);
  EXPECT_TRUE(timer.due(60.0));
  EXPECT_FALSE(timer.due(60.02));
  EXPECT_TRUE(timer.due(1.0)) << "time went back";
}

TEST(PlanTrigger, PlansOnEachScanAndWithoutScansAtAboutTheRate) {
  PlanTrigger with_scans(10.0), without(10.0);
  int planned = 0, blind = 0;
  for (int i = 0; i < 100; ++i) {
    planned += with_scans.due(0.02 * i, i % 5 == 3) ? 1 : 0;
    blind += without.due(0.02 * i, false) ? 1 : 0;
  }
  EXPECT_NEAR(planned, 20, 1);
  EXPECT_NEAR(blind, 17, 1);
  EXPECT_TRUE(without.due(0.5, false)) << "time went back";
}

TEST(PlanTrigger, ScansThatComeTooFastDoNotRaiseTheRateBeyondTwice) {
  PlanTrigger trigger(10.0);
  int planned = 0;
  for (int i = 0; i < 1000; ++i) planned += trigger.due(0.002 * i, true) ? 1 : 0;
  EXPECT_NEAR(planned, 40, 1);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

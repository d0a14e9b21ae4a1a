// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/committed_plan.h"

namespace parley {

DriveState driveStateOf(PlanCode code) {
  switch (code) {
    case PlanCode::kDriving:
      return DriveState::kDriving;
    case PlanCode::kArrived:
      return DriveState::kArrived;
    case PlanCode::kNoRoute:
      return DriveState::kNoRoute;
    case PlanCode::kWaiting:
      return DriveState::kWaiting;
    case PlanCode::kYielding:
      return DriveState::kYielding;
    case PlanCode::kEscaping:
      return DriveState::kEscaping;
    case PlanCode::kNoPath:
    case PlanCode::kBlocked:
      break;
  }
  return DriveState::kBlocked;
}

void CommittedPlan::offer(const PlanResult& result, double made_at, double start_time) {
  pending_ = Pending{result, made_at, start_time};
}

void CommittedPlan::advance(double now) {
  if (!pending_ || now + 1e-9 < pending_->start_time) return;
  const PlanResult& result = pending_->result;
  state_ = driveStateOf(result.status.code);
  reason_ = result.status.text;
  if (result.keep_committed) {
    stamp_ = pending_->made_at;
  } else if (!result.trajectory.empty()) {
    trajectory_ = result.trajectory;
    stamp_ = pending_->made_at;
    ++count_;
  }
  pending_.reset();
}

void CommittedPlan::clear() {
  const int count = count_;
  *this = CommittedPlan();
  count_ = count;
}

}  // namespace parley

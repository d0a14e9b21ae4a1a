// SPDX-License-Identifier: BSD-3-Clause
#include "emergency_stop.h"
#include "pipeline.h"

namespace parley {

PlanResult Planner::Pipeline::commit(const Proposal& proposal, PlanCode code) {
  code_ = code;
  path_ = proposal.path;
  busy_until_ = proposal.busy_until;
  PlanResult result = keep(code, code == PlanCode::kDriving ? "" : "another goes first");
  result.keep_committed = false;
  result.trajectory = proposal.trajectory;
  return result;
}

PlanResult Planner::Pipeline::brake(const PlanRequest& request, const TrajectoryPoint& start, PlanCode code,
                                    const std::string& why) {
  busy_until_ = -1e9;
  PlanResult result = keep(code, why);
  result.keep_committed = false;
  result.trajectory = safestStop(validator_, request.committed, start, limits_, options_.time_step);
  return result;
}

PlanResult Planner::Pipeline::keep(PlanCode code, const std::string& why) const {
  PlanResult result;
  result.status = {code, why};
  result.keep_committed = true;
  result.local_goal = local_goal_;
  result.path = path_;
  result.speed_bound = speed_bound_;
  result.intent = intent_;
  result.escape = escape_;
  result.escapes = escapes_;
  return result;
}

}  // namespace parley

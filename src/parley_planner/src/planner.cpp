// SPDX-License-Identifier: BSD-3-Clause
#include "parley_planner/planner.h"

#include <stdexcept>

#include "pipeline.h"

namespace parley {

namespace {

template <class Options>
void refuse(const Options& options, const char* what) {
  const std::vector<std::string> problems = checkOptions(options, what);
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  if (!problems.empty()) throw std::invalid_argument(text);
}

}  // namespace

Planner::Planner(const PlannerOptions& options, const Footprint& footprint, const MotionLimits& limits) {
  refuse(options, "planner");
  refuse(footprint, "footprint");
  refuse(limits, "limits");
  pipeline_ = std::make_unique<Pipeline>(options, footprint, limits);
}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

PlanResult Planner::plan(const PlanRequest& request) {
  PlanResult result = pipeline_->plan(request);
  result.trajectory_time = pipeline_->trajectoryTime();
  return result;
}

void Planner::reset() { pipeline_->reset(); }

}  // namespace parley

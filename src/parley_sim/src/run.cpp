// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/run.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

#include "parley_sim/bag_recorder.h"
#include "parley_sim/input_error.h"
#include "parley_sim/picture.h"
#include "parley_sim/progress.h"
#include "parley_sim/stack_brain.h"
#include "parley_sim/trace.h"
#include "parley_sim/world_loader.h"

namespace parley::sim {
namespace {

/// Better to find out now than after an hour.
void checkWritable(const std::string& argument, const std::string& file) {
  if (!file.empty() && !std::ofstream(file, std::ios::app)) throw InputError(argument + ": " + file + ": cannot be written");
}

std::size_t robotNamed(const Scenario& scenario, const std::string& name, const std::string& argument) {
  const auto found = std::find_if(scenario.robots.begin(), scenario.robots.end(),
                                  [&name](const RobotSpec& robot) { return robot.name == name; });
  if (found == scenario.robots.end()) throw InputError(argument + ": " + name + ": there is no such robot in " + scenario.file);
  return static_cast<std::size_t>(found - scenario.robots.begin());
}

/// Answers a question once its time has come.
StepObserver answerTo(const Question& question, const Scenario& scenario) {
  const std::size_t robot = robotNamed(scenario, question.robot, "--explain");
  std::ostringstream name;
  name << "explain_" << question.robot << '_' << question.time << ".png";
  return [robot, question, file = name.str(), done = false](const FleetRunner& runner) mutable {
    if (done || runner.simulation().time() < question.time - 1e-6 || !runner.brain(robot)) return;
    done = true;
    std::cout << question.robot << " at " << question.time << " s, see " << file << "\n" << runner.brain(robot)->explain(file);
  };
}

std::vector<StepObserver> observersFor(const Arguments& arguments, const Scenario& scenario) {
  std::vector<StepObserver> observers;
  if (!arguments.trace.empty()) {
    observers.emplace_back([trace = std::make_shared<Trace>(arguments.trace)](const FleetRunner& r) { trace->note(r); });
  }
  if (!arguments.bag.empty()) {
    const std::size_t robot = arguments.bag_robot.empty() ? 0 : robotNamed(scenario, arguments.bag_robot, "--bag-robot");
    observers.push_back(recordBag(arguments.bag, robot));
  }
  for (const Question& question : arguments.questions) observers.push_back(answerTo(question, scenario));
  return observers;
}

/// Returns the wall time it took. [s]
double drive(FleetRunner& runner, const std::vector<StepObserver>& observers) {
  const auto start = std::chrono::steady_clock::now();
  for (const StepObserver& observe : observers) observe(runner);
  while (!runner.finished()) {
    runner.step();
    for (const StepObserver& observe : observers) observe(runner);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Result runFleet(const Arguments& arguments) {
  const Scenario scenario = loadScenario(arguments.scenario, arguments.overrides);
  const World world = loadWorld(scenario.map);
  checkStarts(scenario, world);
  checkWritable("--json", arguments.json);
  checkWritable("--picture", arguments.picture);
  FleetRunner runner(scenario, world, stackBrains(arguments.config, arguments.variant));
  std::vector<StepObserver> observers = observersFor(arguments, scenario);
  Picture picture;
  if (!arguments.picture.empty()) observers.emplace_back([&picture](const FleetRunner& r) { picture.note(r); });
  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0);
  if (!arguments.quiet) observers.emplace_back([&progress](const FleetRunner& r) { progress.note(r); });

  const double wall = drive(runner, observers);
  progress.finish();
  Result result = resultOf(runner, arguments.variant, wall);
  if (!arguments.json.empty()) std::ofstream(arguments.json) << toJson(result);
  if (!arguments.picture.empty()) picture.write(arguments.picture, runner);
  return result;
}

}  // namespace parley::sim

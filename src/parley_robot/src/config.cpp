// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/config.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <regex>

namespace parley {
namespace {

constexpr std::uint32_t kMostBoots = 1U << 24;  // [-] the upper bits of what is told

OptionValue typedValue(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text == "true" || text == "false") return text == "true";
  static const std::regex kWhole("[-+]?[0-9]{1,18}");
  if (std::regex_match(text, kWhole)) return std::stol(text);
  double real = 0.0;
  if (YAML::convert<double>::decode(node, real)) return real;
  return text;
}

template <class Options>
bool loadStage(const std::filesystem::path& path, Options& options, std::vector<std::string>& problems) {
  if (!std::filesystem::exists(path)) return false;
  const OptionFile file = readOptionFile(path.string());
  problems.insert(problems.end(), file.problems.begin(), file.problems.end());
  const std::vector<std::string> more = loadOptions(options, file.values, path.string());
  problems.insert(problems.end(), more.begin(), more.end());
  return true;
}

template <class Options>
void collect(const Options& options, const std::string& source, std::vector<std::string>& problems) {
  const std::vector<std::string> more = checkOptions(options, source);
  problems.insert(problems.end(), more.begin(), more.end());
}

}  // namespace

OptionFile readOptionFile(const std::string& path) {
  OptionFile file;
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (root.IsNull()) return file;
    if (!root.IsMap()) {
      file.problems.push_back(path + ": must be a list of `key: value`");
      return file;
    }
    for (const auto& entry : root) {
      const std::string key = entry.first.as<std::string>();
      if (entry.second.IsScalar()) {
        file.values[key] = typedValue(entry.second);
      } else {
        file.problems.push_back(std::string(path).append(": ").append(key).append(": must be a single value"));
      }
    }
  } catch (const YAML::Exception& error) {
    file.problems.push_back(path + ": " + error.what());
  }
  return file;
}

std::vector<std::string> loadConfig(const std::string& directory, RobotOptions& options) {
  const std::filesystem::path folder(directory);
  std::vector<std::string> problems;
  if (!std::filesystem::is_directory(folder)) return {directory + ": no such folder"};
  bool any = loadStage(folder / "wiring.yaml", options.wiring, problems);
  any = loadStage(folder / "lidar.yaml", options.lidar, problems) || any;
  any = loadStage(folder / "topology.yaml", options.topology, problems) || any;
  any = loadStage(folder / "relative_localization.yaml", options.relative_localization, problems) || any;
  any = loadStage(folder / "exchange.yaml", options.exchange, problems) || any;
  any = loadStage(folder / "planner.yaml", options.planner, problems) || any;
  any = loadStage(folder / "control.yaml", options.control, problems) || any;
  if (!any) problems.push_back(directory + ": has none of the stages' files, such as topology.yaml");
  return problems;
}

std::vector<std::string> checkRobot(const RobotOptions& options) {
  std::vector<std::string> problems;
  if (options.name.empty()) problems.emplace_back("robot: name: must not be empty");
  if (options.boot >= kMostBoots) problems.push_back(options.name + ": boot: must be below " + std::to_string(kMostBoots));
  collect(options.footprint, options.name + ": footprint", problems);
  collect(options.limits, options.name + ": limits", problems);
  collect(options.mount, options.name + ": lidar mount", problems);
  collect(options.wiring, options.name + ": wiring", problems);
  collect(options.lidar, options.name + ": lidar", problems);
  collect(options.topology, options.name + ": topology", problems);
  collect(options.relative_localization, options.name + ": relative_localization", problems);
  collect(options.exchange, options.name + ": exchange", problems);
  collect(options.planner, options.name + ": planner", problems);
  collect(options.control, options.name + ": control", problems);
  return problems;
}

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_section.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// A plain scalar's value; quotes make it a text.
template <class T>
bool converts(const YAML::Node& node, T* value) {
  return node.IsScalar() && node.Tag() != "!" && YAML::convert<T>::decode(node, *value);
}

std::string indexed(const std::string& key, std::size_t index) { return key + "." + std::to_string(index); }

/// An error of the parser speaks of lines; its text may not.
std::string oneLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

YamlSection::YamlSection(const YAML::Node& node, std::string file, std::string path)
    : node_(node), file_(std::move(file)), path_(std::move(path)) {
  if (node_.IsMap() || node_.IsNull()) return;
  throw InputError(file_ + ": " + (path_.empty() ? "the file" : path_) + ": must be a map of keys and values");
}

bool YamlSection::has(const std::string& key) const { return node_.IsMap() && node_[key]; }

void YamlSection::require(const std::string& key) const {
  if (!has(key)) fail(key, "is missing");
}

void YamlSection::fail(const std::string& key, const std::string& reason) const {
  throw InputError(file_ + ": " + pathOf(key) + ": " + reason);
}

YAML::Node YamlSection::take(const std::string& key) {
  known_.insert(key);
  return has(key) ? YAML::Node(node_[key]) : YAML::Node(YAML::NodeType::Undefined);
}

double YamlSection::numberOf(const YAML::Node& node, const std::string& key, const Range& range) const {
  double value = 0.0;
  if (!converts(node, &value)) fail(key, "must be a number");
  if (!std::isfinite(value) || value < range.low || value > range.high) {
    fail(key, "is " + shown(value) + ", must be between " + shown(range.low) + " and " + shown(range.high));
  }
  return value;
}

double YamlSection::number(const std::string& key, double fallback, const Range& range) {
  const YAML::Node node = take(key);
  return node.IsDefined() ? numberOf(node, key, range) : fallback;
}

bool YamlSection::flag(const std::string& key, bool fallback) {
  const YAML::Node node = take(key);
  if (!node.IsDefined()) return fallback;
  bool value = false;
  if (!converts(node, &value)) fail(key, "must be true or false");
  return value;
}

std::string YamlSection::text(const std::string& key, const std::string& fallback) {
  const YAML::Node node = take(key);
  if (!node.IsDefined()) return fallback;
  if (!node.IsScalar()) fail(key, "must be a text");
  return node.Scalar();
}

std::size_t YamlSection::choice(const std::string& key, std::size_t fallback, const std::vector<std::string>& words) {
  if (!has(key)) return known_.insert(key), fallback;
  const std::string word = text(key, "");
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return i;
    all += (i > 0 ? " or " : "") + words[i];
  }
  fail(key, "is '" + word + "', must be " + all);
}

std::vector<double> YamlSection::numbers(const std::string& key, const std::vector<double>& fallback,
                                         const std::vector<Range>& ranges) {
  const YAML::Node node = take(key);
  if (!node.IsDefined()) return fallback;
  if (!node.IsSequence() || node.size() != ranges.size()) {
    fail(key, "must be a list of " + std::to_string(ranges.size()) + " numbers");
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < ranges.size(); ++i) values.push_back(numberOf(node[i], indexed(key, i), ranges[i]));
  return values;
}

std::vector<Eigen::Vector2d> YamlSection::points(const std::string& key, std::size_t least) {
  require(key);
  const YAML::Node node = take(key);
  if (!node.IsSequence() || node.size() < least) {
    fail(key, "must be a list of at least " + std::to_string(least) + " points [x, y]");
  }
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (!node[i].IsSequence() || node[i].size() != 2) fail(indexed(key, i), "must be a point [x, y]");
    const std::string item = indexed(key, i);
    points.emplace_back(numberOf(node[i][0], indexed(item, 0), {}), numberOf(node[i][1], indexed(item, 1), {}));
  }
  return points;
}

YamlSection YamlSection::section(const std::string& key) {
  const YAML::Node node = take(key);
  return {node.IsDefined() ? node : YAML::Node(YAML::NodeType::Null), file_, pathOf(key)};
}

std::vector<YamlSection> YamlSection::sections(const std::string& key) {
  const YAML::Node node = take(key);
  if (!node.IsDefined() || node.IsNull()) return {};
  if (!node.IsSequence()) fail(key, "must be a list");
  std::vector<YamlSection> sections;
  for (std::size_t i = 0; i < node.size(); ++i) sections.emplace_back(node[i], file_, pathOf(indexed(key, i)));
  return sections;
}

void YamlSection::finish() const {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (known_.count(key) == 0) fail(key, "unknown key");
    if (!seen.insert(key).second) fail(key, "is there twice");
  }
}

YAML::Node loadYaml(const std::string& file) {
  std::ifstream stream(file);
  if (!stream || stream.peek() == std::ifstream::traits_type::eof()) {
    throw InputError(file + ": the file: cannot be read or is empty");
  }
  try {
    return YAML::Load(stream);
  } catch (const YAML::Exception& error) {
    throw InputError(file + ": the file: is not YAML: " + oneLine(error.what()));
  }
}

namespace {

YAML::Node replaced(const YAML::Node& node, const std::string& path, const std::string& whole, const YAML::Node& value) {
  if (path.empty()) return value;
  const std::size_t dot = path.find('.');
  const std::string key = path.substr(0, dot);
  const std::string rest = dot == std::string::npos ? "" : path.substr(dot + 1);
  YAML::Node result = node.IsDefined() && !node.IsNull() ? YAML::Clone(node) : YAML::Node(YAML::NodeType::Map);
  if (key.empty()) throw InputError("--set: " + whole + ": is not a key's path");
  if (result.IsSequence()) {
    const bool digits = key.find_first_not_of("0123456789") == std::string::npos && key.size() < 7;
    if (!digits || std::stoul(key) >= result.size()) {
      throw InputError("--set: " + whole + ": the list has no item '" + key + "', it has " + std::to_string(result.size()));
    }
    result[std::stoul(key)] = replaced(result[std::stoul(key)], rest, whole, value);
    return result;
  }
  if (!result.IsMap()) throw InputError("--set: " + whole + ": there is no list or map that has '" + key + "'");
  const YAML::Node child = result[key] ? YAML::Node(result[key]) : YAML::Node(YAML::NodeType::Undefined);
  result[key] = replaced(child, rest, whole, value);
  return result;
}

}  // namespace

YAML::Node withOverride(const YAML::Node& tree, const std::string& path, const std::string& value) {
  YAML::Node parsed;
  try {
    parsed = YAML::Load(value);
  } catch (const YAML::Exception& error) {
    throw InputError("--set: " + path + ": value is not YAML: " + oneLine(error.what()));
  }
  if (path.empty()) throw InputError("--set: ='" + value + "': the key is missing");
  return replaced(tree, path, path, parsed);
}

}  // namespace parley::sim

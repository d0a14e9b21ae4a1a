// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace parley::sim {

/// What a number may be. The bounds belong to it.
struct Range {
  double low = -1e6;
  double high = 1e6;
};

/// A map in a YAML file that is read key by key. Everything wrong is an InputError that names file, key and reason.
class YamlSection {
 public:
  /// `path`: dotted path of the section in the file, empty for the whole.
  YamlSection(const YAML::Node& node, std::string file, std::string path);

  bool has(const std::string& key) const;
  /// Throws unless the key is there.
  void require(const std::string& key) const;

  /// These return `fallback` where the key is missing.
  double number(const std::string& key, double fallback, const Range& range);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  /// One of a few words; answers with its index.
  std::size_t choice(const std::string& key, std::size_t fallback, const std::vector<std::string>& words);
  /// Exactly as many numbers as there are ranges.
  std::vector<double> numbers(const std::string& key, const std::vector<double>& fallback, const std::vector<Range>& ranges);
  /// Points [x, y], at least `least` of them; the key has to be there.
  std::vector<Eigen::Vector2d> points(const std::string& key, std::size_t least);
  /// A section within; an empty one where the key is missing.
  YamlSection section(const std::string& key);
  std::vector<YamlSection> sections(const std::string& key);

  /// Throws on keys that nobody has asked for, and on keys that are there twice.
  void finish() const;

  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;

 private:
  YAML::Node take(const std::string& key);
  double numberOf(const YAML::Node& node, const std::string& key, const Range& range) const;

  YAML::Node node_;
  std::string file_;
  std::string path_;
  std::set<std::string> known_;
};

/// Parses a file. Throws InputError where it cannot be read or is not YAML.
YAML::Node loadYaml(const std::string& file);

/// The tree with the value at a dotted path replaced; list items by index. Throws InputError.
YAML::Node withOverride(const YAML::Node& tree, const std::string& path, const std::string& value);

}  // namespace parley::sim

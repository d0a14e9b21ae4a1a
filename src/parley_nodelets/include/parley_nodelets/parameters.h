// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "parley_geometry/options.h"

namespace parley {

/// Reads a private namespace of the parameter server once, as groups of plain values ("" is the namespace itself,
/// "robot/footprint" a dictionary in it), and fills options structs from them. Notes every problem; `finish()` throws
/// them all in one message, so that an operator mends a file in one go.
class ParameterLoader {
 public:
  explicit ParameterLoader(const ros::NodeHandle& pnh);

  /// Missing keys keep their defaults.
  template <class Options>
  void load(const std::string& group, Options& options) {
    note(loadOptions(options, take(group), sourceOf(group)));
  }

  /// Missing keys are problems: for what has no sensible default.
  template <class Options>
  void loadRequired(const std::string& group, Options& options) {
    for (const OptionInfo& info : listOptions(options)) require(group, info.name);
    load(group, options);
  }

  /// Problems that the caller found.
  void note(const std::vector<std::string>& problems);

  /// Throws std::invalid_argument if there was any problem; groups that nobody has asked for are problems.
  void finish();

 private:
  void flatten(const std::string& group, XmlRpc::XmlRpcValue& tree);
  const OptionValues& take(const std::string& group);
  void require(const std::string& group, const std::string& key);
  std::string sourceOf(const std::string& group) const;

  std::string namespace_;
  std::map<std::string, OptionValues> groups_;
  std::set<std::string> taken_;
  std::vector<std::string> problems_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/parameters.h"

#include <ros/param.h>

#include <stdexcept>

namespace parley {

ParameterLoader::ParameterLoader(const ros::NodeHandle& pnh) : namespace_(pnh.getNamespace()) {
  XmlRpc::XmlRpcValue tree;
  groups_[""];
  if (!ros::param::get(namespace_, tree)) return;
  if (tree.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    flatten("", tree);
  } else {
    problems_.push_back(namespace_ + ": must be a dictionary");
  }
}

void ParameterLoader::flatten(const std::string& group, XmlRpc::XmlRpcValue& tree) {
  OptionValues& values = groups_[group];
  for (auto& [key, value] : tree) {
    switch (value.getType()) {
      case XmlRpc::XmlRpcValue::TypeBoolean:
        values[key] = static_cast<bool>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeInt:
        values[key] = static_cast<long>(static_cast<int>(value));
        break;
      case XmlRpc::XmlRpcValue::TypeDouble:
        values[key] = static_cast<double>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeString:
        values[key] = static_cast<std::string>(value);
        break;
      case XmlRpc::XmlRpcValue::TypeStruct:
        flatten(group.empty() ? key : std::string(group).append("/").append(key), value);
        break;
      default:
        problems_.push_back(sourceOf(group).append(": ").append(key).append(": must be a single value or a dictionary"));
    }
  }
}

const OptionValues& ParameterLoader::take(const std::string& group) {
  taken_.insert(group);
  return groups_[group];
}

void ParameterLoader::require(const std::string& group, const std::string& key) {
  const auto found = groups_.find(group);
  if (found == groups_.end() || found->second.count(key) == 0) {
    problems_.push_back(sourceOf(group) + ": " + key + ": is missing and has no default");
  }
}

std::string ParameterLoader::sourceOf(const std::string& group) const {
  return group.empty() ? namespace_ : namespace_ + "/" + group;
}

void ParameterLoader::note(const std::vector<std::string>& problems) {
  problems_.insert(problems_.end(), problems.begin(), problems.end());
}

void ParameterLoader::finish() {
  for (const auto& [group, values] : groups_) {
    if (taken_.count(group) == 0 && !values.empty()) problems_.push_back(sourceOf(group) + ": unknown group");
  }
  if (problems_.empty()) return;
  std::string all = "unusable parameters:";
  for (const std::string& problem : problems_) all += "\n  " + problem;
  throw std::invalid_argument(all);
}

}  // namespace parley

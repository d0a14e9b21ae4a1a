// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_config.h"

namespace parley {

TeamConfig loadTeamConfig(const ros::NodeHandle& pnh) {
  ParameterLoader loader(pnh);
  TeamConfig config;
  config.node = loadNodeConfig(loader);
  loader.load("", config.team);
  loader.load("exchange", config.exchange);
  loader.load("relative_localization", config.relative_localization);
  const auto require = [&](const std::string& key, const std::string& value) {
    if (value.empty()) loader.note({pnh.getNamespace() + ": " + key + ": is missing and has no default"});
  };
  require("name", config.team.name);
  require("key_file", config.team.key_file);
  if (config.team.radio.transport == "udp") require("boot_file", config.team.boot_file);
  loader.finish();
  return config;
}

}  // namespace parley

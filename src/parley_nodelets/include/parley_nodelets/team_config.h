// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "parley_exchange/exchange_options.h"
#include "parley_nodelets/node_config.h"
#include "parley_nodelets/radio.h"
#include "parley_relative_localization/relative_localization_options.h"

namespace parley {

/// Who a robot is in its team. Name and key have no default.
struct TeamOptions {
  std::string name;
  std::string key_file;
  std::string boot_file;
  bool share_maps = true;
  RadioOptions radio;

  template <class Visitor>
  void visit(Visitor& v) {
    v.text("name", name, "of the robot, one of its own in the team: 1 to 24 printable characters");
    v.text("key_file", key_file, "the team's key: 64 hexadecimal digits");
    v.text("boot_file", boot_file, "where the starts are counted; with udp it has no default");
    v.flag("share_maps", share_maps, "tell what is seen, and use what others tell");
    radio.visit(v);
  }
};

struct TeamConfig {
  NodeConfig node;
  TeamOptions team;
  ExchangeOptions exchange;
  RelativeLocalizationOptions relative_localization;
};

/// The plain values are the TeamOptions; `exchange` and `relative_localization` are groups. Throws std::invalid_argument
/// with all problems.
TeamConfig loadTeamConfig(const ros::NodeHandle& pnh);

}  // namespace parley

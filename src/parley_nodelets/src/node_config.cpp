// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/node_config.h"

namespace parley {

NodeConfig loadNodeConfig(ParameterLoader& loader) {
  NodeConfig config;
  loader.loadRequired("frames", config.frames);
  loader.loadRequired("robot/footprint", config.footprint);
  loader.loadRequired("robot/limits", config.limits);
  loader.loadRequired("robot/mount", config.mount);
  loader.load("wiring", config.wiring);
  return config;
}

}  // namespace parley

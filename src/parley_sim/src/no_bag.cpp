// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/bag_recorder.h"
#include "parley_sim/input_error.h"

namespace parley::sim {

StepObserver recordBag(const std::string& file, std::size_t /*robot*/) {
  throw InputError("--bag: " + file + ": this fleet_run was built without rosbag_storage");
}

}  // namespace parley::sim

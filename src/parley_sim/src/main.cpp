// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "one_thread.h"
#include "parley_sim/input_error.h"
#include "parley_sim/run.h"

int main(int argc, char** argv) {
  using namespace parley::sim;
  useOneThread();
  try {
    const Arguments arguments = parseArguments({argv + 1, argv + argc});
    if (arguments.help) {
      std::cout << usage();
      return 0;
    }
    const Result result = runFleet(arguments);
    std::cout << summaryOf(result) << std::endl;
    return result.success ? 0 : 1;
  } catch (const InputError& error) {
    std::cerr << "fleet_run: " << error.what() << std::endl;
    return 2;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "one_thread.h"

#include <opencv2/core/utility.hpp>

namespace parley::sim {

void useOneThread() { cv::setNumThreads(1); }

}  // namespace parley::sim

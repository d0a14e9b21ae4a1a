// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace parley::sim {

/// Unusable arguments or files. The text is one line that names the file, the key and the reason.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace parley::sim

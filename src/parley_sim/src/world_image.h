// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace parley::sim {

/// A picture of a world: 0 black to 1 white, row-major from the bottom.
struct WorldImage {
  int width = 0;
  int height = 0;
  std::vector<double> lightness;
};

/// Reads any format that OpenCV knows; colours, and transparency where there is any, are averaged as map_server does.
std::optional<WorldImage> readWorldImage(const std::string& file);

}  // namespace parley::sim

// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/world_loader.h"

#include <filesystem>

#include "parley_sim/input_error.h"
#include "world_image.h"
#include "yaml_section.h"

namespace parley::sim {

World loadWorld(const std::string& yaml_file) {
  // map_server takes keys that it does not know, so they are no error here
  YamlSection section(loadYaml(yaml_file), yaml_file, "");
  for (const char* key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) section.require(key);
  const std::filesystem::path image = section.text("image", "");
  const std::filesystem::path image_file = image.is_absolute() ? image : std::filesystem::path(yaml_file).parent_path() / image;
  GridFrame frame;
  frame.resolution = section.number("resolution", 0.0, {0.001, 100.0});
  const std::vector<double> origin = section.numbers("origin", {}, {{}, {}, {}});
  if (origin[2] != 0.0) section.fail("origin", "a yaw other than 0 is not supported");
  frame.origin = {origin[0], origin[1]};
  const bool negate = section.number("negate", 0.0, {0.0, 1.0}) != 0.0;
  section.number("occupied_thresh", 0.0, {0.0, 1.0});
  const double free_threshold = section.number("free_thresh", 0.0, {0.0, 1.0});

  const std::optional<WorldImage> picture = readWorldImage(image_file.string());
  if (!picture) section.fail("image", "cannot be read as an image: " + image_file.string());
  frame.width = picture->width;
  frame.height = picture->height;
  std::vector<std::uint8_t> solid(picture->lightness.size());
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const double occupied = negate ? picture->lightness[i] : 1.0 - picture->lightness[i];
    solid[i] = occupied < free_threshold ? 0 : 1;
  }
  return {frame, solid};
}

}  // namespace parley::sim

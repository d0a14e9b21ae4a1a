// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/world_loader.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "parley_sim/input_error.h"
#include "worlds.h"

namespace parley::sim {
namespace {

const char* kKeys = "resolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Two by three pixels: white, grey, black below; all white above.
cv::Mat smallImage() {
  cv::Mat image(2, 3, CV_8U, cv::Scalar(255));
  image.at<std::uint8_t>(1, 1) = 205;
  image.at<std::uint8_t>(1, 2) = 0;
  return image;
}

std::string messageOf(const std::string& file) {
  try {
    loadWorld(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WorldLoaderTest, whatIsNotFreeIsSolidInEveryFormat) {
  TemporaryDirectory directory;
  cv::Mat color, deep, transparent;
  cv::cvtColor(smallImage(), color, cv::COLOR_GRAY2BGR);
  cv::cvtColor(smallImage(), transparent, cv::COLOR_GRAY2BGRA);
  smallImage().convertTo(deep, CV_16U, 257.0);
  cv::imwrite(directory.file("grey.png"), smallImage());
  cv::imwrite(directory.file("plain.pgm"), smallImage());
  cv::imwrite(directory.file("color.png"), color);
  cv::imwrite(directory.file("transparent.png"), transparent);
  cv::imwrite(directory.file("deep.png"), deep);
  for (const std::string name : {"grey.png", "plain.pgm", "color.png", "transparent.png", "deep.png"}) {
    const World world = loadWorld(directory.write("map.yaml", "image: " + name + "\n" + kKeys));
    ASSERT_EQ(world.frame().width, 3) << name;
    ASSERT_EQ(world.frame().height, 2) << name;
    EXPECT_FALSE(world.isSolid(Eigen::Vector2i(0, 0))) << name;
    EXPECT_TRUE(world.isSolid(Eigen::Vector2i(2, 0))) << name;
    EXPECT_FALSE(world.isSolid(Eigen::Vector2i(2, 1))) << name;
    EXPECT_FALSE(world.isSolid(Eigen::Vector2d(-0.9, 2.1))) << name;
    EXPECT_TRUE(world.isSolid(Eigen::Vector2d(0.4, 2.1))) << name;
    if (name != "transparent.png") {  // transparency lightens it, as in map_server
      EXPECT_TRUE(world.isSolid(Eigen::Vector2i(1, 0))) << name;
    }
  }
}

TEST(WorldLoaderTest, negateTurnsItRound) {
  TemporaryDirectory directory;
  cv::imwrite(directory.file("m.png"), smallImage());
  std::string keys = kKeys;
  keys.replace(keys.find("negate: 0"), 9, "negate: 1");
  const World world = loadWorld(directory.write("m.yaml", "image: m.png\n" + keys));
  EXPECT_TRUE(world.isSolid(Eigen::Vector2i(0, 0)));
  EXPECT_FALSE(world.isSolid(Eigen::Vector2i(2, 0)));
}

TEST(WorldLoaderTest, errorsNameFileKeyAndReason) {
  TemporaryDirectory directory;
  cv::imwrite(directory.file("m.png"), smallImage());
  std::string turned = kKeys;
  turned.replace(turned.find("2.0, 0.0]"), 9, "2.0, 0.5]");
  EXPECT_NE(messageOf(directory.write("a.yaml", "image: m.png\n" + turned)).find("a.yaml: origin: a yaw"), std::string::npos);
  EXPECT_NE(messageOf(directory.write("b.yaml", std::string("image: no.png\n") + kKeys)).find("b.yaml: image: cannot be read"),
            std::string::npos);
  EXPECT_NE(messageOf(directory.write("c.yaml", "image: m.png\n")).find("c.yaml: resolution: is missing"), std::string::npos);
  EXPECT_NE(messageOf(directory.write("d.yaml", "image: [")).find("d.yaml: the file: is not YAML"), std::string::npos);
  EXPECT_NE(messageOf(directory.file("e.yaml")).find("e.yaml: the file: cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

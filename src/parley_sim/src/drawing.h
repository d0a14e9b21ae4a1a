// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "parley_sim/shapes.h"
#include "parley_sim/world.h"

namespace parley::sim {

std::string oneDecimal(double value);

/// A map with robots' tracks on it, about 1200 pixels large, and a legend beside it. Robots are told apart by colour.
class Drawing {
 public:
  Drawing(const World& world, std::size_t robots);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  void track(const std::vector<Eigen::Vector2d>& points, std::size_t robot);
  void start(const Eigen::Vector2d& point, std::size_t robot);
  void goal(const Eigen::Vector2d& point, double tolerance, std::size_t robot);
  void body(const Box& box, std::size_t robot);
  void label(const Eigen::Vector2d& point, const std::string& text, std::size_t robot);
  void door(const Box& box);
  void obstaclePath(const std::vector<Eigen::Vector2d>& path, double radius);
  void encounter(const Eigen::Vector2d& point);
  /// Where a robot went to make room.
  void escape(const Eigen::Vector2d& point, std::size_t robot);
  void incident(const Eigen::Vector2d& point, bool touched);
  /// One line a robot, and what the marks mean.
  void legend(const std::string& title, const std::vector<std::string>& lines);

  /// False if the file cannot be written.
  bool save(const std::string& file) const;

 private:
  struct Canvas;
  std::unique_ptr<Canvas> canvas_;
};

}  // namespace parley::sim

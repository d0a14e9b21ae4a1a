// SPDX-License-Identifier: BSD-3-Clause
#include "curve_variables.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace parley {

namespace {

/// Row i: the coefficient of tau^i as weights of the scaled values.
Eigen::Matrix<double, 6, 6> coefficientRows() {
  Eigen::Matrix<double, 6, 6> rows;
  rows << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,    //
      0.0, 1.0, 0.0, 0.0, 0.0, 0.0,        //
      0.0, 0.0, 0.5, 0.0, 0.0, 0.0,        //
      -10.0, -6.0, -1.5, 10.0, -4.0, 0.5,  //
      15.0, 8.0, 1.5, -15.0, 7.0, -1.0,    //
      -6.0, -3.0, -0.5, 6.0, -3.0, 0.5;    //
  return rows;
}

FlatState knotOf(const KnotBlock& block, double h) {
  return {{block[0], block[1]}, Eigen::Vector2d(block[2], block[3]) / h, Eigen::Vector2d(block[4], block[5]) / (h * h)};
}

}  // namespace

CurveVariables CurveVariables::of(const std::vector<FlatState>& knots, double duration) {
  CurveVariables variables;
  const double h = duration / static_cast<double>(knots.size() - 1);
  variables.start = knots.front();
  variables.log_duration = std::log(h);
  for (std::size_t i = 1; i < knots.size(); ++i) variables.knots.push_back(scaledKnot(knots[i], h));
  return variables;
}

PiecewiseQuintic CurveVariables::curve() const {
  const double h = std::exp(log_duration);
  std::vector<FlatState> states = {start};
  for (const KnotBlock& block : knots) states.push_back(knotOf(block, h));
  return {states, h * static_cast<double>(knots.size())};
}

KnotBlock scaledKnot(const FlatState& knot, double piece_duration) {
  const double h = piece_duration;
  return {knot.position.x(),
          knot.position.y(),
          h * knot.velocity.x(),
          h * knot.velocity.y(),
          h * h * knot.acceleration.x(),
          h * h * knot.acceleration.y()};
}

DerivativeRows derivativesAt(double tau) {
  Eigen::Matrix<double, 4, 6> powers = Eigen::Matrix<double, 4, 6>::Zero();
  for (int k = 0; k < 4; ++k) {
    double power = 1.0;
    for (int i = k; i < 6; ++i, power *= tau) {
      double factor = 1.0;  // i! / (i - k)!
      for (int m = 0; m < k; ++m) factor *= i - m;
      powers(k, i) = factor * power;
    }
  }
  return powers * coefficientRows();
}

JerkRoot jerkRoot() {
  Eigen::Matrix3d gram;  // of 1, tau, tau^2 over [0, 1]
  gram << 1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0;
  const Eigen::Matrix3d factor = gram.llt().matrixU();
  const Eigen::Vector3d derived(6.0, 24.0, 60.0);
  return factor * derived.asDiagonal() * coefficientRows().bottomRows<3>();
}

}  // namespace parley

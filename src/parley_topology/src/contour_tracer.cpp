// SPDX-License-Identifier: BSD-3-Clause
#include "contour_tracer.h"

#include <opencv2/imgproc.hpp>

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr int kHalo = 2;            // [cells] around the tile, for the direction of contours that leave it
constexpr double kArcPiece = 0.35;  // [m] corners closer than this may be pieces of one corner's round
constexpr double kArcTurn = 1.75;   // [rad] and are so if together they turn no more than this
constexpr double kTipReach = 0.6;   // [-] of the grown radius, how far the tip of a corner may stand off from its round

double turnAt(const Eigen::Vector2d& before, const Eigen::Vector2d& at, const Eigen::Vector2d& after) {
  const Eigen::Vector2d in = at - before, out = after - at;
  return std::atan2(cross(in, out), in.dot(out));
}

/// Where the line through a and b meets that through c and d.
Eigen::Vector2d crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  const Eigen::Vector2d u = b - a, v = d - c;
  return a + u * (cross(c - a, v) / cross(u, v));
}

class TileTracer {
 public:
  TileTracer(const TiledMap& map, int tx, int ty, const FieldShape& shape, double simplify)
      : map_(map),
        shape_(shape),
        simplify_(simplify),
        rect_{tx * kTileSize, ty * kTileSize, (tx + 1) * kTileSize, (ty + 1) * kTileSize} {}

  std::vector<Chain> trace() {
    const CellRect window = rect_.grown(kHalo);
    cv::Mat1b grown(window.height(), window.width());
    bool any = false;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const bool narrow = !(map_.flags(x, y) & kWide);
        grown(y - window.y0, x - window.x0) = narrow ? 255 : 0;
        any = any || narrow;
      }
    }
    if (!any) return {};
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(grown, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE, cv::Point(window.x0, window.y0));
    for (const auto& outline : outlines) cut(outline);
    return std::move(chains_);
  }

 private:
  bool inside(const cv::Point& p) const { return p.x >= rect_.x0 && p.x < rect_.x1 && p.y >= rect_.y0 && p.y < rect_.y1; }

  /// Splits an outline into the runs of pixels inside the tile.
  void cut(const std::vector<cv::Point>& outline) {
    const std::size_t n = outline.size();
    std::size_t outside = 0;
    while (outside < n && inside(outline[outside])) ++outside;
    if (outside == n) return addClosed(outline);
    std::vector<cv::Point> run;
    for (std::size_t k = 1; k <= n; ++k) {
      const cv::Point& p = outline[(outside + k) % n];
      if (inside(p)) {
        if (run.empty()) run.push_back(outline[(outside + k - 1) % n]);
        run.push_back(p);
      } else if (!run.empty()) {
        run.push_back(p);
        addOpen(run);
        run.clear();
      }
    }
  }

  void addClosed(const std::vector<cv::Point>& pixels) {
    Chain chain;
    chain.closed = true;
    chain.first = chain.last = {pixels.front().x, pixels.front().y};
    chain.turn = turnOf(pixels.begin(), pixels.end());
    chain.points = sharpened(simplified(pixels.begin(), pixels.end(), true), true, chain.turn);
    chain.core = coreOf(pixels.front());
    chains_.push_back(std::move(chain));
  }

  /// `run` has one pixel outside at each end; the last becomes the end of the chain, the first only names where it comes from.
  void addOpen(const std::vector<cv::Point>& run) {
    const auto cell = [](const cv::Point& p) { return Eigen::Vector2i(p.x, p.y); };
    Chain chain;
    chain.before = cell(run.front());
    chain.first = cell(run[1]);
    chain.last = cell(run[run.size() - 2]);
    chain.end = cell(run.back());
    chain.turn = turnOf(run.begin() + 1, run.end());
    chain.points = sharpened(simplified(run.begin() + 1, run.end(), false), false, chain.turn);
    chain.core = coreOf(run[1]);
    chains_.push_back(std::move(chain));
  }

  template <class Iterator>
  std::vector<Eigen::Vector2d> simplified(Iterator first, Iterator last, bool closed) const {
    std::vector<cv::Point2f> points, kept;
    const Eigen::Vector2d corner(map_.centerOf(rect_.x0), map_.centerOf(rect_.y0));  // keeps floats small
    for (Iterator p = first; p != last; ++p) {
      const Eigen::Vector2d at = refined(*p) - corner;
      points.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()));
    }
    cv::approxPolyDP(points, kept, simplify_, closed);
    std::vector<Eigen::Vector2d> result;
    result.reserve(kept.size());
    for (const cv::Point2f& p : kept) result.push_back(corner + Eigen::Vector2d(p.x, p.y));
    if (!closed) {  // both tiles must agree on the shared point to the last bit
      result.front() = refined(*first);
      result.back() = refined(*(last - 1));
    }
    return result;
  }

  /// Sign of turns at convex corners, from the side on which the distance grows.
  template <class Iterator>
  int turnOf(Iterator first, Iterator last) const {
    double left = 0.0;
    for (Iterator p = first; p + 1 < last; ++p) left += cross(Eigen::Vector2d((p + 1)->x - p->x, (p + 1)->y - p->y), outward(*p));
    return left > 0.0 ? -1 : 1;
  }

  /// A grown corner is round, and its simplification has two or three corners where one will do: puts the point where the
  /// straight parts before and after would meet in their place, if there is room. The ends of open chains stay.
  std::vector<Eigen::Vector2d> sharpened(const std::vector<Eigen::Vector2d>& points, bool closed, int sense) const {
    std::vector<Eigen::Vector2d> result;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n;) {
      std::size_t last = i;
      if (n > 3 && i > 0) last = lastOfCorner(points, i, n - 1, sense);
      const Eigen::Vector2d& after = points[last + 1 < n ? last + 1 : 0];
      if (last > i) {
        const Eigen::Vector2d tip = crossing(points[i - 1], points[i], points[last], after);
        if (isRoomFor(tip, points, i, last) && (closed || last + 1 < n)) {
          result.push_back(tip);
          i = last + 1;
          continue;
        }
      }
      result.push_back(points[i++]);
    }
    return result;
  }

  /// The tip of a corner in place of points[i] to points[last]: near these, and clear of all obstacles.
  bool isRoomFor(const Eigen::Vector2d& tip, const std::vector<Eigen::Vector2d>& points, std::size_t i, std::size_t last) const {
    double away = shape_.grown_radius;
    for (std::size_t k = i; k < last; ++k) away = std::min(away, pointSegmentDistance(tip, points[k], points[k + 1]));
    return away < kTipReach * shape_.grown_radius && (map_.flags(map_.cellOf(tip.x()), map_.cellOf(tip.y())) & kWide);
  }

  /// The last of the corners from `i` on that are pieces of one convex corner; none is at or after `stop`.
  std::size_t lastOfCorner(const std::vector<Eigen::Vector2d>& points, std::size_t i, std::size_t stop, int sense) const {
    double turn = sense * turnAt(points[i - 1], points[i], points[(i + 1) % points.size()]);
    std::size_t last = i;
    while (turn > 0.0 && last + 1 < stop && (points[last + 1] - points[last]).norm() < kArcPiece) {
      const double more = sense * turnAt(points[last], points[last + 1], points[(last + 2) % points.size()]);
      if (more <= 0.0 || turn + more > kArcTurn) break;
      turn += more;
      ++last;
    }
    return last;
  }

  /// Direction in which the distance grows, unit or zero.
  Eigen::Vector2d outward(const cv::Point& p) const {
    const Eigen::Vector2d slope(map_.distance(p.x + 1, p.y) - map_.distance(p.x - 1, p.y),
                                map_.distance(p.x, p.y + 1) - map_.distance(p.x, p.y - 1));
    const double norm = slope.norm();
    return norm > 0.0 ? Eigen::Vector2d(slope / norm) : Eigen::Vector2d::Zero();
  }

  /// From the middle of a border pixel to where the distance is the grown radius.
  Eigen::Vector2d refined(const cv::Point& p) const {
    const double missing = shape_.grown_radius - metersOf(map_.distance(p.x, p.y), shape_.reach);
    return map_.centerOf(p.x, p.y) + std::min(missing, map_.resolution()) * outward(p);
  }

  Eigen::Vector2d coreOf(const cv::Point& p) const {
    return map_.centerOf(p.x, p.y) - metersOf(map_.distance(p.x, p.y), shape_.reach) * outward(p);
  }

  const TiledMap& map_;
  const FieldShape& shape_;
  double simplify_;
  CellRect rect_;
  std::vector<Chain> chains_;
};

}  // namespace

std::vector<Chain> traceTile(const TiledMap& map, int tx, int ty, const FieldShape& shape, double simplify) {
  return TileTracer(map, tx, ty, shape, simplify).trace();
}

}  // namespace parley

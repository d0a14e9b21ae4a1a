// SPDX-License-Identifier: BSD-3-Clause
#include "clique.h"

#include <cassert>
#include <cstdint>

namespace parley {
namespace {

using Set = std::uint64_t;

Set only(int node) { return Set{1} << static_cast<unsigned>(node); }

int sizeOf(Set set) {
  int size = 0;
  for (; set != 0; set &= set - 1) ++size;
  return size;
}

class Search {
 public:
  explicit Search(const std::vector<std::vector<bool>>& joined) : neighbours_(joined.size(), 0) {
    for (std::size_t i = 0; i < joined.size(); ++i) {
      for (std::size_t j = 0; j < joined.size(); ++j) {
        if (i != j && joined[i][j]) neighbours_[i] |= only(static_cast<int>(j));
      }
    }
  }

  Set run() {
    const int count = static_cast<int>(neighbours_.size());
    extend(0, count == kMostCliqueNodes ? ~Set{0} : only(count) - 1, 0);
    return best_;
  }

 private:
  void extend(Set clique, Set candidates, Set excluded) {
    if (candidates == 0 && excluded == 0 && sizeOf(clique) > sizeOf(best_)) best_ = clique;
    if (sizeOf(clique) + sizeOf(candidates) <= sizeOf(best_)) return;
    Set branches = candidates & ~neighbours_[static_cast<std::size_t>(pivot(candidates, excluded))];
    for (int node = 0; branches != 0; ++node) {
      if ((branches & only(node)) == 0) continue;
      const Set near = neighbours_[static_cast<std::size_t>(node)];
      extend(clique | only(node), candidates & near, excluded & near);
      candidates &= ~only(node);
      excluded |= only(node);
      branches &= ~only(node);
    }
  }

  /// The node with most of the candidates about it: they need not be branched on.
  int pivot(Set candidates, Set excluded) const {
    int best = 0, most = -1;
    for (int node = 0; node < static_cast<int>(neighbours_.size()); ++node) {
      if (((candidates | excluded) & only(node)) == 0) continue;
      const int size = sizeOf(candidates & neighbours_[static_cast<std::size_t>(node)]);
      if (size > most) {
        most = size;
        best = node;
      }
    }
    return best;
  }

  std::vector<Set> neighbours_;
  Set best_ = 0;
};

}  // namespace

std::vector<int> maximumClique(const std::vector<std::vector<bool>>& joined) {
  assert(joined.size() <= static_cast<std::size_t>(kMostCliqueNodes));
  std::vector<int> nodes;
  if (joined.empty()) return nodes;
  const Set best = Search(joined).run();
  for (int node = 0; node < static_cast<int>(joined.size()); ++node) {
    if ((best & only(node)) != 0) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace parley

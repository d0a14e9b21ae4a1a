// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

namespace parley {

/// Binary heap of items 0 to n - 1 by key, least first, with decrease-key. Equal keys come out by lesser item.
class IndexedHeap {
 public:
  explicit IndexedHeap(std::size_t items) : place_(items, -1) {}

  bool empty() const { return heap_.empty(); }
  double leastKey() const { return heap_.front().key; }

  /// Adds an item, or lowers its key; a key that is not lower is ignored.
  void put(int item, double key) {
    int place = place_[static_cast<std::size_t>(item)];
    if (place < 0) {
      place = static_cast<int>(heap_.size());
      heap_.push_back({key, item});
    } else if (key < at(place).key) {
      at(place).key = key;
    } else {
      return;
    }
    up(place);
  }

  int pop() {
    const int item = heap_.front().item;
    place_[static_cast<std::size_t>(item)] = -1;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) {
      heap_.front() = last;
      down(0);
    }
    return item;
  }

 private:
  struct Entry {
    double key;
    int item;
    bool operator<(const Entry& o) const { return key < o.key || (key == o.key && item < o.item); }
  };

  Entry& at(int place) { return heap_[static_cast<std::size_t>(place)]; }
  void settle(int place, const Entry& entry) {
    at(place) = entry;
    place_[static_cast<std::size_t>(entry.item)] = place;
  }

  void up(int place) {
    const Entry entry = at(place);
    while (place > 0 && entry < at((place - 1) / 2)) {
      settle(place, at((place - 1) / 2));
      place = (place - 1) / 2;
    }
    settle(place, entry);
  }

  void down(int place) {
    const Entry entry = at(place);
    const int size = static_cast<int>(heap_.size());
    for (int child = 2 * place + 1; child < size; child = 2 * place + 1) {
      if (child + 1 < size && at(child + 1) < at(child)) ++child;
      if (!(at(child) < entry)) break;
      settle(place, at(child));
      place = child;
    }
    settle(place, entry);
  }

  std::vector<Entry> heap_;
  std::vector<int> place_;
};

}  // namespace parley

// SPDX-License-Identifier: BSD-3-Clause
#include "coverage.h"

#include <algorithm>
#include <cassert>

namespace parley {

Coverage::Coverage(const std::vector<Interval>& intervals) {
  for (const Interval& interval : intervals) add(interval.first, interval.last);
}

void Coverage::add(std::uint32_t first, std::uint32_t last) {
  if (last < first) return;
  // All that overlap or touch become one.
  auto begin = std::lower_bound(intervals_.begin(), intervals_.end(), first,
                                [](const Interval& interval, std::uint32_t number) { return interval.last + 1 < number; });
  auto end = begin;
  for (; end != intervals_.end() && end->first <= last + 1; ++end) {
    first = std::min(first, end->first);
    last = std::max(last, end->last);
  }
  intervals_.insert(intervals_.erase(begin, end), Interval{first, last});
}

void Coverage::add(const Coverage& other) {
  for (const Interval& interval : other.intervals_) add(interval.first, interval.last);
}

Coverage Coverage::above(std::uint32_t limit) const {
  Coverage rest;
  for (const Interval& interval : intervals_) {
    if (interval.last > limit) rest.add(std::max(interval.first, limit + 1), interval.last);
  }
  return rest;
}

void Coverage::limit(std::size_t count) {
  if (intervals_.size() > count) intervals_.resize(count);
}

std::vector<Interval>::const_iterator Coverage::find(std::uint32_t number) const {
  return std::lower_bound(intervals_.begin(), intervals_.end(), number,
                          [](const Interval& interval, std::uint32_t n) { return interval.last < n; });
}

bool Coverage::contains(std::uint32_t number) const {
  const auto interval = find(number);
  return interval != intervals_.end() && interval->first <= number;
}

Interval Coverage::around(std::uint32_t number) const {
  assert(contains(number));
  return *find(number);
}

}  // namespace parley

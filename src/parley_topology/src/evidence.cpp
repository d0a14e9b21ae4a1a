// SPDX-License-Identifier: BSD-3-Clause
#include "evidence.h"

namespace parley {
namespace {

/// Options as what the inner loop needs.
struct Voting {
  int hit, clear, limit, occupied_above, free_below;

  int vote(int evidence, std::uint8_t mark) const {
    if (mark == kHit) return std::min(limit, evidence + hit);
    if (mark == kClear) return std::max(-limit, evidence - clear);
    return mark == kUnderRobot ? -limit : evidence;
  }
  bool isSurelyFree(int evidence) const { return 2 * evidence <= -limit; }
  std::uint8_t judge(int evidence, std::uint8_t flags) const {
    if (evidence > occupied_above) return static_cast<std::uint8_t>(flags | kSeen | kOwn);
    if (evidence >= free_below && (flags & kOwn)) return flags;
    if (evidence < 0) return static_cast<std::uint8_t>((flags | kSeen) & ~kOwn);
    return flags;
  }
};

bool hasMarks(const ScanImage& image, const CellRect& part) {
  for (int y = part.y0; y < part.y1; ++y) {
    const std::uint8_t* row = image.marks.ptr(y - image.rect.y0) - image.rect.x0;
    if (std::any_of(row + part.x0, row + part.x1, [](std::uint8_t mark) { return mark != kNothing; })) return true;
  }
  return false;
}

/// A cell that a layer holds occupied has just been looked through: the layer's word is no longer the newest.
bool overrules(const Tile& tile, std::size_t i, std::uint8_t mark) {
  return tile.layers && mark == kClear && (tile.flags[i] & (kFused | kOwn)) == kFused;
}

void addToTile(Tile& tile, const ScanImage& image, const CellRect& part, std::uint16_t second, const Voting& voting) {
  for (int y = part.y0; y < part.y1; ++y) {
    const std::uint8_t* row = image.marks.ptr(y - image.rect.y0) - image.rect.x0;
    for (int x = part.x0; x < part.x1; ++x) {
      const std::uint8_t mark = row[x];
      if (mark == kNothing || mark == kKeep) continue;
      const std::size_t i = offsetOf(x, y);
      if (mark == kPassing) {
        // What comes to a stand here was not always here. Walls that are known already stay what they are.
        if (!(tile.flags[i] & kOwn)) tile.flags[i] = static_cast<std::uint8_t>(tile.flags[i] | kOnceFree);
        continue;
      }
      tile.looked[i] = second;
      if (overrules(tile, i, mark)) tile.changed_cells = static_cast<std::uint16_t>(tile.changed_cells | blockBit(x, y));
      const int before{tile.evidence[i]};
      const int after = voting.vote(before, mark);
      if (after == before) continue;
      tile.evidence[i] = static_cast<std::int8_t>(after);
      if (voting.isSurelyFree(after)) tile.flags[i] = static_cast<std::uint8_t>(tile.flags[i] | kOnceFree);
      const std::uint8_t flags = voting.judge(after, tile.flags[i]);
      if (flags == tile.flags[i]) continue;
      const std::uint16_t block = blockBit(x, y);
      const bool occupied = (flags ^ tile.flags[i]) & kOwn;
      tile.flags[i] = flags;
      tile.changed_seen = static_cast<std::uint16_t>(tile.changed_seen | block);
      if (occupied || tile.layers) tile.changed_cells = static_cast<std::uint16_t>(tile.changed_cells | block);
    }
  }
}

}  // namespace

void addEvidence(TiledMap& map, const ScanImage& image, double stamp, const TopologyOptions& options) {
  const std::uint16_t second = map.secondsOf(stamp);
  const Voting voting{options.hit_weight, options.clear_weight, options.evidence_limit, options.occupied_above,
                      options.free_below};
  forEachTile(image.rect, [&](int tx, int ty, const CellRect& part) {
    Tile* tile = map.find(tx, ty);
    if (!tile && hasMarks(image, part)) tile = map.ensure(tx, ty);
    if (!tile) return;
    addToTile(*tile, image, part, second, voting);
    if (tile->changed_seen | tile->changed_cells) map.note(*tile);
  });
}

}  // namespace parley

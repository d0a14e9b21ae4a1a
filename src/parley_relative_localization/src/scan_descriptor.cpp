// SPDX-License-Identifier: BSD-3-Clause
#include "parley_relative_localization/scan_descriptor.h"

#include <algorithm>
#include <cmath>

#include "bin_predictor.h"
#include "range_coder.h"

namespace parley {
namespace {

constexpr double kSameSurface = 0.1;  // [m] bins that join into one are averaged within this
constexpr std::size_t kHeader = 2;    // [-] range_max and check byte
constexpr int kUnary = 24;            // [-] errors from here on are written in eight plain bits
constexpr std::uint8_t kCheckStart = 0x5B;

std::uint8_t checkOf(const PolarScan& scan) {
  std::uint32_t check = kCheckStart;
  for (const std::uint8_t code : scan.codes) check = (check * 167U + code + 13U) & 0xFFFFU;
  return static_cast<std::uint8_t>((check >> 8U) ^ check);
}

/// One walk through the bins, the same for writing and reading: `Coder::bit` writes the bit given, or returns the one read.
template <class Coder>
class ScanWalk {
 public:
  explicit ScanWalk(Coder& coder) : coder_(coder) {
    for (auto& contexts : more_) {
      for (auto& context : contexts) context.fill(AdaptiveBit(45000));
    }
  }

  void walk(PolarScan& scan) {
    for (std::uint8_t& code : scan.codes) {
      const int kind = coded(code == PolarScan::kUnknown ? 0 : code == PolarScan::kFree ? 1 : 2);
      if (kind == 2) {
        code = static_cast<std::uint8_t>(predictor_.history() > 0 ? hit(code) : firstHit(code));
      } else {
        code = kind == 0 ? PolarScan::kUnknown : PolarScan::kFree;
        predictor_.clear();
      }
      before_last_ = last_;
      last_ = static_cast<std::size_t>(kind);
    }
  }

 private:
  int coded(int kind) {
    const bool is_hit = coder_.bit(kind == 2, hit_[last_][before_last_]);
    if (is_hit) return 2;
    return coder_.bit(kind == 1, free_[last_]) ? 1 : 0;
  }

  int plain(int value) {
    int result = 0;
    for (int bit = 7; bit >= 0; --bit) result = 2 * result + (coder_.raw(((value >> bit) & 1) != 0) ? 1 : 0);
    return result;
  }

  int firstHit(int code) {
    const int value = std::clamp(plain(code), 1, 254);
    predictor_.begin(value);
    return value;
  }

  int hit(int code) {
    const int predicted = predictor_.predicted(), wanted = std::abs(code - predicted);
    const std::size_t rough = static_cast<std::size_t>(predictor_.roughness());
    auto& more = more_[static_cast<std::size_t>(std::min(predictor_.history(), 4) - 1)][rough];
    int size = 0;
    while (size < kUnary && coder_.bit(size < wanted, more[static_cast<std::size_t>(size)])) ++size;
    if (size == kUnary) size = plain(wanted);
    const bool nearer = size > 0 && coder_.bit(code < predicted, sign_);
    const int value = std::clamp(predicted + (nearer ? -size : size), 1, 254);
    predictor_.add(value, value - predicted);
    return value;
  }

  Coder& coder_;
  BinPredictor predictor_;
  std::size_t last_ = 2, before_last_ = 2;
  std::array<std::array<AdaptiveBit, 3>, 3> hit_;
  std::array<AdaptiveBit, 3> free_;
  AdaptiveBit sign_;
  std::array<std::array<std::array<AdaptiveBit, kUnary>, 3>, 4> more_;
};

struct Writer {
  bool bit(bool value, AdaptiveBit& model) {
    encoder.encode(value, model);
    return value;
  }
  bool raw(bool value) {
    encoder.encodeRaw(value);
    return value;
  }
  RangeEncoder encoder;
};

struct Reader {
  bool bit(bool /*value*/, AdaptiveBit& model) { return decoder.decode(model); }
  bool raw(bool /*value*/) { return decoder.decodeRaw(); }
  RangeDecoder decoder;
};

/// What the bins of a scan say of one bin of the descriptor.
struct Joined {
  double nearest = std::numeric_limits<double>::infinity();  // [m]
  double sum = 0.0;                                          // [m]
  int count = 0;                                             // [-]
  bool looked = false;

  void add(double range) {
    looked = true;
    if (!std::isfinite(range)) return;
    if (range < nearest - kSameSurface) sum = count = 0;
    if (range > nearest + kSameSurface) return;
    nearest = std::min(nearest, range);
    sum += range;
    ++count;
  }
  std::uint8_t code(double range_max) const {
    if (!looked) return PolarScan::kUnknown;
    if (count == 0 || sum / count >= range_max) return PolarScan::kFree;
    return static_cast<std::uint8_t>(std::clamp(std::lround(254.0 * sum / count / range_max), 1L, 254L));
  }
};

}  // namespace

int PolarScan::binOf(double bearing) {
  const int bin = static_cast<int>(std::floor((wrapAngle(bearing) + kPi) / (2.0 * kPi) * kPolarBins));
  return std::min(bin, kPolarBins - 1);
}

PolarScan polarScanOf(const ObstacleScan& scan, bool keep_transient) {
  PolarScan result;
  result.range_max = std::clamp(std::round(scan.range_max * 10.0), 1.0, 255.0) / 10.0;
  std::array<Joined, kPolarBins> joined;
  const std::size_t count = scan.binCount();
  const auto add = [&](std::size_t from, std::size_t to) {
    const bool transient = from < scan.transient.size() && scan.transient[from];
    if (!std::isnan(scan.ranges[from]) && (!transient || keep_transient)) joined[to].add(scan.ranges[from]);
  };
  for (std::size_t bin = 0; bin < std::max(count, joined.size()); ++bin) {
    // Whichever has fewer bins: each of them takes part in several of the other's.
    const std::size_t from = count >= joined.size() ? bin : bin * count / joined.size();
    add(from, count >= joined.size() ? bin * joined.size() / count : bin);
  }
  for (std::size_t bin = 0; bin < joined.size(); ++bin) result.codes[bin] = joined[bin].code(result.range_max);
  return result;
}

std::vector<std::uint8_t> encodeScan(const PolarScan& scan) {
  PolarScan copy = scan;
  Writer writer;
  ScanWalk<Writer>(writer).walk(copy);
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(std::clamp(std::lround(10.0 * scan.range_max), 1L, 255L)),
                                  checkOf(scan)};
  const std::vector<std::uint8_t> coded = writer.encoder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

std::optional<PolarScan> decodeScan(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < kHeader || bytes.size() > kMaxDescriptorBytes || bytes[0] == 0) return std::nullopt;
  PolarScan scan;
  scan.range_max = 0.1 * bytes[0];
  Reader reader{RangeDecoder(bytes.data() + kHeader, bytes.size() - kHeader)};
  ScanWalk<Reader>(reader).walk(scan);
  if (checkOf(scan) != bytes[1]) return std::nullopt;
  return scan;
}

}  // namespace parley

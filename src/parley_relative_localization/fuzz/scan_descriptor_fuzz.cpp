// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parley_relative_localization/scan_descriptor.h"

using namespace parley;

namespace {

void require(bool holds) {
  if (!holds) __builtin_trap();
}

/// What was read can be used and written again.
void checkScan(const PolarScan& scan) {
  for (int bin = 0; bin < kPolarBins; ++bin) require(scan.rangeAt(bin) > 0.0 && scan.rangeAt(bin) <= scan.range_max);
  const std::vector<std::uint8_t> bytes = encodeScan(scan);
  const std::optional<PolarScan> again = decodeScan(bytes);
  require(bytes.size() <= kMaxDescriptorBytes && again && again->codes == scan.codes);
}

}  // namespace

/// Any bytes as a peer could send them for a descriptor; then as a scan, written and read; then as changes of what was written,
/// which lead further than bytes that nobody wrote.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> bytes(data, data + std::min(size, kMaxDescriptorBytes + 1));
  if (const std::optional<PolarScan> scan = decodeScan(bytes)) checkScan(*scan);
  if (bytes.empty()) return 0;
  PolarScan scan;
  scan.range_max = 0.1 * std::max<int>(1, bytes[0]);
  for (std::size_t i = 0; i < scan.codes.size(); ++i) scan.codes[i] = bytes[i * bytes.size() / scan.codes.size()];
  checkScan(scan);
  std::vector<std::uint8_t> written = encodeScan(scan);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, bytes.size()); ++i) {
    written[(bytes[i] * bytes.size() + i) % written.size()] ^= bytes[bytes.size() - 1 - i];
  }
  if (const std::optional<PolarScan> changed = decodeScan(written)) checkScan(*changed);
  return 0;
}

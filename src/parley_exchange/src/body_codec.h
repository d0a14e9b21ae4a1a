// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_exchange/records.h"

namespace parley {

/// Bodies of records to bytes. What is given must pass the checks in checks.h.
Bytes encode(const ContourBody& contour);
Bytes encode(const AnchorBody& anchor);
Bytes encode(const EdgeBody& edge);
Bytes encode(const ContourReference& reference);
Bytes encode(const KeyframeBody& keyframe);

/// And back; nullopt if the bytes end too early or hold what cannot be.
std::optional<ContourBody> decodeContour(const Bytes& bytes);
std::optional<AnchorBody> decodeAnchor(const Bytes& bytes);
std::optional<EdgeBody> decodeEdge(const Bytes& bytes);
std::optional<ContourReference> decodeReference(const Bytes& bytes);
std::optional<KeyframeBody> decodeKeyframe(const Bytes& bytes);

}  // namespace parley

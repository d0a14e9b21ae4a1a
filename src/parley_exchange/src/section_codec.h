// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "parley_exchange/messages.h"

namespace parley {

constexpr std::size_t kMaxName = 24;           // [-] characters
constexpr std::size_t kMaxEchoes = 15;         // [-]
constexpr std::size_t kMaxDigest = 31;         // [-] entries in a packet
constexpr std::size_t kMaxIntervals = 5;       // [-] in an entry
constexpr std::size_t kMaxPoses = 48;          // [-] of a trajectory
constexpr std::size_t kMaxWay = 15;            // [-] corners
constexpr int kMaxDepth = 15;                  // [-]
constexpr std::size_t kMaxConflicts = 7;       // [-]
constexpr std::size_t kMaxBlobs = 8;           // [-]
constexpr std::size_t kMaxObservedScans = 8;   // [-]
constexpr std::size_t kMaxGroupRecords = 127;  // [-]

/// Bodies of sections. Encoding needs what the checks in checks.h let pass; of lists that are too long the rest is left out.
void encode(BitWriter& writer, const Beacon& beacon);
void encode(BitWriter& writer, const std::vector<Echo>& echoes);
void encode(BitWriter& writer, const std::vector<DigestEntry>& digest);
void encode(BitWriter& writer, const TrajectoryMessage& trajectory);
void encode(BitWriter& writer, const IntentMessage& intent);
void encode(BitWriter& writer, const std::vector<Conflict>& conflicts);
/// Not empty. Scans that are too old or too far from the first to be told behind it are left out.
void encode(BitWriter& writer, const std::vector<ObservationMessage>& scans);
void encode(BitWriter& writer, const RecordGroup& group);

/// nullopt if the body ends too early or holds what cannot be. What follows the fields known here is ignored.
std::optional<Beacon> decodeBeacon(BitReader reader);
std::optional<std::vector<Echo>> decodeEchoes(BitReader reader);
std::optional<std::vector<DigestEntry>> decodeDigest(BitReader reader);
std::optional<TrajectoryMessage> decodeTrajectory(BitReader reader);
std::optional<IntentMessage> decodeIntent(BitReader reader);
std::optional<std::vector<Conflict>> decodeConflicts(BitReader reader);
std::optional<std::vector<ObservationMessage>> decodeObservations(BitReader reader);
std::optional<RecordGroup> decodeRecords(BitReader reader);

/// No fewer bytes than the record adds to a group; the group's own are kGroupBytes.
std::size_t recordBytes(const Record& record);
constexpr std::size_t kGroupBytes = 13;  // [byte] with the section's header

/// The name's characters are printable and not too many.
bool isName(const std::string& name);

}  // namespace parley

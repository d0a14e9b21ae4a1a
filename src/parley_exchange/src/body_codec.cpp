// SPDX-License-Identifier: BSD-3-Clause
#include "body_codec.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "quantity.h"

namespace parley {
namespace {

constexpr int kVertexBits = 10;                                        // [-]
constexpr std::int64_t kLongestStep = std::int64_t{2} * kVertexLimit;  // [-] from vertex to vertex
constexpr int kCountBits = 6;                                          // [-]
constexpr LogQuantity kAnchorPositionSigma{1e-3, 4, 6};                // [m]
constexpr LogQuantity kAnchorYawSigma{1e-4, 4, 6};                     // [rad]
constexpr LogQuantity kEdgeSigma{1e-4, 12, 8};                         // [m] and [rad]
constexpr Quantity kCorrelation{1.0 / 128.0, 8, true};                 // [-]

void writeId(BitWriter& writer, std::uint32_t id) { writer.golomb(id, 4); }

std::uint32_t readId(BitReader& reader) {
  const std::uint32_t id = reader.golomb(4);
  if (id > 0xffff) reader.fail();
  return id;
}

void writeVertex(BitWriter& writer, int coordinate) {
  writer.bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)), kVertexBits);
}

/// What a reader would make of the correlations, scaled by a factor.
Eigen::Vector3d quantised(const Eigen::Vector3d& correlations, double factor) {
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    result[i] =
        static_cast<double>(std::max<std::int64_t>(-127, codeOf(factor * correlations[i], kCorrelation))) * kCorrelation.step;
  }
  return result;
}

Covariance3 covarianceOf(const Eigen::Vector3d& sigma, const Eigen::Vector3d& correlations) {
  Covariance3 covariance = sigma.cwiseProduct(sigma).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = sigma[0] * sigma[1] * correlations[0];
  covariance(0, 2) = covariance(2, 0) = sigma[0] * sigma[2] * correlations[1];
  covariance(1, 2) = covariance(2, 1) = sigma[1] * sigma[2] * correlations[2];
  return covariance;
}

void writeCovariance(BitWriter& writer, const Covariance3& covariance) {
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d exact(covariance(0, 1) / (sigma[0] * sigma[1]), covariance(0, 2) / (sigma[0] * sigma[2]),
                              covariance(1, 2) / (sigma[1] * sigma[2]));
  double factor = 1.0;
  // Rounding can make it indefinite; without correlations it never is.
  while (!isCovariance(covarianceOf(Eigen::Vector3d::Ones(), quantised(exact, factor)))) factor *= 0.97;
  for (int i = 0; i < 3; ++i) write(writer, sigma[i], kEdgeSigma);
  const Eigen::Vector3d correlations = quantised(exact, factor);
  for (int i = 0; i < 3; ++i) write(writer, correlations[i], kCorrelation);
}

Covariance3 readCovariance(BitReader& reader) {
  Eigen::Vector3d sigma, correlations;
  for (int i = 0; i < 3; ++i) sigma[i] = read(reader, kEdgeSigma);
  for (int i = 0; i < 3; ++i) correlations[i] = read(reader, kCorrelation);
  return covarianceOf(sigma, correlations);
}

}  // namespace

Bytes encode(const ContourBody& contour) {
  assert(!contour.vertices.empty() && contour.vertices.size() <= kMaxVertices);
  std::vector<std::int32_t> steps;
  for (std::size_t i = 1; i < contour.vertices.size(); ++i) {
    const Eigen::Vector2i step = contour.vertices[i] - contour.vertices[i - 1];
    steps.push_back(step.x());
    steps.push_back(step.y());
  }
  const int order = bestOrder(steps);
  BitWriter writer;
  writeId(writer, contour.anchor);
  writer.flag(contour.closed);
  writer.flag(contour.hole);
  writer.bits(contour.vertices.size(), kCountBits);
  writer.bits(static_cast<std::uint64_t>(order), 3);
  writeVertex(writer, contour.vertices.front().x());
  writeVertex(writer, contour.vertices.front().y());
  for (const std::int32_t step : steps) writer.signedGolomb(step, order);
  return writer.data();
}

std::optional<ContourBody> decodeContour(const Bytes& bytes) {
  BitReader reader(bytes);
  ContourBody contour;
  contour.anchor = readId(reader);
  contour.closed = reader.flag();
  contour.hole = reader.flag();
  const std::size_t count = reader.bits(kCountBits);
  const int order = static_cast<int>(reader.bits(3));
  if (count == 0 || count > kMaxVertices) return std::nullopt;
  Eigen::Vector2i vertex;
  vertex.x() = static_cast<int>(readSigned(reader, kVertexBits));
  vertex.y() = static_cast<int>(readSigned(reader, kVertexBits));
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    if (i > 0) {
      const std::int32_t x = reader.signedGolomb(order), y = reader.signedGolomb(order);
      if (std::max(std::abs(std::int64_t{x}), std::abs(std::int64_t{y})) > kLongestStep) return std::nullopt;
      vertex += Eigen::Vector2i(x, y);
    }
    if (vertex.cwiseAbs().maxCoeff() > kVertexLimit) return std::nullopt;
    contour.vertices.push_back(vertex);
  }
  return reader.ok() ? std::make_optional(contour) : std::nullopt;
}

Bytes encode(const AnchorBody& anchor) {
  BitWriter writer;
  writePose(writer, anchor.pose, kFinePosition, kFineYawBits);
  write(writer, anchor.position_sigma, kAnchorPositionSigma);
  write(writer, anchor.yaw_sigma, kAnchorYawSigma);
  return writer.data();
}

std::optional<AnchorBody> decodeAnchor(const Bytes& bytes) {
  BitReader reader(bytes);
  AnchorBody anchor;
  anchor.pose = readPose(reader, kFinePosition, kFineYawBits);
  anchor.position_sigma = read(reader, kAnchorPositionSigma);
  anchor.yaw_sigma = read(reader, kAnchorYawSigma);
  return reader.ok() ? std::make_optional(anchor) : std::nullopt;
}

Bytes encode(const EdgeBody& edge) {
  BitWriter writer;
  writeId(writer, edge.anchor);
  writer.bits(edge.peer, 32);
  writer.bits(edge.peer_epoch, 16);
  writeId(writer, edge.peer_anchor);
  writePose(writer, edge.T_anchor_peer.pose, kEdgePosition, kEdgeYawBits);
  writeCovariance(writer, edge.T_anchor_peer.covariance);
  writer.bits(static_cast<std::uint64_t>(std::clamp(edge.support, 0, 63)), 6);
  writer.bits(static_cast<std::uint64_t>(edge.state), 2);
  return writer.data();
}

std::optional<EdgeBody> decodeEdge(const Bytes& bytes) {
  BitReader reader(bytes);
  EdgeBody edge;
  edge.anchor = readId(reader);
  edge.peer = static_cast<RobotId>(reader.bits(32));
  edge.peer_epoch = static_cast<std::uint16_t>(reader.bits(16));
  edge.peer_anchor = readId(reader);
  edge.T_anchor_peer.pose = readPose(reader, kEdgePosition, kEdgeYawBits);
  edge.T_anchor_peer.covariance = readCovariance(reader);
  edge.support = static_cast<int>(reader.bits(6));
  const std::uint64_t state = reader.bits(2);
  if (!reader.ok() || state > static_cast<std::uint64_t>(EdgeState::kWithdrawn)) return std::nullopt;
  edge.state = static_cast<EdgeState>(state);
  return edge;
}

Bytes encode(const ContourReference& reference) {
  BitWriter writer;
  writer.bits(reference.origin, 32);
  writer.bits(reference.epoch, 16);
  writeId(writer, reference.id);
  writer.golomb(reference.sequence, 6);
  return writer.data();
}

std::optional<ContourReference> decodeReference(const Bytes& bytes) {
  BitReader reader(bytes);
  ContourReference reference;
  reference.origin = static_cast<RobotId>(reader.bits(32));
  reference.epoch = static_cast<std::uint16_t>(reader.bits(16));
  reference.id = readId(reader);
  reference.sequence = reader.golomb(6);
  return reader.ok() ? std::make_optional(reference) : std::nullopt;
}

Bytes encode(const KeyframeBody& keyframe) {
  assert(keyframe.descriptor.size() <= kMaxDescriptor);
  BitWriter writer;
  writer.bits(keyframe.stamp, 32);
  writePose(writer, keyframe.pose, kFinePosition, kFineYawBits);
  writer.bytes(keyframe.descriptor);
  return writer.data();
}

std::optional<KeyframeBody> decodeKeyframe(const Bytes& bytes) {
  BitReader reader(bytes);
  KeyframeBody keyframe;
  keyframe.stamp = static_cast<std::uint32_t>(reader.bits(32));
  keyframe.pose = readPose(reader, kFinePosition, kFineYawBits);
  if (!reader.ok() || reader.remainingBits() / 8 > kMaxDescriptor) return std::nullopt;
  keyframe.descriptor = reader.bytes(reader.remainingBits() / 8);
  return keyframe;
}

}  // namespace parley

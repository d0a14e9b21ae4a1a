// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <limits>

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr double kNanoseconds = 1e-9;           // [s]
constexpr double kLatestInSeconds = 1e11;       // a later time since 1970 is in nanoseconds
constexpr std::uint64_t kMostBytes = 1U << 30;  // a larger cloud is a mistake

enum class TimeKind { kNone, kSeconds, kWholeNanoseconds, kAbsolute };

/// Where in a point its parts are, as offsets in bytes.
struct Layout {
  std::uint32_t x = 0, y = 0, z = 0, time = 0;
  TimeKind time_kind = TimeKind::kNone;
};

template <class Value>
Value valueAt(const std::uint8_t* data) {
  Value value;
  std::memcpy(&value, data, sizeof(value));
  return value;
}

std::optional<std::uint32_t> offsetOf(const PointCloud2& message, const char* name, std::uint8_t type, std::uint32_t size) {
  for (const PointField& field : message.fields) {
    const bool fits = message.point_step >= size && field.offset <= message.point_step - size;
    if (field.name == name && field.datatype == type && fits) return field.offset;
  }
  return std::nullopt;
}

std::optional<Layout> layoutOf(const PointCloud2& message) {
  const auto x = offsetOf(message, "x", PointField::FLOAT32, 4);
  const auto y = offsetOf(message, "y", PointField::FLOAT32, 4);
  const auto z = offsetOf(message, "z", PointField::FLOAT32, 4);
  if (!x || !y || !z) return std::nullopt;
  Layout layout{*x, *y, *z};
  if (const auto seconds = offsetOf(message, "time", PointField::FLOAT32, 4)) {
    layout.time = *seconds;
    layout.time_kind = TimeKind::kSeconds;
  }
  for (const char* name : {"t", "offset_time"}) {
    if (const auto nanoseconds = offsetOf(message, name, PointField::UINT32, 4)) {
      layout.time = *nanoseconds;
      layout.time_kind = TimeKind::kWholeNanoseconds;
    }
  }
  if (const auto absolute = offsetOf(message, "timestamp", PointField::FLOAT64, 8)) {
    layout.time = *absolute;
    layout.time_kind = TimeKind::kAbsolute;
  }
  return layout;
}

bool isWhole(const PointCloud2& message) {
  const std::uint64_t row = static_cast<std::uint64_t>(message.width) * message.point_step;
  const std::uint64_t all = static_cast<std::uint64_t>(message.height) * message.row_step;
  return !message.is_bigendian && row <= message.row_step && all <= kMostBytes && all <= message.data.size();
}

/// [s] after the cloud's stamp
double timeOf(const std::uint8_t* point, const Layout& layout, double stamp) {
  switch (layout.time_kind) {
    case TimeKind::kSeconds:
      return valueAt<float>(point + layout.time);
    case TimeKind::kWholeNanoseconds:
      return kNanoseconds * valueAt<std::uint32_t>(point + layout.time);
    case TimeKind::kAbsolute: {
      const double time = valueAt<double>(point + layout.time);
      return (time > kLatestInSeconds ? kNanoseconds * time : time) - stamp;
    }
    case TimeKind::kNone:
      break;
  }
  return 0.0;
}

}  // namespace

std::optional<LidarCloud> fromMessage(const PointCloud2& message) {
  const std::optional<Layout> layout = layoutOf(message);
  if (!layout || !isWhole(message)) return std::nullopt;
  LidarCloud cloud;
  cloud.stamp = message.header.stamp.toSec();
  cloud.points.reserve(static_cast<std::size_t>(message.width) * message.height);
  for (std::uint32_t row = 0; row < message.height; ++row) {
    const std::uint8_t* point = message.data.data() + static_cast<std::size_t>(row) * message.row_step;
    for (std::uint32_t column = 0; column < message.width; ++column, point += message.point_step) {
      cloud.points.push_back({valueAt<float>(point + layout->x), valueAt<float>(point + layout->y),
                              valueAt<float>(point + layout->z), static_cast<float>(timeOf(point, *layout, cloud.stamp))});
    }
  }
  return cloud;
}

PointCloud2 toMessage(const LidarCloud& cloud, const std::string& lidar_frame) {
  static_assert(sizeof(LidarPoint) == 16, "copied as it lies in memory");
  PointCloud2 message;
  message.header.stamp.fromSec(std::max(0.0, cloud.stamp));
  message.header.frame_id = lidar_frame;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(cloud.points.size());
  message.point_step = sizeof(LidarPoint);
  message.row_step = message.point_step * message.width;
  message.is_dense = false;
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z", "time"}) {
    PointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = PointField::FLOAT32;
    field.count = 1;
    message.fields.push_back(field);
    offset += 4;
  }
  message.data.resize(message.row_step);
  if (!cloud.points.empty()) std::memcpy(message.data.data(), cloud.points.data(), message.data.size());
  return message;
}

}  // namespace parley

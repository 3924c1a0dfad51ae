#include "hal/igtl/pose_message.h"

#include <array>
#include <bit>
#include <cmath>

#include "base/units.h"

namespace orthonav::igtl {
namespace {

constexpr std::size_t kMatrixBytes = 48;
constexpr std::size_t kTdataBytes = 70;   ///< name, type, reserved, matrix
constexpr std::size_t kQtdataBytes = 50;  ///< name, type, reserved, position, quaternion
/// Rounding to float changes a rotation by a thousandth of this.
constexpr double kMaxSkew = 1e-3;
constexpr double kFarthest_m = 20.0;

double real_in(Bytes bytes, std::size_t index) {
  const auto bits = static_cast<std::uint32_t>(number_in(bytes.subspan(4 * index, 4)));
  return static_cast<double>(std::bit_cast<float>(bits));
}

Vec3 vector_in(Bytes bytes, std::size_t first) {
  return {real_in(bytes, first), real_in(bytes, first + 1), real_in(bytes, first + 2)};
}

Result<SentPose> checked_pose(const std::string& name, const Mat3& rotation, Vec3 translation_mm) {
  if (rotation == Mat3::identity() && translation_mm == Vec3{}) {
    return SentPose{name, std::nullopt};
  }
  const Vec3 translation_m = translation_mm * kMetresPerMm;
  const auto pose = Transform<World, Marker>::checked(rotation, translation_m, kMaxSkew);
  if (!pose) {
    return Error{name + ": " + pose.error().message};
  }
  if (!(translation_m.norm() <= kFarthest_m)) {
    return Error{name + ": lies " + std::to_string(translation_m.norm()) + " m away, limit " +
                 std::to_string(kFarthest_m) + " m"};
  }
  return SentPose{name, *pose};
}

/// Columns of the rotation, then the translation.
Result<SentPose> from_matrix(const std::string& name, Bytes matrix) {
  Mat3 rotation;
  for (int column = 0; column < 3; ++column) {
    const Vec3 values = vector_in(matrix, 3 * static_cast<std::size_t>(column));
    for (int row = 0; row < 3; ++row) {
      rotation[row][column] = values[row];
    }
  }
  return checked_pose(name, rotation, vector_in(matrix, 9));
}

/// Position, then x, y, z, w.
Result<SentPose> from_quaternion(const std::string& name, Bytes values) {
  const Vec3 v = vector_in(values, 3);
  const double w = real_in(values, 6);
  const double length = std::sqrt(v.dot(v) + w * w);
  if (!(std::abs(length - 1.0) <= kMaxSkew)) {
    return Error{name + ": quaternion has length " + std::to_string(length) + ", must be 1"};
  }
  return checked_pose(name, rotation_from_quaternion({v.x, v.y, v.z, w}), vector_in(values, 0));
}

Error wrong_length(const Header& header, std::size_t bytes) {
  return Error{header.type + " " + header.device + ": " + std::to_string(bytes) +
               " bytes, which is not its length"};
}

}  // namespace

bool holds_poses(const std::string& type) {
  return type == "TRANSFORM" || type == "TDATA" || type == "QTDATA";
}

Result<std::vector<SentPose>> poses_in(const Header& header, Bytes body) {
  const auto content = content_of(header, body);
  if (!content) {
    return content.error();
  }
  const Bytes bytes = content->bytes;
  std::vector<SentPose> poses;
  const auto add = [&](Result<SentPose> pose) {
    if (pose) {
      poses.push_back(std::move(*pose));
    }
    return pose ? Status{} : Status(pose.error());
  };
  if (header.type == "TRANSFORM") {
    if (bytes.size() != kMatrixBytes) {
      return wrong_length(header, bytes.size());
    }
    const std::string& status = content->transform_status;
    const bool known = status.empty() || status == "OK";
    const Status added =
        known ? add(from_matrix(header.device, bytes)) : add(SentPose{header.device, std::nullopt});
    return added ? Result(std::move(poses)) : added.error();
  }
  const bool matrices = header.type == "TDATA";
  const std::size_t each = matrices ? kTdataBytes : kQtdataBytes;
  if (bytes.size() % each != 0) {
    return wrong_length(header, bytes.size());
  }
  for (Bytes rest = bytes; !rest.empty(); rest = rest.subspan(each)) {
    const std::string name = name_in(rest.first(kNameBytes));
    const Bytes values = rest.subspan(kNameBytes + 2, each - kNameBytes - 2);
    const Status added = add(matrices ? from_matrix(name, values) : from_quaternion(name, values));
    if (!added) {
      return added.error();
    }
  }
  return poses;
}

}  // namespace orthonav::igtl

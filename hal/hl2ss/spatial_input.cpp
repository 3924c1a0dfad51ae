#include "hal/hl2ss/spatial_input.h"

#include <cmath>
#include <string>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::uint32_t kHead = 1;
constexpr std::uint32_t kEyes = 2;
constexpr std::uint32_t kLeftHand = 4;
constexpr std::uint32_t kRightHand = 8;
/// A direction may be this far from unit length, two axes this far from perpendicular.
constexpr double kMaxDeviation = 1e-2;

Vec3 take_vec3(ByteReader& reader) {
  const double x = reader.take<float>();
  const double y = reader.take<float>();
  const double z = reader.take<float>();
  return {x, y, z};
}

bool is_unit(Vec3 v) { return std::abs(v.norm() - 1.0) <= kMaxDeviation; }

Result<Transform<World, Eye>> head_of(Vec3 position, Vec3 forward, Vec3 up) {
  // y = up, z = -forward, x = y × z.
  const Vec3 z = -forward;
  auto head = Transform<World, Eye>::checked(Mat3::from_columns(up.cross(z), up, z), position,
                                             2.0 * kMaxDeviation);
  if (!head) {
    return Error{"spatial input: head: " + head.error().message};
  }
  return head;
}

/// Nothing if the hand is not in view.
Result<std::optional<Hand>> take_hand(ByteReader& reader, const char* which, bool valid) {
  Hand hand;
  bool finite = true;
  for (HandJoint& joint : hand) {
    joint.orientation.x = reader.take<float>();
    joint.orientation.y = reader.take<float>();
    joint.orientation.z = reader.take<float>();
    joint.orientation.w = reader.take<float>();
    joint.position.v = take_vec3(reader);
    joint.radius_m = reader.take<float>();
    joint.accuracy = reader.take<std::int32_t>();
    const Quaternion& q = joint.orientation;
    finite = finite && joint.position.v.is_finite() && std::isfinite(joint.radius_m) &&
             std::isfinite(q.x + q.y + q.z + q.w);
  }
  if (valid && !finite) {
    return Error{std::string("spatial input: ") + which +
                 " hand holds a number that is not finite"};
  }
  return valid ? std::optional<Hand>(hand) : std::nullopt;
}

}  // namespace

Result<SpatialInput> read_spatial_input(Bytes payload) {
  if (payload.size() != kSpatialInputBytes) {
    return Error{"spatial input: " + std::to_string(payload.size()) + " bytes, must be " +
                 std::to_string(kSpatialInputBytes)};
  }
  ByteReader reader(payload);
  SpatialInput input;
  const auto valid = reader.take<std::uint32_t>();
  const Vec3 position = take_vec3(reader);
  const Vec3 forward = take_vec3(reader);
  const Vec3 up = take_vec3(reader);
  if ((valid & kHead) != 0) {
    const auto head = head_of(position, forward, up);
    if (!head) {
      return head.error();
    }
    input.world_from_head = *head;
  }
  const Vec3 eye = take_vec3(reader);
  const Vec3 gaze = take_vec3(reader);
  if ((valid & kEyes) != 0) {
    if (!eye.is_finite() || !is_unit(gaze)) {
      return Error{"spatial input: gaze is " + std::to_string(gaze.norm()) +
                   " long, must be a unit vector at a finite place"};
    }
    input.eyes = GazeRay{{eye}, {gaze}};
  }
  const auto left = take_hand(reader, "left", (valid & kLeftHand) != 0);
  if (!left) {
    return left.error();
  }
  input.left_hand = *left;
  const auto right = take_hand(reader, "right", (valid & kRightHand) != 0);
  if (!right) {
    return right.error();
  }
  input.right_hand = *right;
  return input;
}

std::vector<std::uint8_t> spatial_input_bytes(
    const std::optional<Transform<World, Eye>>& world_from_head) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kSpatialInputBytes);
  append(bytes, world_from_head ? kHead : std::uint32_t{0});
  const Transform<World, Eye> head = world_from_head.value_or(Transform<World, Eye>{});
  for (const Vec3 v : {head.translation(), -head.rotation().column(2), head.rotation().column(1)}) {
    for (int i = 0; i < 3; ++i) {
      append(bytes, static_cast<float>(v[i]));
    }
  }
  bytes.resize(kSpatialInputBytes);
  return bytes;
}

}  // namespace orthonav::hl2ss

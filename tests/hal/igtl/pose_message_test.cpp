#include "hal/igtl/pose_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <igtlQuaternionTrackingDataMessage.h>
#include <igtlTrackingDataMessage.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/igtl/message.h"

namespace orthonav::igtl::pose_message_test {
namespace {

using ::testing::HasSubstr;
using Buffer = std::vector<std::uint8_t>;

/// A float's share of a rotation, and of a metre.
constexpr double kFloat = 1e-6;

/// A third of a turn about the diagonal: x to y, y to z, z to x; 100, 200, 300 mm away.
constexpr TransformValues kRotated = {0, 1, 0, 0, 0, 1, 1, 0, 0, 100, 200, 300};

Header header_of(const Buffer& message) {
  return parsed_header(std::span<const std::uint8_t, kHeaderBytes>(message.data(), kHeaderBytes))
      .value();
}

Result<std::vector<SentPose>> read(const Buffer& message) {
  return poses_in(header_of(message), Bytes(message).subspan(kHeaderBytes));
}

std::string refusal(const Buffer& message) {
  const auto poses = read(message);
  EXPECT_FALSE(poses.ok());
  return poses ? "" : poses.error().message;
}

Buffer transform(const TransformValues& values) { return packed({"ProbeToTracker", 0}, values); }

void expect_rotated(const SentPose& pose) {
  ASSERT_TRUE(pose.world_from_marker);
  const Vec3 there = (*pose.world_from_marker * Point<Marker>{{0.001, 0.002, 0.003}}).v;
  EXPECT_LT((there - Vec3{0.103, 0.201, 0.302}).norm(), kFloat);
}

/// What Debian's library packs.
template <class Message>
Buffer bytes_of(Message& message) {
  message.SetDeviceName("Tracker");
  message.Pack();
  const auto* first = static_cast<const std::uint8_t*>(message.GetPackPointer());
  return {first, first + message.GetPackSize()};
}

/// As versions 2 and 3 have it: an extended header in front, metadata behind.
Buffer with_metadata(Buffer message, const std::string& key, const std::string& value) {
  Buffer body = {0, 12, 0, 10, 0, 0, 0, static_cast<std::uint8_t>(key.size() + value.size()),
                 0, 0,  0, 0};
  body.insert(body.end(), message.begin() + kHeaderBytes, message.end());
  const Buffer index = {0, 1, 0, static_cast<std::uint8_t>(key.size()),  0, 3,
                        0, 0, 0, static_cast<std::uint8_t>(value.size())};
  body.insert(body.end(), index.begin(), index.end());
  body.insert(body.end(), key.begin(), key.end());
  body.insert(body.end(), value.begin(), value.end());
  message.resize(kHeaderBytes);
  message[1] = 2;
  message[49] = static_cast<std::uint8_t>(body.size());
  std::fill(message.begin() + 50, message.end(), 0);  // no checksum
  message.insert(message.end(), body.begin(), body.end());
  return message;
}

TEST(IgtlPoses, ATransformIsReadByColumnsAndFromMillimetres) {
  const auto poses = read(transform(kRotated));
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  ASSERT_EQ(poses->size(), 1u);
  EXPECT_EQ(poses->front().name, "ProbeToTracker");
  expect_rotated(poses->front());
}

TEST(IgtlPoses, TrackingDataOfDebiansLibraryAreRead) {
  const auto message = ::igtl::TrackingDataMessage::New();
  for (const char* name : {"ProbeToTracker", "ReferenceToTracker"}) {
    ::igtl::TrackingDataElement::Pointer element = ::igtl::TrackingDataElement::New();
    element->SetName(name);
    element->SetType(::igtl::TrackingDataElement::TYPE_6D);
    ::igtl::Matrix4x4 matrix = {{0, 0, 1, 100}, {1, 0, 0, 200}, {0, 1, 0, 300}, {0, 0, 0, 1}};
    element->SetMatrix(matrix);
    message->AddTrackingDataElement(element);
  }
  const auto poses = read(bytes_of(*message));
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  ASSERT_EQ(poses->size(), 2u);
  EXPECT_EQ(poses->back().name, "ReferenceToTracker");
  expect_rotated(poses->back());
}

TEST(IgtlPoses, QuaternionsOfDebiansLibraryAreRead) {
  const auto message = ::igtl::QuaternionTrackingDataMessage::New();
  ::igtl::QuaternionTrackingDataElement::Pointer element =
      ::igtl::QuaternionTrackingDataElement::New();
  element->SetName("ProbeToTracker");
  element->SetType(::igtl::QuaternionTrackingDataElement::TYPE_6D);
  element->SetPosition(100, 200, 300);
  element->SetQuaternion(0.5F, 0.5F, 0.5F, 0.5F);
  message->AddQuaternionTrackingDataElement(element);
  Buffer bytes = bytes_of(*message);
  const auto poses = read(bytes);
  ASSERT_TRUE(poses.ok()) << poses.error().message;
  ASSERT_EQ(poses->size(), 1u);
  expect_rotated(poses->front());

  element->SetQuaternion(0.5F, 0.5F, 0.5F, 0.9F);
  const auto longer = ::igtl::QuaternionTrackingDataMessage::New();
  longer->AddQuaternionTrackingDataElement(element);
  EXPECT_THAT(refusal(bytes_of(*longer)), HasSubstr("quaternion has length"));
}

TEST(IgtlPoses, AnIdentityIsALostTool) {
  const auto lost = read(transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  ASSERT_TRUE(lost.ok());
  EXPECT_FALSE(lost->front().world_from_marker);
  const auto near = read(transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.001F}));
  ASSERT_TRUE(near.ok());
  EXPECT_TRUE(near->front().world_from_marker) << "the control";
}

TEST(IgtlPoses, MetadataSayThatAToolIsLost) {
  const auto seen = read(with_metadata(transform(kRotated), "TransformStatus", "OK"));
  ASSERT_TRUE(seen.ok()) << seen.error().message;
  expect_rotated(seen->front());
  const auto lost = read(with_metadata(transform(kRotated), "TransformStatus", "MISSING"));
  ASSERT_TRUE(lost.ok());
  EXPECT_FALSE(lost->front().world_from_marker);
  const auto other = read(with_metadata(transform(kRotated), "ToolStatus", "MISSING"));
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(other->front().world_from_marker);
}

TEST(IgtlPoses, WhatIsNoRigidMotionIsRefusedByName) {
  TransformValues values = kRotated;
  values[6] = -1;
  EXPECT_THAT(refusal(transform(values)), HasSubstr("ProbeToTracker: transform mirrors"));
  values = kRotated;
  values[1] = 1.002F;
  EXPECT_THAT(refusal(transform(values)), HasSubstr("is not rigid"));
  values[1] = 1.0001F;
  EXPECT_TRUE(read(transform(values)).ok()) << "a float's rounding";
  values = kRotated;
  values[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal(transform(values)), HasSubstr("not finite"));
  values[9] = 20001.0F;
  EXPECT_THAT(refusal(transform(values)), HasSubstr("limit 20"));
}

TEST(IgtlPoses, AMessageThatIsCutOrChangedIsRefused) {
  Buffer changed = transform(kRotated);
  changed.back() ^= 1u;
  EXPECT_THAT(refusal(changed), HasSubstr("checksum"));
  std::fill(changed.begin() + 50, changed.begin() + kHeaderBytes, 0);
  EXPECT_TRUE(read(changed).ok()) << "a sender that computes none";
  Buffer shorter = changed;
  shorter.pop_back();
  EXPECT_THAT(refusal(shorter), HasSubstr("47 bytes"));
  Buffer broken = with_metadata(transform(kRotated), "TransformStatus", "OK");
  broken[kHeaderBytes + 4] = 0xff;  // metadata of gigabytes
  EXPECT_THAT(refusal(broken), HasSubstr("not within"));
}

}  // namespace
}  // namespace orthonav::igtl::pose_message_test

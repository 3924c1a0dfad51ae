#include "hal/hl2ss/packet.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/video.h"

namespace orthonav::hl2ss::parser_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kSingle = 1e-6;

Transform<World, Rig> some_pose() {
  return {rotation_from_vector({0.3, -1.1, 0.4}), {0.25, 1.6, -0.75}};
}

std::vector<std::uint8_t> packet_of(std::uint64_t ticks, std::size_t payload, bool pose) {
  std::vector<std::uint8_t> bytes;
  append(bytes, ticks);
  append(bytes, static_cast<std::uint32_t>(payload));
  for (std::size_t i = 0; i < payload; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i));
  }
  if (pose) {
    append_pose(bytes, some_pose());
  }
  return bytes;
}

TEST(Packets, ComeOutHoweverTheyWereTorn) {
  std::vector<std::uint8_t> stream = packet_of(5, 100, true);
  const auto second = packet_of(6, 0, true);
  const auto third = packet_of(7, 33, true);
  stream.insert(stream.end(), second.begin(), second.end());
  stream.insert(stream.end(), third.begin(), third.end());
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    PacketAssembler assembler("test", {200, true});
    std::vector<std::uint64_t> ticks;
    std::vector<std::size_t> sizes;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      const std::size_t count = std::min(piece, stream.size() - at);
      const auto room = assembler.room();
      ASSERT_GE(room.size(), count);
      std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, room.begin());
      assembler.received(count);
      for (;;) {
        const auto packet = assembler.next();
        ASSERT_TRUE(packet.ok());
        if (!*packet) {
          break;
        }
        ticks.push_back((*packet)->ticks);
        sizes.push_back((*packet)->payload.size());
        EXPECT_TRUE(*read_pose((*packet)->pose));
      }
    }
    ASSERT_THAT(ticks, ElementsAre(5, 6, 7)) << piece;
    ASSERT_THAT(sizes, ElementsAre(100, 0, 33)) << piece;
  }
}

TEST(Packets, OfFourGigabytesAreRefusedBeforeAnythingIsKept) {
  PacketAssembler assembler("left camera", {200, true});
  auto bytes = packet_of(5, 0, false);
  const std::uint32_t size = std::numeric_limits<std::uint32_t>::max();
  std::memcpy(bytes.data() + 8, &size, 4);
  std::copy(bytes.begin(), bytes.end(), assembler.room().begin());
  assembler.received(bytes.size());
  const auto packet = assembler.next();
  ASSERT_FALSE(packet.ok());
  EXPECT_EQ(packet.error().message, "left camera: payload of 4294967295 bytes, limit 200");
}

TEST(Images, OfUpTo24BytesAreNoFault) {
  EXPECT_FALSE(split_image(std::vector<std::uint8_t>(24)).has_value());
  EXPECT_FALSE(split_image({}).has_value());
  std::vector<std::uint8_t> payload = {9};
  append(payload, std::uint64_t{123});
  append(payload, std::uint64_t{456});
  append(payload, std::uint32_t{78});
  append(payload, std::uint32_t{0});
  const auto image = split_image(payload);
  ASSERT_TRUE(image.has_value());
  EXPECT_THAT(image->image, ElementsAre(9));
  EXPECT_EQ(image->trailer.sensor_ticks, 123u);
  EXPECT_EQ(image->trailer.exposure_ns, 456u);
  EXPECT_EQ(image->trailer.gain, 78u);
}

TEST(Poses, AreTransposed) {
  std::vector<std::uint8_t> bytes;
  append_pose(bytes, some_pose());
  ASSERT_EQ(bytes.size(), kPoseBytes);
  EXPECT_FLOAT_EQ(number_at<float>(bytes, 4 * 12), 0.25f) << "translation at 12..14";
  const auto pose = read_pose(bytes);
  ASSERT_TRUE(pose.ok() && *pose);
  EXPECT_LT(((*pose)->translation() - some_pose().translation()).norm(), kSingle);
  EXPECT_LT(rotation_angle_rad((*pose)->rotation(), some_pose().rotation()), kSingle);
}

TEST(Poses, ThatAreNoneAreToldFromDamage) {
  EXPECT_FALSE(read_pose(std::vector<std::uint8_t>(64))->has_value()) << "not located";
  const auto refusal = [](int entry, float value) {
    std::vector<std::uint8_t> bytes;
    append_pose(bytes, some_pose());
    std::memcpy(bytes.data() + 4 * entry, &value, 4);
    const auto pose = read_pose(bytes);
    return pose ? "accepted" : pose.error().message;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int entry = 0; entry < 16; ++entry) {
    EXPECT_THAT(refusal(entry, nan), HasSubstr("pose: ")) << entry;
  }
  EXPECT_THAT(refusal(13, std::numeric_limits<float>::infinity()), HasSubstr("from the origin"));
  EXPECT_THAT(refusal(12, 2e4f), HasSubstr("limit"));
  EXPECT_THAT(refusal(0, 3.0f), HasSubstr("not rigid"));
  EXPECT_THAT(refusal(3, 0.5f), HasSubstr("last column"));
  EXPECT_FALSE(read_pose(std::vector<std::uint8_t>(63)).ok());
}

}  // namespace
}  // namespace orthonav::hl2ss::parser_test

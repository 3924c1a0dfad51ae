#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "hal/hl2ss/packet.h"
#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/spatial_input.h"
#include "hal/hl2ss/standin_message.h"
#include "hal/hl2ss/video.h"
#include "hal/hl2ss/voice.h"

namespace orthonav::hl2ss {
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

TEST(Requests, AreWhatTheServerExpectsToTheByte) {
  EXPECT_THAT(request_bytes({Mode::kVideoAndPose, 1, VideoProfile::kRaw, 0x01020304}),
              ElementsAre(1, 1, 255, 255, 4, 3, 2, 1, 0));
  EXPECT_THAT(request_bytes({Mode::kVideoAndPose, 1, VideoProfile::kH264Base, 1}),
              ElementsAre(1, 1, 0, 255, 1, 0, 0, 0, 0));
  EXPECT_THAT(request_bytes({Mode::kCalibration}), ElementsAre(2));
  const auto vocabulary = vocabulary_bytes({"up", "go"});
  ASSERT_TRUE(vocabulary.ok());
  EXPECT_THAT(*vocabulary, ElementsAre(2, 0, 4, 0, 'u', 0, 'p', 0, 4, 0, 'g', 0, 'o', 0));
}

TEST(Requests, AreReadByAServer) {
  const VideoRequest asked{Mode::kVideo, 3, VideoProfile::kH264High, 77};
  const auto bytes = request_bytes(asked);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto early = read_video_request(Bytes(bytes).first(i));
    ASSERT_TRUE(early.ok());
    EXPECT_FALSE(early->has_value()) << i;
  }
  const auto read = read_video_request(bytes);
  ASSERT_TRUE(read.ok() && *read);
  EXPECT_EQ((*read)->bytes, bytes.size());
  EXPECT_EQ((*read)->request.divisor, 3);
  EXPECT_EQ((*read)->request.profile, VideoProfile::kH264High);
  EXPECT_EQ((*read)->request.bitrate, 77u);
  // Unknown options are skipped once they have arrived completely.
  std::vector<std::uint8_t> with_options = bytes;
  with_options[8] = 2;
  with_options.resize(9 + 31);
  EXPECT_FALSE(read_video_request(with_options)->has_value());
  with_options.resize(9 + 32);
  EXPECT_EQ((*read_video_request(with_options))->bytes, 41u);
  EXPECT_FALSE((*read_video_request(with_options))->request.options.has_value());
}

TEST(Requests, AskForKeyFramesAndForStampsThatAreNotLate) {
  VideoRequest asked;
  asked.options = VideoOptions{30, 0.5, -125'000};
  const auto bytes = request_bytes(asked);
  ASSERT_EQ(bytes.size(), 9u + 3 * 16);
  EXPECT_EQ(bytes[8], 3);
  EXPECT_EQ(number_at<std::uint64_t>(bytes, 9), 10u);
  EXPECT_EQ(number_at<std::uint64_t>(bytes, 17), 30u);
  EXPECT_EQ(number_at<std::uint64_t>(bytes, 25), 0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ(number_at<double>(bytes, 33), 0.5);
  EXPECT_EQ(number_at<std::uint64_t>(bytes, 41), 0xFFFFFFFFFFFFFFFEu);
  EXPECT_EQ(number_at<std::int64_t>(bytes, 49), -125'000);
  const auto read = read_video_request(bytes);
  ASSERT_TRUE(read.ok() && *read);
  ASSERT_TRUE((*read)->request.options.has_value());
  EXPECT_EQ((*read)->request.options->gop_size, 30u);
  EXPECT_EQ((*read)->request.options->stamp_exposures, 0.5);
  EXPECT_EQ((*read)->request.options->stamp_offset_ticks, -125'000);
}

TEST(Requests, ThatNobodyMayMakeAreRefused) {
  const auto refusal = [](std::vector<std::uint8_t> bytes) {
    const auto read = read_video_request(bytes);
    return read ? "accepted" : read.error().message;
  };
  EXPECT_THAT(refusal({3}), HasSubstr("mode 3"));
  EXPECT_THAT(refusal({1, 0, 255, 255, 1, 0, 0, 0, 0}), HasSubstr("divisor 0"));
  EXPECT_THAT(refusal({1, 1, 3, 255, 1, 0, 0, 0, 0}), HasSubstr("profile 3"));
  EXPECT_THAT(refusal({1, 1, 255, 255, 0, 0, 0, 0, 0}), HasSubstr("bitrate 0"));
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

TEST(SpatialInputs, TellTheHeadByItsAxes) {
  const Transform<World, Eye> head(rotation_from_vector({0.1, 0.7, -0.2}), {0.1, 1.7, 0.3});
  const auto bytes = spatial_input_bytes(head);
  ASSERT_EQ(bytes.size(), kSpatialInputBytes);
  const auto read = read_spatial_input(bytes);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_TRUE(read->world_from_head.has_value());
  EXPECT_LT(rotation_angle_rad(read->world_from_head->rotation(), head.rotation()), kSingle);
  EXPECT_LT((read->world_from_head->translation() - head.translation()).norm(), kSingle);
  EXPECT_FALSE(read->eyes || read->left_hand || read->right_hand);
}

TEST(SpatialInputs, OldValuesThatAreNotValidMayBeAnything) {
  std::vector<std::uint8_t> bytes(kSpatialInputBytes, 0xff);  // every number is NaN
  std::memset(bytes.data(), 0, 4);
  EXPECT_TRUE(read_spatial_input(bytes).ok());
  for (const int valid : {1, 2, 4, 8}) {
    bytes[0] = static_cast<std::uint8_t>(valid);
    EXPECT_FALSE(read_spatial_input(bytes).ok()) << valid;
  }
  EXPECT_FALSE(read_spatial_input(std::vector<std::uint8_t>(1935)).ok());
}

TEST(VoiceAnswers, ComeWhole) {
  const std::vector<VoiceResult> results = {{2, 0, 5, 6, 0.9}, {9, 3, 7, 8, 0.1}};
  const auto bytes = voice_answer_bytes(results);
  ASSERT_EQ(bytes.size(), 4u + 2 * 32);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(read_voice_answer(Bytes(bytes).first(i))->has_value());
  }
  const auto read = read_voice_answer(bytes);
  ASSERT_TRUE(read.ok() && *read);
  EXPECT_EQ((*read)->bytes, bytes.size());
  EXPECT_EQ((*read)->results[1].index, 9u);
  EXPECT_EQ((*read)->results[1].start, 8u);
}

TEST(VoiceAnswers, WithTooManyOrUnknownResultsAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, std::uint32_t{0xffffffff});
  EXPECT_THAT(read_voice_answer(bytes).error().message, HasSubstr("4294967295 results, limit 64"));
  EXPECT_THAT(read_voice_answer(voice_answer_bytes({{0, 4, 0, 0, 0.0}})).error().message,
              HasSubstr("confidence 4"));
}

TEST(VoiceAnswers, HaveConfidencesAsPhrasesDo) {
  std::vector<double> confidences;
  for (const std::uint32_t confidence : {0u, 1u, 2u, 3u}) {
    confidences.push_back(VoiceResult{0, confidence}.confidence_of_phrase());
  }
  EXPECT_THAT(confidences, ElementsAre(0.9, 0.6, 0.3, 0.0));
}

TEST(StandinMessages, ComeBackAsTheyWere) {
  ShownFrame frame;
  frame.display_time = Timestamp(Duration(12));
  frame.pose_time = Timestamp(Duration(-5));
  frame.status = ShownStatus{{Step::kGuide, "L4", orthonav::Side::kLeft},
                             Notice::kTouchNotRecorded,
                             ChecksAsked::kTouchMore,
                             "guide L4 left",
                             "heard: next"};
  frame.holograms = {{.kind = HologramKind::kEntry,
                      .level = "L4",
                      .side = orthonav::Side::kRight,
                      .text = "L4 right"},
                     {.kind = HologramKind::kAngle, .reading = 0.25},
                     {.kind = HologramKind::kRod, .points_in_world = {{{1, 2, 3}}}}};
  std::vector<std::uint8_t> bytes;
  append(bytes, StandinMessage{StandinShown{frame}});
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(read_standin_message(Bytes(bytes).first(i))->has_value());
  }
  const auto read = read_standin_message(bytes);
  ASSERT_TRUE(read.ok() && *read);
  EXPECT_EQ((*read)->bytes, bytes.size());
  const auto& shown = std::get<StandinShown>((*read)->message).frame;
  EXPECT_EQ(shown.display_time, frame.display_time);
  ASSERT_TRUE(shown.status.has_value());
  EXPECT_EQ(shown.status->at, frame.status->at);
  EXPECT_EQ(shown.status->notice, Notice::kTouchNotRecorded);
  EXPECT_EQ(shown.status->checks, ChecksAsked::kTouchMore);
  EXPECT_EQ(shown.status->text, "guide L4 left");
  EXPECT_EQ(shown.status->heard, "heard: next");
  ASSERT_EQ(shown.holograms.size(), 3u);
  EXPECT_EQ(shown.holograms[0].kind, HologramKind::kEntry);
  EXPECT_EQ(shown.holograms[0].level, "L4");
  EXPECT_EQ(shown.holograms[0].side, orthonav::Side::kRight);
  EXPECT_EQ(shown.holograms[0].text, "L4 right");
  EXPECT_EQ(shown.holograms[0].reading, std::nullopt);
  EXPECT_EQ(shown.holograms[1].reading, 0.25);
  EXPECT_EQ(shown.holograms[1].side, std::nullopt);
  EXPECT_EQ(shown.holograms[2].points_in_world[0].v, (Vec3{1, 2, 3}));
}

TEST(StandinMessages, WithAValueThatNoFrameHasAreRefused) {
  ShownFrame frame;
  frame.status.emplace();
  std::vector<std::uint8_t> bytes;
  append(bytes, StandinMessage{StandinShown{frame}});
  // Behind size, kind, two times and the mark of a status: the step.
  constexpr std::size_t kStepAt = 5 + 16 + 1;
  bytes[kStepAt] = 99;
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("unknown step, 99"));
}

TEST(StandinMessages, OfAnotherServerAreRefused) {
  std::vector<std::uint8_t> bytes;
  append(bytes, std::uint32_t{21});
  bytes.push_back(0);
  bytes.resize(26);
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("no greeting"));
  bytes[4] = 99;
  EXPECT_THAT(read_standin_message(bytes).error().message, HasSubstr("unknown message 99"));
}

}  // namespace
}  // namespace orthonav::hl2ss

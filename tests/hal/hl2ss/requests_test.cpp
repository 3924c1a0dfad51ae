#include "hal/hl2ss/protocol.h"

#include <gmock/gmock.h>

#include "hal/hl2ss/video.h"
#include "hal/hl2ss/voice.h"

namespace orthonav::hl2ss::parser_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace orthonav::hl2ss::parser_test

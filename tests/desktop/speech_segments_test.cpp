#include "hal/desktop/speech_segments.h"

#include <gtest/gtest.h>

#include "tests/support/noisy_speech.h"

namespace orthonav::desktop {
namespace {

using orthonav::testing::Noise;
using orthonav::testing::Soundtrack;

void say(Soundtrack& sound, const std::string& text) {
  const auto samples = orthonav::testing::spoken(text, {"en-us", 150});
  ASSERT_TRUE(samples.ok());
  sound.speech(*samples);
  sound.silence(1.0);
}

std::vector<SpeechSegment> segments_of(std::span<const std::int16_t> sound) {
  SpeechSegmenter segmenter;
  std::vector<SpeechSegment> segments;
  segmenter.push(sound, segments);
  return segments;
}

TEST(SpeechSegmenter, DropsWhatIsTooLongForACommand) {
  Soundtrack sound;
  sound.silence(1.0);
  say(sound, "this is a sentence that goes on for far longer than any command could");
  say(sound, "save");
  Random random(6);
  int ended = 0;
  for (const SpeechSegment& segment : segments_of(sound.with_noise(Noise::kPink, 40.0, random)))
    ended += segment.ended ? 1 : 0;
  EXPECT_EQ(ended, 1);
}

TEST(SpeechSegmenter, TellsOfASegmentATenthOfASecondBeforeItEnds) {
  Soundtrack sound;
  sound.silence(1.0);
  say(sound, "done");
  Random random(7);
  const auto samples = sound.with_noise(Noise::kPink, 40.0, random);
  SpeechSegmenter segmenter;
  std::vector<SpeechSegment> segments;
  std::vector<std::size_t> told_at;
  constexpr std::size_t kStep = 160;
  for (std::size_t at = 0; at + kStep <= samples.size(); at += kStep) {
    segmenter.push(std::span(samples).subspan(at, kStep), segments);
    while (told_at.size() < segments.size()) told_at.push_back(at);
  }
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_FALSE(segments[0].ended);
  EXPECT_FALSE(segments[0].samples.empty());
  EXPECT_TRUE(segments[1].ended);
  EXPECT_EQ(segments[0].begin, segments[1].begin);
  EXPECT_EQ(segments[0].end, segments[1].end);
  EXPECT_EQ(told_at[1] - told_at[0], 10 * kStep);
}

TEST(SpeechSegmenter, HearsAWordSoonAfterAFanWasSwitchedOn) {
  Soundtrack sound;
  sound.silence(2.0);
  say(sound, "done");
  Random random(8);
  auto samples = sound.with_noise(Noise::kWhite, 20.0, random);
  std::fill_n(samples.begin(), kSpeechRateHz / 2, std::int16_t{0});
  std::int64_t last_begin = -1;
  for (const SpeechSegment& segment : segments_of(samples))
    if (segment.ended) last_begin = segment.begin;
  EXPECT_NEAR(static_cast<double>(last_begin), 2.05 * kSpeechRateHz, 0.1 * kSpeechRateHz);
}

}  // namespace
}  // namespace orthonav::desktop

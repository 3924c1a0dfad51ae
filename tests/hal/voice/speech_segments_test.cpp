#include "hal/voice/speech_segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/support/noisy_speech.h"

namespace orthonav::voice {
namespace {

using orthonav::test::Noise;
using orthonav::test::Soundtrack;

void say(Soundtrack& sound, const std::string& text) {
  const auto samples = orthonav::test::spoken(text, {"en-us", 150});
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
  for (const SpeechSegment& segment : segments_of(sound.with_noise(Noise::kPink, 40.0, random))) {
    ended += segment.ended ? 1 : 0;
  }
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
    while (told_at.size() < segments.size()) {
      told_at.push_back(at);
    }
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
  for (const SpeechSegment& segment : segments_of(samples)) {
    if (segment.ended) {
      last_begin = segment.begin;
    }
  }
  EXPECT_NEAR(static_cast<double>(last_begin), 2.05 * kSpeechRateHz, 0.1 * kSpeechRateHz);
}

/// How many of some phrases in a noise lie in one segment each, with most of what was said.
int found_whole(Noise noise, double snr_db, double quiet_s, const std::string& before = "") {
  int found = 0;
  Random random(9);
  for (const char* voice : {"en-us-nyc", "en-us+f4", "gmw/en+f4"}) {
    for (const char* text : {"ortho accept", "ortho done", "ortho move rod", "ortho next"}) {
      const auto samples = orthonav::test::spoken(text, {voice, 150});
      if (!samples) {
        return 0;
      }
      Soundtrack sound;
      if (!before.empty()) {
        sound.silence(0.5);
        sound.speech(*orthonav::test::spoken(before, {voice, 160}));
      }
      sound.silence(quiet_s);
      const auto [begin, end] = sound.speech(*samples);
      sound.silence(0.8);
      for (const SpeechSegment& segment :
           segments_of(sound.with_noise(noise, snr_db, random, orthonav::test::Babble::kTuning))) {
        if (segment.ended && segment.begin < end && segment.end > begin) {
          found += 10 * (segment.end - segment.begin) > 6 * (end - begin) ? 1 : 0;
        }
      }
    }
  }
  return found;
}

TEST(SpeechSegmenter, FindsPhrasesInEveryNoise) {
  EXPECT_EQ(found_whole(Noise::kPink, 60.0, 1.5), 12);
  for (const Noise noise : {Noise::kWhite, Noise::kPink, Noise::kBabble}) {
    EXPECT_EQ(found_whole(noise, 20.0, 1.5), 12) << orthonav::test::name_of(noise);
    EXPECT_GE(found_whole(noise, 10.0, 1.5), 11) << orthonav::test::name_of(noise);
  }
}

TEST(SpeechSegmenter, FindsAPhraseAfterLongTalkAndAPause) {
  const std::string talk =
      "we have to look at the other side before lunch and then somebody should call the ward "
      "about the patient who has been waiting downstairs since early this morning";
  EXPECT_EQ(found_whole(Noise::kPink, 40.0, 0.7, talk), 12);
  EXPECT_EQ(found_whole(Noise::kBabble, 20.0, 0.7, talk), 12);
}

TEST(SpeechSegmenter, FindsNoWordWithinASentence) {
  Soundtrack sound;
  sound.silence(1.0);
  std::vector<std::int64_t> begins;
  for (int again = 0; again < 3; ++again) {
    const auto samples = orthonav::test::spoken(
        "the next patient should START in the other room before we are DONE with this",
        {"en-us", 140});
    ASSERT_TRUE(samples.ok());
    begins.push_back(sound.speech(*samples).first);
    sound.silence(0.3);
  }
  Random random(10);
  for (const double snr_db : {60.0, 20.0}) {
    for (const SpeechSegment& segment :
         segments_of(sound.with_noise(Noise::kPink, snr_db, random))) {
      // Its first words may stand by themselves.
      const auto near = std::any_of(begins.begin(), begins.end(), [&](std::int64_t begin) {
        return std::abs(segment.begin - begin) < kSpeechRateHz / 5;
      });
      EXPECT_TRUE(near) << snr_db << " dB, at " << segment.begin / 16 << " ms";
    }
  }
}

TEST(SpeechSegmenter, FindsNothingWhereNobodySpeaks) {
  Soundtrack sound;
  sound.silence(20.0);
  Random random(11);
  for (const Noise noise : {Noise::kWhite, Noise::kPink}) {
    EXPECT_TRUE(segments_of(sound.with_noise(noise, 10.0, random)).empty());
  }
  EXPECT_TRUE(segments_of(std::vector<std::int16_t>(320000, 0)).empty());
}

}  // namespace
}  // namespace orthonav::voice

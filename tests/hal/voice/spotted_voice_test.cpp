#include "hal/voice/spotted_voice.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>

#include "hal/desktop/wav_microphone.h"
#include "hal/fake/scripted.h"
#include "hal/open/open_parts.h"
#include "tests/hal/voice/quiet_room.h"
#include "tests/hal/voice/wav_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::voice::voice_test {
namespace {

using orthonav::test::TemporaryFolder;

/// The phrases that a voice hears in a sound file while a clock advances in steps.
std::vector<Phrase> phrases_of(const std::string& uri, double length_s, bool on_thread = false) {
  fake::ManualClock clock;
  std::unique_ptr<Voice> voice;
  if (on_thread) {
    SpotterOptions options;
    options.commands = kCommands;
    auto microphone = desktop::open_wav_microphone(uri.substr(4), clock);
    // Of a clock that stands: a busy machine is no stall.
    voice = *open_spotted_voice(*std::move(microphone), options, Listening::kOnItsOwnThread,
                                std::make_unique<fake::ManualClock>());
  } else {
    auto opened = open_voice(uri, kCommands, clock);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    voice = *std::move(opened);
  }
  std::vector<Phrase> phrases;
  for (double t = 0.0; t < length_s; t += 0.033) {
    clock.advance(std::chrono::milliseconds(33));
    EXPECT_TRUE(voice->poll(clock.now(), phrases).ok());
  }
  if (on_thread) {
    EXPECT_TRUE(orthonav::test::wait_until([&] {
      EXPECT_TRUE(voice->poll(clock.now(), phrases).ok());
      return phrases.size() >= 2;
    }));
  }
  return phrases;
}

TEST(SpottedVoice, TellsWhenACommandBeganToBeSpoken) {
  const TemporaryFolder folder;
  const std::string path = folder.with(
      "two.wav", wav_of(quiet_room({"ortho save points", "ortho reject level"}), 16000, 1));
  const auto phrases = phrases_of("wav:" + path + "", 7.0);
  ASSERT_EQ(phrases.size(), 2u);
  EXPECT_EQ(phrases[0].text, "save points");
  EXPECT_GE(phrases[0].confidence, 0.5);
  EXPECT_NEAR(seconds(phrases[0].time.time_since_epoch()), 1.0, 0.15);
  EXPECT_EQ(phrases[1].text, "reject level");
}

TEST(SpottedVoice, HearsTheSameOnItsOwnThread) {
  const TemporaryFolder folder;
  const std::string path = folder.with(
      "two.wav", wav_of(quiet_room({"ortho save points", "ortho reject level"}), 16000, 1));
  const auto expected = phrases_of("wav:" + path + "", 7.0);
  const auto phrases = phrases_of("wav:" + path + "", 7.0, true);
  ASSERT_EQ(phrases.size(), expected.size());
  for (std::size_t i = 0; i < phrases.size(); ++i) {
    EXPECT_EQ(phrases[i].text, expected[i].text);
  }
}

/// Hangs in its driver until it is let go, or dies there.
class HangingMicrophone : public Microphone {
 public:
  struct Ways {
    std::atomic<bool> hangs = true;
    std::atomic<bool> hung = false;
    std::atomic<bool> dies = false;
  };
  explicit HangingMicrophone(Ways& ways) : ways_(ways) {}

 private:
  Ways& ways_;
  [[nodiscard]] int do_sample_rate_hz() const override { return 16000; }
  Result<std::size_t> do_read(std::span<std::int16_t>) override {
    while (ways_.hangs) {
      ways_.hung = true;
      std::this_thread::yield();
    }
    if (ways_.dies) {
      throw std::runtime_error("driver");
    }
    return std::size_t{0};
  }
  [[nodiscard]] std::optional<Timestamp> do_newest_sample_time() const override { return {}; }
};

/// A voice whose microphone hangs, and the time by which that is noticed.
class HangingVoice : public ::testing::Test {
 protected:
  void SetUp() override {
    SpotterOptions options;
    options.commands = kCommands;
    auto wall = std::make_unique<fake::ManualClock>();
    wall_ = wall.get();
    voice_ = *open_spotted_voice(std::make_unique<HangingMicrophone>(ways_), options,
                                 Listening::kOnItsOwnThread, std::move(wall));
    ASSERT_TRUE(orthonav::test::wait_until([&] { return ways_.hung.load(); }));
    EXPECT_TRUE(poll().ok());
  }
  void TearDown() override { ways_.hangs = false; }
  Status poll() {
    std::vector<Phrase> phrases;
    return voice_->poll(Timestamp{}, phrases);
  }
  HangingMicrophone::Ways ways_;
  fake::ManualClock* wall_ = nullptr;
  std::unique_ptr<Voice> voice_;
};

TEST_F(HangingVoice, IsToldAfter400MsUntilItGoesOn) {
  wall_->advance(std::chrono::milliseconds(400));
  EXPECT_TRUE(poll().ok());
  wall_->advance(Duration(1));
  const Status stalled = poll();
  ASSERT_FALSE(stalled.ok());
  EXPECT_EQ(stalled.error().code, ErrorCode::kUnavailable);
  ways_.hangs = false;
  EXPECT_TRUE(orthonav::test::wait_until([&] { return poll().ok(); }));
}

TEST_F(HangingVoice, WhoseThreadDiesSaysOfWhatAndEndsNothingElse) {
  ways_.dies = true;
  ways_.hangs = false;
  ASSERT_TRUE(orthonav::test::wait_until([&] { return !poll().ok(); }));
  const Status died = poll();
  ASSERT_FALSE(died.ok()) << "it stays dead";
  EXPECT_EQ(died.error().message, "voice: ended by an exception: driver");
  EXPECT_NE(died.error().code, ErrorCode::kUnavailable) << "and the run ends";
}

}  // namespace
}  // namespace orthonav::voice::voice_test

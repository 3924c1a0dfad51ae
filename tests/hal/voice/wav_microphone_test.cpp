#include "hal/desktop/wav_microphone.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>

#include "hal/fake/scripted.h"
#include "tests/hal/voice/wav_bytes.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::voice::voice_test {
namespace {

using orthonav::test::TemporaryFolder;

TEST(WavMicrophone, HearsAsTheClockGoesOn) {
  const TemporaryFolder folder;
  fake::ManualClock clock(Timestamp(std::chrono::seconds(7)));
  const std::string path = folder.with("two.wav", wav_of({10, 20, 30, 50, -5, 5}, 8000, 2));
  auto microphone = desktop::open_wav_microphone(path, clock);
  ASSERT_TRUE(microphone.ok()) << microphone.error().message;
  EXPECT_EQ((*microphone)->sample_rate_hz(), 8000);
  std::array<std::int16_t, 8> samples{};
  EXPECT_EQ(*(*microphone)->read(samples), 0u);
  EXPECT_FALSE((*microphone)->newest_sample_time());
  clock.advance(std::chrono::microseconds(255));  // two samples
  EXPECT_EQ(*(*microphone)->read(samples), 2u);
  EXPECT_EQ(samples[0], 15);
  EXPECT_EQ(samples[1], 40);
  EXPECT_EQ(*(*microphone)->newest_sample_time(),
            Timestamp(std::chrono::seconds(7)) + std::chrono::microseconds(250));
  clock.advance(std::chrono::seconds(1));
  EXPECT_EQ(*(*microphone)->read(samples), 8u);
  EXPECT_EQ(samples[0], 0);
  EXPECT_EQ(samples[1], 0);  // silence after the end
}

TEST(WavMicrophone, RefusesWhatIsNoSoundFile) {
  const TemporaryFolder folder;
  const fake::ManualClock clock;
  for (const std::string& bytes : {std::string("no sound"), std::string(), wav_of({}, 8000, 1)}) {
    EXPECT_FALSE(desktop::open_wav_microphone(folder.with("bad.wav", bytes), clock).ok());
  }
  EXPECT_FALSE(desktop::open_wav_microphone(folder.file("absent.wav"), clock).ok());
  // A FIFO would be waited for until somebody writes.
  ASSERT_EQ(::mkfifo(folder.file("fifo").c_str(), 0600), 0);
  for (const std::string& path : {folder.file("fifo"), folder.path().string()}) {
    const auto microphone = desktop::open_wav_microphone(path, clock);
    ASSERT_FALSE(microphone.ok());
    EXPECT_EQ(microphone.error().message, path + ": is not a file");
  }
}

}  // namespace
}  // namespace orthonav::voice::voice_test

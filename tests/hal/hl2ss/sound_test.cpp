#include <gmock/gmock.h>

#include <cstdlib>
#include <thread>

#include "hal/api/microphone.h"
#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::hl2ss {
namespace {

using orthonav::test::next_pair;
using orthonav::test::ServedRoom;

TEST(SoundOfAHeadset, IsTheMeanOfBothChannels) {
  sim::SimOptions sim;
  sim.limit_s = 60.0;
  sim.pace = sim::Pace::kRealtime;
  ServerOptions server;
  server.standin = false;
  ServedRoom room(sim, server);
  const auto headset = room.connect();
  ASSERT_NE(headset, nullptr);
  Microphone& microphone = *headset->microphone();
  EXPECT_EQ(microphone.sample_rate_hz(), 48000);
  EXPECT_FALSE(microphone.newest_sample_time().has_value());
  std::vector<std::int16_t> samples(4096);
  std::size_t heard = 0;
  int loudest = 0;
  StereoFrame frame;
  while (heard < 10'000) {
    ASSERT_EQ(next_pair(*headset, frame), Next::kFrame);
    const auto count = microphone.read(samples);
    ASSERT_TRUE(count.ok()) << count.error().message;
    for (std::size_t i = 0; i < *count; ++i) {
      loudest = std::max(loudest, std::abs(samples[i]));
    }
    heard += *count;
  }
  // 8,000 on the left, half of it on the right.
  EXPECT_NEAR(loudest, 6000, 10);
  ASSERT_TRUE(microphone.newest_sample_time().has_value());
  EXPECT_LT(std::chrono::abs(*microphone.newest_sample_time() - frame.time),
            std::chrono::milliseconds(500));
}

TEST(SoundOfAHeadset, IsDroppedWhereNobodyReads) {
  sim::SimOptions sim;
  sim.limit_s = 60.0;
  ServerOptions server;
  server.paced = true;
  ServedRoom room(sim, server);
  const auto headset = room.connect();
  ASSERT_NE(headset, nullptr);
  Microphone& microphone = *headset->microphone();
  std::vector<std::int16_t> samples(100'000);
  StereoFrame frame;
  bool dropped = false;
  for (int pairs = 0; pairs < 900 && !dropped; ++pairs) {
    ASSERT_EQ(next_pair(*headset, frame), Next::kFrame);
    // Reads only now and then, so that the test sees the loss and nothing else.
    if (pairs % 100 == 99) {
      dropped = !microphone.read(samples).ok();
    }
  }
  EXPECT_TRUE(dropped) << "what is older than a second is gone, and said to be";
  const auto count = microphone.read(samples);
  ASSERT_TRUE(count.ok());
  EXPECT_LE(*count, 48'000u);
}

}  // namespace
}  // namespace orthonav::hl2ss

#include "hal/hl2ss/inbox.h"

#include <gmock/gmock.h>

#include "hal/hl2ss/event_streams.h"

namespace orthonav::hl2ss::inbox_test {
namespace {

using std::chrono::seconds;
using ::testing::ElementsAre;

Phrase said(const char* text, int at_s) { return {text, 0.9, Timestamp(seconds(at_s))}; }

std::vector<Phrase> taken(Inbox<Phrase>& inbox, int until_s) {
  std::vector<Phrase> phrases;
  inbox.take_until(Timestamp(seconds(until_s)), phrases);
  return phrases;
}

TEST(Inbox, DeliversInOrderOfTimeWhatArrivesInAnother) {
  Inbox<Phrase> inbox;
  EXPECT_TRUE(inbox.put(said("next", 5)));
  EXPECT_TRUE(inbox.put(said("accept", 3)));
  EXPECT_THAT(taken(inbox, 10), ElementsAre(said("accept", 3), said("next", 5)));
}

/// Behind a poll up to 10 s, but not behind a phrase: it keeps its time.
TEST(Inbox, DeliversALateEventWithItsOwnTime) {
  Inbox<Phrase> inbox;
  EXPECT_TRUE(inbox.put(said("start", 2)));
  EXPECT_EQ(taken(inbox, 10).size(), 1u);
  EXPECT_TRUE(inbox.put(said("accept", 3)));
  EXPECT_THAT(taken(inbox, 11), ElementsAre(said("accept", 3)));
}

TEST(Inbox, DoesNotMakeAnEventYoungerThanItIs) {
  Inbox<Phrase> inbox;
  EXPECT_TRUE(inbox.put(said("next", 5)));
  EXPECT_EQ(taken(inbox, 10).size(), 1u);
  EXPECT_FALSE(inbox.put(said("accept", 3)));
  EXPECT_TRUE(taken(inbox, 20).empty());
  EXPECT_TRUE(inbox.put(said("accept", 5))) << "at the same time";
}

/// Said before what was answered already: shown as not sure, and not acted upon.
TEST(PhrasesOverTheNetwork, ThatComeTooLateAreNotSure) {
  ArrivalMeter meter("voice", Duration::max() / 2);
  HeadsetTime time;
  constexpr std::uint64_t kSecond = 10'000'000;
  ASSERT_TRUE(time.stamps.time_of(100 * kSecond, HostClock::now()));
  time.clock.paced(Timestamp(seconds(100)), HostClock::now());
  Inbox<Phrase> inbox;
  VoiceStream voice({"next", "accept"}, {}, 0, meter, time, inbox);
  const auto hears = [&](std::uint32_t phrase, std::uint64_t at_s) {
    const auto bytes = voice_answer_bytes({{phrase, 0, 0, at_s * kSecond, 0.9}});
    std::copy(bytes.begin(), bytes.end(), voice.room().begin());
    ASSERT_TRUE(voice.received(bytes.size(), HostClock::now()));
  };
  hears(0, 99);
  EXPECT_THAT(taken(inbox, 100), ElementsAre(said("next", 99)));
  hears(1, 98);
  const Phrase not_sure{"accept", 0.0, Timestamp(seconds(99))};
  EXPECT_THAT(taken(inbox, 100), ElementsAre(not_sure));
}

}  // namespace
}  // namespace orthonav::hl2ss::inbox_test

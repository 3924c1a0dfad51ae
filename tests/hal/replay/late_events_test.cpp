#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/fake/failing.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/scripted_session.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay {
namespace {

using orthonav::test::scripted_session;
using orthonav::test::scripted_time;
using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;

/// How many phrases each poll gave, -1 for one that failed.
std::vector<int> polls(Headset& headset, const std::vector<Timestamp>& times) {
  std::vector<int> counts;
  for (const Timestamp until : times) {
    std::vector<Phrase> phrases;
    const Status status = headset.voice().poll(until, phrases);
    counts.push_back(status ? static_cast<int>(phrases.size()) : -1);
  }
  return counts;
}

struct Session {
  std::vector<int> live;
  std::vector<int> replayed;
};

Session recorded(fake::Faults faults, const std::vector<Timestamp>& times) {
  const TemporaryFolder folder;
  fake::FakeHeadset inner(scripted_session());
  fake::FailingHeadset failing(inner, std::move(faults));
  Session session;
  auto recorder = RecordingHeadset::around(failing, folder / "session");
  EXPECT_TRUE(recorder.ok());
  StereoFrame frame;
  EXPECT_TRUE((*recorder)->cameras()->next(frame).ok());
  session.live = polls(**recorder, times);
  EXPECT_TRUE((*recorder)->close().ok());
  auto replayed = ReplayHeadset::open(folder / "session");
  EXPECT_TRUE(replayed.ok()) << replayed.error().message;
  if (replayed) {
    session.replayed = polls(**replayed, times);
  }
  return session;
}

TEST(LateEvents, ThatAFailedPollAskedForComeAsLateAgain) {
  const auto session =
      recorded({.voice = {{0, fake::EventFault::kError}}}, {scripted_time(1), scripted_time(2)});
  EXPECT_THAT(session.live, ElementsAre(-1, 1));
  EXPECT_THAT(session.replayed, ElementsAre(0, 1)) << "what failed came with the poll after it";
}

TEST(LateEvents, OfAPollForEverythingCanBeReadAgain) {
  const std::vector<Timestamp> times = {scripted_time(1), Timestamp::max(), Timestamp::max()};
  const auto session = recorded({.voice = {{0, fake::EventFault::kDelay}}}, times);
  EXPECT_THAT(session.live, ElementsAre(0, 3, 0));
  EXPECT_EQ(session.replayed, session.live);
}

}  // namespace
}  // namespace orthonav::replay

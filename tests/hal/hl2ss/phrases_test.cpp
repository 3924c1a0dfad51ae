// What a headset's own recognition is told to listen for.
#include <gmock/gmock.h>

#include "engine/session/workflow/commands.h"
#include "hal/fake/scripted.h"
#include "hal/open/open.h"
#include "tests/hal/hl2ss/served_room.h"
#include "tests/support/scripted_session.h"

namespace orthonav::hl2ss::phrases_test {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

Timestamp pair_time(std::size_t n) {
  return Timestamp(std::chrono::seconds(1)) + Duration(33'333'300) * static_cast<int>(n);
}

/// What is heard of `said`, a phrase a pair, by a headset that is opened with these phrases.
std::vector<std::string> heard(const std::vector<std::string>& said,
                               const std::vector<std::string>& phrases) {
  fake::Script script;
  script.calibration = orthonav::test::scripted_calibration();
  for (std::size_t n = 0; n < said.size(); ++n) {
    StereoFrame frame;
    frame.sequence = static_cast<std::int64_t>(n);
    frame.time = pair_time(n);
    frame.left = frame.right = GreyImage(640, 480, 0);
    frame.world_from_rig = Transform<World, Rig>{};
    script.camera.emplace_back(std::move(frame));
    script.voice.push_back({said[n], 0.9, pair_time(n)});
  }
  ServerOptions served = orthonav::test::paced();
  served.first_port = 0;
  const auto server = Server::start(served, [&script] {
    return Result<std::unique_ptr<Headset>>(std::make_unique<fake::FakeHeadset>(script));
  });
  EXPECT_TRUE(server.ok()) << server.error().message;
  OpenOptions options;
  options.phrases = phrases;
  const auto headset =
      open_headset("hl2ss://127.0.0.1?port=" + std::to_string((*server)->first_port()) +
                       "&standin=" + std::to_string((*server)->standin_port()),
                   options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  if (!headset) {
    return {};
  }
  std::vector<Phrase> all;
  StereoFrame frame;
  // Recognition is polled ten times a second, so the last phrases come after the last pair.
  HostTime ended = HostTime::max();
  (void)orthonav::test::wait_until([&] {
    const auto next = (*headset)->cameras()->next(frame);
    EXPECT_TRUE((*headset)->voice().poll((*headset)->clock().now(), all).ok());
    if (next && *next == Next::kEnd && ended == HostTime::max()) {
      ended = HostClock::now();
    }
    return all.size() == said.size() ||
           (ended != HostTime::max() && HostClock::now() - ended > std::chrono::milliseconds(500));
  });
  std::vector<std::string> texts;
  for (const Phrase& phrase : all) {
    texts.push_back(phrase.text);
  }
  return texts;
}

TEST(HeadsetPhrases, OfTheSessionAllReachTheHeadset) {
  std::vector<std::string> phrases;
  for (const engine::Command& command : engine::kCommands) {
    phrases.emplace_back(command.phrase);
  }
  EXPECT_THAT(heard(phrases, engine::headset_phrases()), ElementsAreArray(phrases));
}

TEST(HeadsetPhrases, ThatItIsNotGivenAreNotHeard) {
  EXPECT_THAT(heard({"go to next", "accept"}, {"go to next"}), ElementsAreArray({"go to next"}));
  EXPECT_THAT(heard({"go to next"}, {}), IsEmpty());
}

}  // namespace
}  // namespace orthonav::hl2ss::phrases_test

#include <gmock/gmock.h>

#include "hal/api/as_headset.h"
#include "hal/hl2ss/probe.h"
#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::hl2ss {
namespace {

using orthonav::test::black_session;
using orthonav::test::next_pair;
using orthonav::test::ServedRoom;
using orthonav::test::wait_until;

struct Seen {
  int pairs = 0;
  int errors = 0;
  std::int64_t map_epoch = 0;
  bool ended = false;
  bool ordered = true;
  bool sound = true;  ///< every pose is one that the room had, or absent
};

/// Goes through a session to its end; every pair is compared with the direct run.
Seen go_through(const sim::SimOptions& sim, const ServerOptions& options, VideoProfile profile) {
  ServedRoom room(sim, options);
  const auto headset = room.connect(profile);
  EXPECT_NE(headset, nullptr);
  if (!headset) {
    return {};
  }
  auto direct = *sim::SimHeadset::open(orthonav::test::bare_room(), sim);
  StereoFrame expected;
  StereoFrame frame;
  Seen seen;
  Timestamp last = Timestamp::min();
  for (;;) {
    const Next next = next_pair(*headset, frame, &seen.errors);
    seen.ended = next == Next::kEnd;
    if (next != Next::kFrame) {
      return seen;
    }
    ++seen.pairs;
    seen.ordered = seen.ordered && frame.time > last;
    last = frame.time;
    seen.map_epoch = frame.map_epoch;
    while (expected.time < frame.time && *direct->cameras()->next(expected) == Next::kFrame) {
    }
    seen.sound = seen.sound && expected.time == frame.time;
    if (frame.world_from_rig && options.faults.jump_at.empty()) {
      seen.sound =
          seen.sound &&
          (frame.world_from_rig->translation() - expected.world_from_rig->translation()).norm() <
              1e-6;
    }
  }
}

ServerOptions paced(const Faults& faults) {
  ServerOptions options;
  options.paced = true;
  options.faults = faults;
  options.seed = 3;
  return options;
}

struct FaultCase {
  const char* name;
  Faults faults;
  int fewest_pairs;  ///< of 150
};

class UnderFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(UnderFault, PairsStayInOrderAndTrueAndTheSessionComesToItsEnd) {
  for (const VideoProfile profile : {VideoProfile::kRaw, VideoProfile::kH264Base}) {
    const Seen seen = go_through(black_session(5.0), paced(GetParam().faults), profile);
    EXPECT_TRUE(seen.ended);
    EXPECT_TRUE(seen.ordered);
    EXPECT_TRUE(seen.sound);
    // Pictures that depend on a lost H.264 picture resume with the next key frame, at most a second
    // later.
    const bool raw = profile == VideoProfile::kRaw;
    EXPECT_GE(seen.pairs, raw ? GetParam().fewest_pairs : 20);
    EXPECT_LT(seen.pairs, 150) << "the fault never struck";
    EXPECT_EQ(seen.map_epoch, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, UnderFault,
                         ::testing::Values(FaultCase{"Gaps", {.gap = 0.1}, 110},
                                           FaultCase{"Lost", {.lose = 0.05}, 110},
                                           FaultCase{"Cut", {.cut = 0.03}, 100},
                                           FaultCase{"Misstamped", {.misstamp = 0.1}, 100},
                                           FaultCase{"Corrupt", {.corrupt = 0.05}, 90}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(UnderFault, StallsAndHalfPacketsLoseNothing) {
  for (const Faults& faults : {Faults{.stall = 0.02}, Faults{.half = 0.05}}) {
    const Seen seen = go_through(black_session(2.0), paced(faults), VideoProfile::kRaw);
    EXPECT_TRUE(seen.ended && seen.ordered && seen.sound);
    EXPECT_GE(seen.pairs, 50) << "of 60; those behind a torn one may be dropped for newer";
    EXPECT_EQ(seen.errors, 0);
  }
}

TEST(UnderFault, AnUnlocatedHeadIsNoFault) {
  const Seen seen = go_through(black_session(2.0), paced({.unlocated = 0.3}), VideoProfile::kRaw);
  EXPECT_TRUE(seen.ended && seen.ordered && seen.sound);
  EXPECT_EQ(seen.pairs, 60);
  EXPECT_EQ(seen.map_epoch, 0);
}

/// Ten seconds in which every seventh image or so is stamped wrongly: the map stays, and each is
/// refused alone.
TEST(UnderFault, AWrongStampMovesNoMapAndIsRefusedAlone) {
  const sim::SimOptions sim = black_session(10.0);
  ServedRoom room(sim, paced({.misstamp = 0.15}));
  const auto headset = room.connect();
  ASSERT_NE(headset, nullptr);
  StereoFrame frame;
  int pairs = 0;
  for (; next_pair(*headset, frame) == Next::kFrame; ++pairs) {
    ASSERT_EQ(frame.map_epoch, 0) << pairs;
  }
  const ConnectionStatistics statistics = headset->statistics();
  EXPECT_EQ(statistics.map_moves, 0);
  EXPECT_GE(pairs, 180) << "of 300, each of two images: 0.85² of them";
  EXPECT_LT(pairs, 260) << "the fault never struck";
  EXPECT_GE(statistics.streams[0].damaged, 20);
  EXPECT_THAT(statistics.streams[0].last_trouble,
              ::testing::AllOf(::testing::HasSubstr("packets refused, the last one: stamp "),
                               ::testing::HasSubstr("limit 10.0 ms")));
}

/// As from real encoders and calibrations: several slices, edges without a direction.
TEST(AUnit, WithSlicesAndUnmappedEdgesIsFollowed) {
  ServerOptions options = paced({});
  options.slices = 4;
  options.unmapped_edge_px = 8;
  const Seen seen = go_through(black_session(5.0), options, VideoProfile::kH264Base);
  EXPECT_TRUE(seen.ended && seen.ordered && seen.sound);
  EXPECT_EQ(seen.pairs, 150);
}

TEST(UnderFault, AJumpOfTheWorldIsCountedOnce) {
  Faults faults;
  faults.jump_at = {20, 40};
  const Seen seen = go_through(black_session(2.0), paced(faults), VideoProfile::kRaw);
  EXPECT_TRUE(seen.ended && seen.ordered);
  EXPECT_EQ(seen.map_epoch, 2);
}

/// A server that goes away takes the head with it, and comes back to the same client.
TEST(Reconnecting, GoesOnWithANewServer) {
  sim::SimOptions sim = black_session(60.0);
  sim.pace = sim::Pace::kRealtime;
  sim.render = true;  // a server without our side channel can't say that black pictures repeat
  const auto open = [sim] {
    return as_headset(sim::SimHeadset::open(orthonav::test::bare_room(), sim));
  };
  ServerOptions server;
  server.first_port = 0;
  server.standin = false;
  auto first = Server::start(server, open);
  ASSERT_TRUE(first.ok());
  Hl2ssOptions client;
  client.host = "127.0.0.1";
  client.first_port = (*first)->first_port();
  auto headset = Hl2ssHeadset::open(client);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  StereoFrame frame;
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(next_pair(**headset, frame), Next::kFrame);
  }
  EXPECT_EQ((*headset)->head().world_from_rig(frame.time).status, PoseStatus::kMeasured);
  first->reset();
  EXPECT_TRUE(wait_until([&] { return !(*headset)->cameras()->next(frame).ok(); }))
      << "the loss is told";
  int errors = 1;
  EXPECT_EQ((*headset)->head().world_from_rig(frame.time).status, PoseStatus::kLost);
  server.first_port = client.first_port;
  const auto second = Server::start(server, open);
  ASSERT_TRUE(second.ok()) << second.error().message;
  ASSERT_EQ(next_pair(**headset, frame, &errors), Next::kFrame);
  EXPECT_GE((*headset)->statistics().streams[0].connections, 2);
  EXPECT_GE((*headset)->clock().now(), frame.time);
}

TEST(Opening, SaysWhichPortDoesNotAnswer) {
  Hl2ssOptions options;
  options.host = "127.0.0.1";
  options.first_port = 19000;
  options.open_within = std::chrono::milliseconds(200);
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_FALSE(headset.ok());
  EXPECT_THAT(headset.error().message,
              ::testing::AllOf(::testing::HasSubstr("127.0.0.1: port 19000: "),
                               ::testing::HasSubstr("refused")));
}

TEST(Probing, TellsWhichPortsAnswer) {
  ServedRoom room(black_session(1.0));
  Hl2ssOptions options = room.client_options();
  const auto ports = probe(options);
  ASSERT_TRUE(ports.ok());
  ASSERT_EQ(ports->size(), 7u);
  for (const ProbedPort& port : *ports) {
    EXPECT_EQ(port.trouble, "") << port.name;
  }
  options.first_port = 19000;
  const auto closed = probe(options);
  ASSERT_TRUE(closed.ok());
  for (const ProbedPort& port : *closed) {
    EXPECT_NE(port.trouble, "") << port.name;
  }
}

TEST(Serving, SaysWhichPortIsTaken) {
  ServedRoom room(black_session(1.0));
  ServerOptions options;
  options.first_port = room.server().first_port();
  const auto second = Server::start(options, [] {
    return Result<std::unique_ptr<Headset>>(
        *sim::SimHeadset::open(orthonav::test::bare_room(), black_session(1.0)));
  });
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message,
              ::testing::HasSubstr("port " + std::to_string(options.first_port)));
}

}  // namespace
}  // namespace orthonav::hl2ss

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/hal/hl2ss/scene_link.h"

namespace orthonav::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Age of a pair when its guidance is handed over: exposure, transfer, tracking.
constexpr Duration kAge = milliseconds(50);
/// 33 ms, in steps of the link.
constexpr int kStepsAPair = 33;

ObjectList guidance(Timestamp now) {
  ObjectList list;
  list.tool_time = now - kAge;
  list.objects = {readout(1, "12.4"), ball(2, {0, 0, -0.6})};
  return list;
}

/// Runs so many steps; a new pair comes every 33.
void run_with_pairs(SceneLink& link, int steps) {
  for (int i = 0; i < steps; ++i) {
    if (i % kStepsAPair == 0) {
      link.client.want(guidance(link.now()));
    }
    link.step();
  }
}

TEST(SceneFuse, GuidanceStaysWhilePairsCome) {
  SceneLink link;
  run_with_pairs(link, 500);
  int shown = 0;
  int frames = link.frames;
  int hidden = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i % kStepsAPair == 0) {
      link.client.want(guidance(link.now()));
    }
    link.step();
    if (link.frames != frames) {
      frames = link.frames;
      (link.shows("12.4") ? shown : hidden) += 1;
    }
  }
  EXPECT_GT(shown, 110);
  EXPECT_EQ(hidden, 0) << "no frame without it";
  EXPECT_TRUE(link.status);
  const auto statistics = link.client.statistics();
  ASSERT_FALSE(statistics.shown_age_ms.empty());
  EXPECT_LT(*std::max_element(statistics.shown_age_ms.begin(), statistics.shown_age_ms.end()),
            150.0);
}

TEST(SceneFuse, GuidanceIsHiddenByTheHeadsetWhenTheNetworkStalls) {
  // The link is cut at every millisecond of some cycles.
  for (int cut = 500; cut < 600; ++cut) {
    SceneLink link;
    run_with_pairs(link, cut);
    if (!link.shows("12.4")) {
      continue;
    }
    const Timestamp newest_pair = link.now() - milliseconds((cut - 1) % kStepsAPair + 1) - kAge;
    link.connected = false;
    while (link.shows("12.4")) {
      run_with_pairs(link, 1);
      ASSERT_LE(link.now() - newest_pair, ObjectDisplay::kLongestToolAge) << "cut at " << cut;
    }
    EXPECT_EQ(link.visible(), 1) << "what hangs on no tool stays";
  }
}

TEST(SceneFuse, GuidanceIsHiddenWhenPairsStop) {
  SceneLink link;
  run_with_pairs(link, 520);
  ASSERT_TRUE(link.shows("12.4"));
  const Timestamp stopped = link.now();
  while (link.shows("12.4")) {
    link.step();
    ASSERT_LE(link.now() - stopped, ObjectDisplay::kLongestToolAge);
  }
  link.run(seconds(2));
  EXPECT_FALSE(link.shows("12.4"));
  EXPECT_TRUE(link.status);
}

TEST(SceneFuse, GuidanceTooOldIsNotSent) {
  SceneLink link;
  for (int i = 0; i < 20; ++i) {
    ObjectList old = guidance(link.now());
    old.tool_time = link.now() - milliseconds(120);
    link.client.want(old);
    link.run(milliseconds(33));
    ASSERT_FALSE(link.shows("12.4"));
  }
  EXPECT_EQ(link.visible(), 1);
  EXPECT_EQ(link.client.statistics().withheld, 20);
}

TEST(SceneFuse, OfAListCutAnywhereOnlyAShortTailCanFreeze) {
  SceneLink link;
  run_with_pairs(link, 520);
  // Guidance freezes if a list is cut between the first object shown and the last one hidden. The
  // length is stated here so that it does not grow unnoticed.
  constexpr std::size_t kLongestTail = 100;
  ASSERT_TRUE(link.shows("12.4"));
  const ScenePeer before = link.peer;
  // Up to a whole new list.
  std::vector<std::uint8_t> list;
  for (int i = 0; list.empty(); ++i) {
    ASSERT_LT(i, 200);
    const auto already = link.sent_bytes;
    link.client.want(guidance(link.now()));
    link.step();
    list = link.sent_bytes != already ? link.last_sent : std::vector<std::uint8_t>{};
  }
  std::size_t frozen = 0;
  for (std::size_t cut = 0; cut <= list.size(); ++cut) {
    ScenePeer peer = before;
    peer.hear({list.begin(), list.begin() + static_cast<std::ptrdiff_t>(cut)});
    for (int i = 0; i < 12; ++i) {
      peer.frame();
    }
    for (const auto& [id, thing] : peer.things) {
      frozen += thing.visible && thing.text ? 1 : 0;
    }
  }
  EXPECT_GT(frozen, 0u) << "else this test sees nothing";
  EXPECT_LE(frozen, kLongestTail);
}

TEST(SceneFuse, SilenceWhileGuidanceIsShownGivesTheConnectionUp) {
  SceneLink link;
  run_with_pairs(link, 520);
  link.run(milliseconds(20));  // the last list is acknowledged, its fuse is not
  link.connected = false;
  link.run(milliseconds(230));
  EXPECT_TRUE(link.client.overdue(link.host()));
  link.run(milliseconds(60));
  const Status late = link.client.overdue(link.host());
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, ::testing::HasSubstr("while guidance is shown, limit 250 ms"));
}

TEST(SceneFuse, WhatArrivesTooLateIsCutOffBeforeItDoes) {
  SceneLink link;
  run_with_pairs(link, 520);
  ASSERT_TRUE(link.shows("12.4"));
  link.lose_next(milliseconds(230));  // the time that TCP takes to notice
  const Timestamp lost = link.now();
  while (link.client.overdue(link.host())) {
    run_with_pairs(link, 1);
    ASSERT_LE(link.now() - lost, milliseconds(200));
  }
  EXPECT_THAT(link.client.overdue(link.host()).error().message,
              ::testing::HasSubstr("not acknowledged 200 ms after its pair"));
  EXPECT_FALSE(link.shows("12.4")) << "hidden by the fuse before it";
}

TEST(SceneFuse, IsShorterOnALongWayAndGuidanceIsStillGoneInTime) {
  for (const int one_way_ms : {0, 5, 10, 20}) {
    SceneLink link;
    link.delay(milliseconds(one_way_ms));
    run_with_pairs(link, 1000);
    ASSERT_TRUE(link.status);
    int shown = 0;
    Duration oldest{};
    for (int cut = 0; cut < 60; ++cut) {
      SceneLink stalled = link;
      for (int i = 0; i < 1000 + cut; ++i) {
        const Timestamp at = stalled.now();
        // The pairs of `run_with_pairs` come at its multiples of 33 ms.
        if (i < cut && i % kStepsAPair == 0) {
          stalled.client.want(guidance(at));
        }
        stalled.connected = i < cut;
        stalled.step();
        if (i < cut || !stalled.shows("12.4")) {
          continue;
        }
        ++shown;
        const int newest = cut > 0 ? (cut - 1) / kStepsAPair * kStepsAPair : 0;
        const Duration since = milliseconds(i - newest);
        oldest = std::max(oldest, cut > 0 ? since + kAge : Duration{});
      }
    }
    EXPECT_GT(shown, 0) << one_way_ms;
    EXPECT_LE(oldest, ObjectDisplay::kLongestToolAge) << one_way_ms;
  }
}

TEST(SceneFuse, SilenceWithoutGuidanceIsLeftToTheConnection) {
  SceneLink link;
  ObjectList still;
  still.objects = {ball(2, {0, 0, -0.6})};
  link.client.want(still);
  link.run(milliseconds(300));
  link.connected = false;
  link.run(seconds(5));
  EXPECT_TRUE(link.client.overdue(link.host()));
}

TEST(SceneFuse, AfterALossEverythingIsMadeAnew) {
  SceneLink link;
  run_with_pairs(link, 520);
  link.connected = false;
  run_with_pairs(link, 300);
  link.peer = ScenePeer();
  link.peer.things[1].visible = true;  // frozen by the loss
  link.peer.things[1].words = "99.9";
  link.connected = true;
  link.client.connected(link.host());
  while (link.shows("99.9")) {
    run_with_pairs(link, 1);
  }
  EXPECT_TRUE(link.peer.things.empty()) << "removed before anything is made";
  run_with_pairs(link, 400);
  EXPECT_EQ(link.visible(), 2);
  EXPECT_TRUE(link.status);
}

}  // namespace
}  // namespace orthonav::test

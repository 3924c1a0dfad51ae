#include "hal/hl2ss/scene_client.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/hal/hl2ss/scene_link.h"

namespace orthonav::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

ObjectList list_of(std::vector<DisplayObject> objects) {
  ObjectList list;
  list.objects = std::move(objects);
  return list;
}

TEST(SceneClient, RemovesEverythingFirst) {
  SceneLink link;
  link.peer.things[3].visible = true;  // a client before us was cut off
  link.run(milliseconds(40));
  EXPECT_TRUE(link.peer.things.empty());
  EXPECT_TRUE(link.status);
}

TEST(SceneClient, PlacesObjectsInUnitysAxes) {
  SceneLink link;
  DisplayObject cube = ball(1, {0.1, 0.2, -0.7});
  cube.shape = ObjectShape::kCube;
  const double half = std::sqrt(0.5);
  cube.rotation = {half, 0, 0, half};
  cube.scale = {0.01, 0.02, 0.03};
  cube.colour = {0.25f, 0.5f, 0.75f, 1.0f};
  link.client.want(list_of({cube}));
  link.run(milliseconds(200));
  ASSERT_EQ(link.peer.things.size(), 1u);
  const ScenePeer::Thing& thing = link.peer.things.begin()->second;
  const float root = static_cast<float>(half);
  EXPECT_TRUE(thing.visible);
  EXPECT_EQ(thing.kind, 3u);
  EXPECT_FALSE(thing.follows_head);
  EXPECT_THAT(thing.place, ::testing::ElementsAre(0.1f, 0.2f, 0.7f, -root, 0.0f, 0.0f, root, 0.01f,
                                                  0.02f, 0.03f));
  EXPECT_THAT(thing.rgba, ::testing::ElementsAre(0.25f, 0.5f, 0.75f, 1.0f));
}

TEST(SceneClient, WritesTextAtItsHeightOnTheHead) {
  SceneLink link;
  DisplayObject line = readout(4,
                               "a<b>\xE2\x88\x92"
                               "1.0\xC2\xB0\n");
  line.follows_tool = false;
  line.place = ObjectPlace::kHead;
  link.client.want(list_of({line}));
  link.run(milliseconds(200));
  ASSERT_EQ(link.peer.things.size(), 1u);
  const ScenePeer::Thing& thing = link.peer.things.begin()->second;
  EXPECT_TRUE(thing.text);
  EXPECT_TRUE(thing.follows_head);
  EXPECT_NEAR(thing.font, 0.1, 1e-6) << "6.9 mm, where size 1 has capitals of 69 mm";
  EXPECT_EQ(thing.words,
            "a\xC2\xAB"
            "b>-1.0\xC2\xB0 ")
      << "no tag, no minus outside Latin-1";
}

TEST(SceneClient, WritesInLatin1WhatOurHologramsWrite) {
  EXPECT_EQ(hl2ss::scene_text("\u2007\u20127.4° \u2713 \u2717 ● ◐ ○…"), " -7.4° ok x * ~ o...");
}

TEST(SceneClient, CutsTextBetweenCharacters) {
  std::string text(hl2ss::kMaxSceneTextBytes - 1, 'x');
  EXPECT_EQ(hl2ss::scene_text(text + "\xC2\xB0"), text);
  EXPECT_EQ(hl2ss::scene_text(text + "yz"), text + "y");
}

TEST(SceneClient, SendsDifferencesOnly) {
  SceneLink link;
  auto list = list_of({ball(1, {0, 0, -1}), ball(2, {0.1, 0, -1}), ball(3, {0.2, 0, -1})});
  link.client.want(list);
  link.run(milliseconds(300));
  ASSERT_EQ(link.visible(), 3);
  const int before = link.peer.commands;
  link.client.want(list);
  list.objects[0].position_m.x += 2e-5;  // can't be seen
  link.client.want(list);
  link.run(milliseconds(200));
  EXPECT_EQ(link.peer.commands, before);
  list.objects[1].position_m.x += 0.01;
  list.objects.pop_back();
  link.client.want(list);
  link.run(milliseconds(200));
  EXPECT_EQ(link.peer.commands, before + 4) << "begin, remove, move, end";
  EXPECT_EQ(link.visible(), 2);
}

TEST(SceneClient, SmallMovesAddUp) {
  SceneLink link;
  auto list = list_of({ball(1, {0, 0, -1})});
  for (int i = 0; i < 20; ++i) {
    link.client.want(list);
    link.run(milliseconds(40));
    list.objects[0].position_m.x += 2e-5;
  }
  EXPECT_NEAR(link.peer.things.begin()->second.place[0], 19 * 2e-5, 5.1e-5);
}

TEST(SceneClient, AsksAnewForWhatIsRefused) {
  SceneLink link;
  link.peer.refuse = 2;
  const auto list = list_of({ball(1, {0, 0, -1}), ball(2, {0.1, 0, -1}), ball(3, {0.2, 0, -1})});
  link.client.want(list);
  link.run(milliseconds(400));
  EXPECT_EQ(link.visible(), 3);
  link.peer.things.clear();  // as if its scene was loaded anew
  auto moved = list;
  for (DisplayObject& object : moved.objects) {
    object.position_m.y += 0.1;
  }
  link.client.want(moved);
  link.run(milliseconds(400));
  EXPECT_EQ(link.visible(), 3);
  EXPECT_EQ(link.peer.things.size(), 3u);
  EXPECT_GE(link.client.statistics().refused, 5);
  EXPECT_TRUE(link.status);
}

TEST(SceneClient, AsksASteadyRefuserOnlyNowAndThen) {
  SceneLink link;
  link.peer.refuse = 1'000'000;
  link.client.want(list_of({ball(1, {0, 0, -1})}));
  link.run(std::chrono::seconds(3));
  EXPECT_LT(link.peer.commands, 40);
  EXPECT_EQ(link.visible(), 0);
}

TEST(SceneClient, RefusesAnswersThatCantBe) {
  SceneLink link;
  link.client.want(list_of({ball(1, {0, 0, -1}), ball(2, {0, 0, -1})}));
  const hl2ss::SceneMoment now{link.host(), link.now()};
  EXPECT_THAT(link.client.answered(1, now).error().message, HasSubstr("answer 1 to nothing"));
  ASSERT_FALSE(link.client.next(now).empty());
  EXPECT_THAT(link.client.answered(7, now).error().message, HasSubstr("must be 0 or 1"));
  ASSERT_FALSE(link.client.next(now).empty());
  ASSERT_TRUE(link.client.answered(1, now));  // begin
  ASSERT_TRUE(link.client.answered(55, now));
  EXPECT_THAT(link.client.answered(55, now).error().message, HasSubstr("given to two objects"));
}

TEST(SceneClient, AMovedMapRemovesAllAtOnce) {
  SceneLink link;
  auto list = list_of({ball(1, {0, 0, -1}), ball(2, {0.1, 0, -1})});
  link.client.want(list);
  link.run(milliseconds(300));
  ASSERT_EQ(link.visible(), 2);
  list.map_epoch = 1;
  list.objects[0].position_m.y = 0.3;
  link.client.want(list);
  while (link.visible() == 2) {
    link.step();
  }
  EXPECT_TRUE(link.peer.things.empty()) << "in one frame";
  link.run(milliseconds(300));
  EXPECT_EQ(link.visible(), 2);
}

TEST(SceneClient, KeepsItsBudget) {
  const hl2ss::SceneBudget budget;
  SceneLink link(budget);
  ObjectList list;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    list.objects.push_back(ball(i, {0.001 * static_cast<double>(i), 0, -1}));
  }
  constexpr int kPairs = 90;
  constexpr Duration kPair = milliseconds(33);
  for (int i = 0; i < kPairs; ++i) {
    for (DisplayObject& object : list.objects) {
      object.position_m.y += 0.001;
    }
    link.client.want(list);
    link.run(kPair);
  }
  EXPECT_EQ(link.client.statistics().left_out, 600);
  EXPECT_EQ(link.peer.things.size(), budget.objects);
  EXPECT_GT(link.peer.things.size(), 0u);
  // A list may exceed it by one object.
  EXPECT_LT(static_cast<double>(link.sent_bytes),
            budget.burst_bytes + seconds(kPairs * kPair) * budget.bytes_a_second + 100);
  EXPECT_EQ(link.visible(), static_cast<int>(budget.objects)) << "what moves starves nothing";
  EXPECT_TRUE(link.status);
}

}  // namespace
}  // namespace orthonav::test

#include "engine/live/object_presenter.h"

#include <gmock/gmock.h>

#include "tests/engine/live/guided_scene.h"
#include "tests/hal/hl2ss/scene_link.h"

namespace orthonav::engine {
namespace {

using std::chrono::milliseconds;
using test::SceneLink;

/// A head whose pose is set by the test.
class SaidHead : public HeadTracker {
 public:
  std::optional<Transform<World, Rig>> pose = Transform<World, Rig>{};

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    return {pose.value_or(Transform<World, Rig>{}),
            at,
            pose ? PoseStatus::kMeasured : PoseStatus::kLost,
            {}};
  }
};

/// Passes the objects to a client of the headset's scene.
class LinkedDisplay : public ObjectDisplay {
 public:
  void show(const ObjectList& list) override {
    newest = list;
    link.client.want(list);
  }
  [[nodiscard]] ObjectDisplayStatistics statistics() const override {
    return link.client.statistics();
  }
  SceneLink link;
  ObjectList newest;
};

class PresentedObjects : public ::testing::Test, public GuidedScene {
 protected:
  PresentedObjects() : presenter(display, head, {}) {
    // Looks down from 0.45 m above.
    head.pose = Transform<World, Rig>{rotation_from_vector({-1.5708, 0, 0}), {0, 0.45, 0}};
  }
  /// Pairs come, at 30 Hz, of tools 50 ms ago on the clock of the link.
  void present(int pairs, bool tool = true) {
    for (int i = 0; i < pairs; ++i) {
      Snapshot now = snapshot(s.pair());
      now.display_time = display.link.now();
      now.tool_time = tool && now.tool_time ? std::optional(display.link.now() - milliseconds(50))
                                            : std::nullopt;
      ASSERT_TRUE(presenter.draw(now));
      display.link.run(milliseconds(33));
    }
  }
  [[nodiscard]] bool shows_degrees() const {
    for (const auto& [id, thing] : display.link.peer.things) {
      if (thing.visible && thing.text && !thing.follows_head && thing.words == "5.8\u00B0?") {
        return true;
      }
    }
    return false;
  }

  SaidHead head;
  LinkedDisplay display;
  ObjectPresenter presenter;
};

TEST_F(PresentedObjects, AreAllShownWithinASecond) {
  guide();
  present(30);
  EXPECT_EQ(static_cast<std::size_t>(display.link.visible()), display.newest.objects.size());
  EXPECT_TRUE(shows_degrees());
  EXPECT_TRUE(display.link.status);
}

TEST_F(PresentedObjects, CostLittleWhileNothingMoves) {
  guide();
  present(30);
  const std::size_t before = display.link.sent_bytes;
  present(30);
  // Objects attached to the tool are shown and hidden again with each pair; nothing else is sent.
  std::size_t of_tool = 0;
  for (const DisplayObject& object : display.newest.objects) {
    of_tool += object.follows_tool ? 1 : 0;
  }
  EXPECT_LT(display.link.sent_bytes - before, 30 * (32 * of_tool + 100));
}

TEST_F(PresentedObjects, OfAToolAreGoneBefore150MsWhenTheNetworkStalls) {
  guide();
  present(30);
  ASSERT_TRUE(shows_degrees());
  const Timestamp pair = display.newest.tool_time.value();
  display.link.connected = false;
  while (shows_degrees()) {
    display.link.step();
    ASSERT_LE(display.link.now() - pair, ObjectDisplay::kLongestToolAge);
  }
  EXPECT_GT(display.link.visible(), 20) << "what hangs on no tool stays";
}

TEST_F(PresentedObjects, OfAnotherMapAreMadeAnew) {
  guide();
  present(30);
  const auto before = display.link.peer.things;
  s.map_epoch = 1;
  present(20);
  EXPECT_GT(display.link.visible(), 0);
  for (const auto& [id, thing] : display.link.peer.things) {
    EXPECT_EQ(before.count(id), 0u) << "nothing of the old map is left";
  }
}

TEST_F(PresentedObjects, AreTheStatusLineAloneWhileTheHeadWasNeverLocated) {
  guide();
  head.pose.reset();
  present(2);
  ASSERT_FALSE(display.newest.objects.empty());
  for (const DisplayObject& object : display.newest.objects) {
    EXPECT_EQ(object.place, ObjectPlace::kHead);
  }
}

TEST_F(PresentedObjects, StayWhereTheyAreWhileTheHeadIsLostForAMoment) {
  guide();
  present(10);
  const std::size_t count = display.newest.objects.size();
  head.pose.reset();
  present(2);
  EXPECT_EQ(display.newest.objects.size(), count);
}

}  // namespace
}  // namespace orthonav::engine

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/hal/hl2ss/scene_link.h"
#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::test {
namespace {

using std::chrono::milliseconds;

ObjectList two_balls() {
  ObjectList list;
  list.objects = {ball(1, {0.1, 0.2, -0.7}), ball(2, {0, 0, -1})};
  return list;
}

int visible(const hl2ss::UnityObjects& objects) {
  return static_cast<int>(std::count_if(objects.begin(), objects.end(),
                                        [](const auto& each) { return each.second.active; }));
}

/// A served room whose client has shown two balls.
class SceneConnection : public ::testing::Test {
 protected:
  SceneConnection() : room_(sim::SimOptions{}), headset_(room_.connect()) {}
  void show() {
    headset_->objects()->show(two_balls());
    ASSERT_TRUE(shows_two());
  }
  [[nodiscard]] bool shows_two() {
    return wait_until([&] { return visible(scene().objects()) == 2; });
  }
  [[nodiscard]] hl2ss::ScenePort& scene() { return room_.server().scene(); }
  [[nodiscard]] StreamStatistics stream() const {
    const auto all = headset_->statistics().streams;
    return *std::find_if(all.begin(), all.end(), [](const auto& s) { return s.name == "scene"; });
  }
  /// Shown with guidance on a pair that is always new, until `done`.
  bool guide_until(const std::function<bool()>& done) {
    return wait_until([&] {
      ObjectList list = two_balls();
      list.tool_time = headset_->clock().now() - milliseconds(20);
      list.objects.push_back(readout(3, "12.4"));
      headset_->objects()->show(list);
      return done();
    });
  }

  ServedRoom room_;
  std::unique_ptr<hl2ss::Hl2ssHeadset> headset_;
};

TEST_F(SceneConnection, ShowsAndSaysGoodbye) {
  show();
  const hl2ss::UnityObjects objects = scene().objects();
  const auto at = std::find_if(objects.begin(), objects.end(), [](const auto& each) {
    return (each.second.position_m - Vec3{0.1, 0.2, -0.7}).norm() < 1e-6;
  });
  EXPECT_NE(at, objects.end());
  headset_.reset();
  EXPECT_TRUE(wait_until([&] { return scene().objects().empty(); }));
}

TEST_F(SceneConnection, ComesBackAfterACut) {
  show();
  scene().cut();
  EXPECT_TRUE(wait_until([&] { return headset_->objects()->statistics().connections == 2; }));
  EXPECT_TRUE(shows_two());
  EXPECT_EQ(scene().objects().size(), 2u) << "nothing is left of the first connection";
}

TEST_F(SceneConnection, ComesBackAfterNonsense) {
  show();
  scene().talk_nonsense(true);
  auto moved = two_balls();
  moved.objects[0].position_m.y = 0.5;
  headset_->objects()->show(moved);
  EXPECT_TRUE(wait_until([&] { return stream().damaged > 0; }));
  EXPECT_THAT(stream().last_trouble, ::testing::HasSubstr("scene"));
  scene().talk_nonsense(false);
  EXPECT_TRUE(wait_until([&] {
    const auto objects = scene().objects();
    return objects.size() == 2 && visible(objects) == 2 &&
           std::any_of(objects.begin(), objects.end(),
                       [](const auto& each) { return each.second.position_m.y > 0.4; });
  }));
}

TEST_F(SceneConnection, AsksAnewForWhatIsRefused) {
  scene().refuse(3);
  show();
  EXPECT_GE(headset_->objects()->statistics().refused, 3);
}

TEST_F(SceneConnection, GivesUpAHeadsetThatStopsAnsweringWhileGuidanceIsShown) {
  ASSERT_TRUE(guide_until([&] { return visible(scene().objects()) == 3; }));
  scene().suspend(true);
  EXPECT_TRUE(guide_until([&] { return headset_->objects()->statistics().given_up > 0; }));
  scene().suspend(false);
  EXPECT_TRUE(guide_until([&] { return visible(scene().objects()) == 3; }));
}

TEST_F(SceneConnection, OffMeansOff) {
  hl2ss::Hl2ssOptions options = room_.client_options();
  options.scene = false;
  headset_.reset();
  const auto opened = hl2ss::Hl2ssHeadset::open(options);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ((*opened)->objects(), nullptr);
}

TEST(UnityPort, RefusesASizeOfFourGibibytes) {
  const std::vector<std::uint8_t> bytes = {7, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF};
  const auto read = hl2ss::read_scene_message(bytes);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "scene: a message of 4294967295 bytes, limit 1048576");
}

}  // namespace
}  // namespace orthonav::test

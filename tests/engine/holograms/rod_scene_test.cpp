#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "engine/holograms/hologram_shapes.h"
#include "tests/engine/holograms/shown_holograms.h"
#include "tests/support/rod_on_table.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::scene_builder_test {
namespace {

using test::ScriptedOperation;
using enum HologramKind;

TEST(SceneBuilder, ShowsTheRodAndShiftsItAsARigidBody) {
  ScriptedOperation s;
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kRod, kStatus)) << "no entry point";
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame in_place = shown(g);
  const auto before = find(in_place, kRod)->points_in_world;
  const ShownFrame moved = shown(s.says("move rod"));
  const auto after = find(moved, kRod)->points_in_world;
  ASSERT_EQ(before.size(), 2u);
  ASSERT_EQ(after.size(), 2u);
  EXPECT_NEAR((after[0] - before[0]).norm(), 0.150, kExact);
  EXPECT_NEAR(((after[0] - before[0]) - (after[1] - before[1])).norm(), 0.0, kExact);
}

TEST(SceneBuilder, ARodThatCantBeMadeHasNoLength) {
  ScriptedOperation s;
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.20});  // farther than any two heads
  ASSERT_EQ(g.rods[0].heads.size(), 2u);
  ASSERT_FALSE(g.rods[0].rod.has_value());
  const render::Scene scene = scene_of(g);
  for (const render::TextItem& text : scene.texts) {
    EXPECT_TRUE(kind_of(text.label) != kRod || text.runs[0].text.starts_with("L"))
        << "the heads' levels alone";
  }
}

TEST(SceneBuilder, MakesATubeOnceForARod) {
  ScriptedOperation s;
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  SceneBuilder builder;
  render::Scene scene;
  const auto tube = [&](const Guidance& g) {
    builder.update(g);
    builder.write_scene(g, scene);
    std::size_t most = 0;
    std::shared_ptr<const render::MeshData> found;
    for (const auto& item : scene.meshes) {
      if (kind_of(item.label) == kRod && item.mesh->positions.size() > most &&
          item.colour == look::colours().rod) {
        found = item.mesh, most = item.mesh->positions.size();
      }
    }
    return found;
  };
  const auto first = tube(s.touches({0.02, 0.03, 0.04}));
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(tube(s.pair()), first);
  EXPECT_NE(tube(s.touches({0.02, 0.035, 0.08})), first);
}

TEST(SceneBuilder, DrawsTheRodInHandWhereItWasStrokedAndNoLonger) {
  ScriptedOperation s;
  test::touches_heads_of_a_rod(s);
  const auto rods_told = [](const Guidance& g) {
    const ShownFrame frame = shown(g);
    return std::count_if(frame.holograms.begin(), frame.holograms.end(),
                         [](const ShownHologram& h) { return h.kind == kRod; });
  };
  s.says("next");
  test::RodOnTable rod;
  const Guidance& stroked = rod.is_stroked(s, s.session().rods()[0].instructions->cut_length_m());
  EXPECT_THAT(drawn(stroked), ::testing::ElementsAre(kPath, kRod, kStatus));
  EXPECT_EQ(drawn(stroked), told(stroked));
  EXPECT_EQ(rods_told(stroked), 1) << "the template in the patient";
  Guidance g = s.says("save");
  ASSERT_EQ(rods_told(g), 2);
  const ShownFrame frame = shown(g);
  EXPECT_THAT(frame.holograms.back().text, ::testing::StartsWith("bend 1: "));
  EXPECT_LT((frame.holograms.back().points_in_world[1].v - rod.table_m).norm(), 0.003);
  const auto in_hand = [](const render::Scene& scene) {
    std::vector<std::string> texts;
    for (const render::TextItem& text : scene.texts) {
      if (text.label == label_of(kRod, 3)) {
        texts.push_back(text.runs[0].text);
      }
    }
    return texts;
  };
  EXPECT_THAT(in_hand(scene_of(g)),
              ::testing::ElementsAre("where it was stroked", ::testing::StartsWith("bend 1: ")));
  // A frame that is drawn later than it may be shown, whatever the session still says.
  g.display_time = g.rods[0].lying->shown_until + std::chrono::milliseconds(1);
  EXPECT_EQ(rods_told(g), 1);
  EXPECT_TRUE(in_hand(scene_of(g)).empty());
  EXPECT_EQ(rods_told(s.says("next")), 1);
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test

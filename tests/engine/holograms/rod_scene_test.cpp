#include <gmock/gmock.h>

#include <memory>

#include "engine/holograms/hologram_shapes.h"
#include "tests/engine/holograms/shown_holograms.h"
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
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kRod, kStatus));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame in_place = shown(g);
  ASSERT_NE(find_entry(in_place, "L5", Side::kLeft), nullptr);
  EXPECT_EQ(find_entry(in_place, "L5", Side::kLeft)->text, "")
      << "names would cover the rod's length";
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
    EXPECT_NE(kind_of(text.label), kRod);
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

}  // namespace
}  // namespace orthonav::engine::scene_builder_test

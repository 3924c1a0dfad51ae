#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
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

double distance_to_chain(const Vec3& at_m, const std::vector<Vec3>& chain_m) {
  double nearest_m = 1.0;
  for (std::size_t i = 0; i + 1 < chain_m.size(); ++i) {
    const Vec3 along_m = chain_m[i + 1] - chain_m[i];
    const double part =
        std::clamp((at_m - chain_m[i]).dot(along_m) / along_m.squared_norm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (at_m - chain_m[i] - part * along_m).norm());
  }
  return nearest_m;
}

/// What a scene says of the bends.
std::vector<render::TextItem> bend_texts(const render::Scene& scene) {
  std::vector<render::TextItem> texts;
  for (const render::TextItem& text : scene.texts) {
    if (kind_of(text.label) == kRod && text.runs[0].text.find(" roll ") != std::string::npos) {
      texts.push_back(text);
    }
  }
  return texts;
}

TEST(SceneBuilder, WritesAtTheFirstBendHowToMakeItAndAtEachOnRequest) {
  ScriptedOperation s;
  s.finishes_every_screw();
  for (const Vec3& head : {Vec3{0.02, 0.030, 0.00}, Vec3{0.02, 0.035, 0.04},
                           Vec3{0.02, 0.036, 0.08}, Vec3{0.026, 0.030, 0.12}}) {
    s.touches(head);
  }
  EXPECT_EQ(bend_texts(scene_of(s.pair())).size(), 1u);
  const Guidance& g = s.says("numbers");
  const RodState& rod = g.rods[0];
  ASSERT_TRUE(rod.instructions);
  const auto& told = *rod.instructions;
  ASSERT_GE(told.bends.size(), 2u);
  std::size_t bends = 0;
  for (const render::TextItem& text : bend_texts(scene_of(g))) {
    ASSERT_LT(bends, told.bends.size());
    const nav::RodInstruction& bend = told.bends[bends];
    EXPECT_EQ(text.runs[0].text, printed("%.0f mm, roll %.0f°, set %.1f°", bend.arc.centre_m * 1e3,
                                         degrees(bend.arc.roll_rad), degrees(bend.set_rad)));
    // On the finished rod, which passes the heads at the depth of its seats.
    const Vec3 at_m = {text.position.x, text.position.y, text.position.z};
    EXPECT_LT(distance_to_chain(at_m, told.seats_m), 0.006) << bends;
    ++bends;
  }
  EXPECT_EQ(bends, told.bends.size());
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test

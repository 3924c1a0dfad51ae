#include <gmock/gmock.h>

#include <set>

#include "engine/holograms/scene_builder.h"
#include "tests/engine/holograms/shown_holograms.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::scene_builder_test {
namespace {

using test::guide_at;
using test::pointer_at;
using test::ScriptedOperation;
using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;
using enum HologramKind;

std::set<HologramKind> kinds_in(const Guidance& guidance, const VisibilityRules& rules) {
  SceneBuilder builder(rules);
  builder.update(guidance);
  render::Scene scene;
  builder.write_scene(guidance, scene);
  std::set<HologramKind> kinds;
  for (const auto& item : scene.meshes) {
    kinds.insert(kind_of(item.label));
  }
  for (const auto& item : scene.lines) {
    kinds.insert(kind_of(item.label));
  }
  for (const auto& item : scene.texts) {
    kinds.insert(kind_of(item.label));
  }
  return kinds;
}

TEST(AsPublished, GuidesByTriangleAndAngleAlone) {
  ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
  const Guidance& g = s.pairs(3);
  EXPECT_THAT(kinds_in(g, {}), IsSupersetOf({kCross, kDepth, kNumbers})) << "the control";
  VisibilityRules published;
  published.cross_and_depth = false;
  const auto kinds = kinds_in(g, published);
  EXPECT_THAT(kinds, IsSupersetOf({kEntry, kTrajectory, kAngle}));
  for (const HologramKind kind : {kCross, kDepth, kNumbers}) {
    EXPECT_THAT(kinds, Not(Contains(kind)));
  }
}

TEST(AsPublished, ShowsWhereToStrokeInDigitize) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  VisibilityRules rules;
  rules.stroke_pattern = true;
  EXPECT_THAT(kinds_in(s.pair(), rules), Not(Contains(kPath))) << "not before";
  const Guidance& g = s.says("start");
  EXPECT_THAT(kinds_in(g, rules), Contains(kPath));
  EXPECT_THAT(kinds_in(g, {}), Not(Contains(kPath))) << "only where it is asked for";
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test

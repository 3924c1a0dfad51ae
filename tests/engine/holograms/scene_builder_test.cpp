#include "engine/holograms/scene_builder.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "engine/session/text/wording.h"
#include "render/float3.h"
#include "tests/engine/holograms/shown_holograms.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::scene_builder_test {
namespace {

using test::pointer_at;
using test::ScriptedOperation;
using enum ClickerAction;
using enum HologramKind;

/// Check points with a distance, not those still to be touched.
std::vector<ShownHologram> touched(const ShownFrame& frame) {
  std::vector<ShownHologram> found;
  for (const ShownHologram& hologram : frame.holograms) {
    if (hologram.kind == HologramKind::kCheckPoint && hologram.reading) {
      found.push_back(hologram);
    }
  }
  return found;
}

TEST(SceneBuilder, AlwaysShowsTheStatusLine) {
  ScriptedOperation s;
  const ShownFrame frame = shown(s.pair());
  EXPECT_TRUE(frame.holograms.empty());
  ASSERT_TRUE(frame.status.has_value());
  EXPECT_EQ(frame.status->at, (StepOnDisplay{Step::kSetup, {}, {}}));
  EXPECT_EQ(frame.status->text, "setup | say begin guiding");
}

TEST(SceneBuilder, ShowsPathsWhileDigitizingAndNothingThatGuides) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  const Guidance& g = s.strokes(5);
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kPath, kStatus));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  ASSERT_NE(find(frame, kPath), nullptr);
  EXPECT_EQ(find(frame, kPath)->points_in_world.size(), 5u);
  EXPECT_EQ(frame.status->at, g.status.at);
  EXPECT_EQ(frame.status->text, line_of(g));
}

TEST(SceneBuilder, DrawsCheckPointsWhereTheyWereTouchedGreenOrRed) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_first_level();
  // Strokes there show that the bone is bare.
  EXPECT_EQ(touched(shown(s.pair())).size(), 0u) << "none yet";
  const auto colour = [](const render::Scene& scene, render::Label label) {
    for (const auto& mesh : scene.meshes) {
      if (mesh.label == label) {
        return mesh.colour;
      }
    }
    return render::Colour{};
  };
  const auto first = [](const Guidance& g) {
    return 1201 + static_cast<render::Label>(g.to_check.empty() ? 0 : 1);  // the next place
  };
  const Guidance& before = s.touches({0.0, 0.0204, 0.0});
  EXPECT_EQ(colour(scene_of(before), first(before)), look::colours().good);
  const Guidance& g = s.touches({0.02, 0.0231, 0.0});
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kPath, kVertebra, kStatus, kCheckPoint));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  std::vector<std::string> texts;
  for (const ShownHologram& hologram : touched(frame)) {
    texts.push_back(hologram.text);
    ASSERT_EQ(hologram.points_in_world.size(), 1u);
  }
  EXPECT_THAT(texts, ::testing::ElementsAre("", "3.1 mm"));
  const render::Scene scene = scene_of(g);
  EXPECT_LT(colour(scene, first(g)).g, 0.5f * look::colours().good.g) << "no longer the newest";
  EXPECT_EQ(colour(scene, first(g) + 1), look::colours().poor);
  // They disappear with the surface that they checked.
  EXPECT_THAT(drawn(s.says("reject")), ::testing::Not(::testing::Contains(kCheckPoint)));
}

TEST(SceneBuilder, FadesADeletedRegionAndThenForgetsIt) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  const auto opacity = [](const Guidance& g) {
    const render::Scene scene = scene_of(g);
    for (const auto& line : scene.lines) {
      if (kind_of(line.label) == kPath) {
        return line.colour.a;
      }
    }
    return 0.0f;
  };
  const float before = opacity(s.pair());
  const float fading = opacity(s.says("delete"));
  EXPECT_GT(fading, 0.0f);
  EXPECT_LT(fading, before);
  EXPECT_LT(opacity(s.pairs(3)), fading);
  EXPECT_EQ(opacity(s.pairs(10)), 0.0f);
}

TEST(SceneBuilder, ShowsTheBoneToVerifyButNoEntryPointsYet) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  s.says("save");
  const Guidance& g = s.does({kDoubleClick});
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kPath, kVertebra, kStatus));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  ASSERT_NE(find(frame, kVertebra), nullptr);
  const auto& landmarks = find(frame, kVertebra)->points_in_world;
  ASSERT_EQ(landmarks.size(), 4u);
  // The box reaches 20 mm back, 30 mm to either side, 25 mm up.
  EXPECT_NEAR(landmarks[0].v.y, 0.020, kExact);
  EXPECT_NEAR(landmarks[1].v.x, 0.030, kExact);
  EXPECT_NEAR(landmarks[2].v.x, -0.030, kExact);
  EXPECT_NEAR(landmarks[3].v.z, 0.025, kExact);
}

TEST(SceneBuilder, TintsTheBoneWhereNoStrokeCameNear) {
  ScriptedOperation s;
  const Guidance& g = s.registers_first_level();
  SceneBuilder builder;
  render::Scene scene;
  builder.update(g);
  builder.write_scene(g, scene);
  const auto mesh = scene.meshes.at(0).mesh;
  ASSERT_EQ(mesh->tints.size(), mesh->positions.size());
  EXPECT_EQ(*std::max_element(mesh->tints.begin(), mesh->tints.end()), 1.0f);
  for (std::size_t i = 0; i < mesh->tints.size(); ++i) {
    // Strokes went over the middle of the box's back.
    const render::Float3 p = mesh->positions[i];
    const float away = render::length(p - render::Float3{0, 0.02f, 0});
    if (away < 0.003f) {
      EXPECT_EQ(mesh->tints[i], 0.0f);
    }
  }
  // The renderer keeps its copy by pointer.
  builder.write_scene(s.pair(), scene);
  EXPECT_EQ(scene.meshes.at(0).mesh, mesh);
}

TEST(SceneBuilder, PutsHologramsWhereTheRegistrationSays) {
  ScriptedOperation s;
  const Transform<World, Vertebra> pose(rotation_from_vector({0.3, -0.2, 0.5}), {0.1, 0.2, -0.3});
  s.registration.world_from_vertebra = pose;
  const Guidance& g = s.accepts_first_level();
  const ShownFrame frame = shown(g);
  const ShownHologram* entry = find_entry(frame, "L4", Side::kLeft);
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->text, "left") << "the status line says the level";
  const Point<World> expected = pose * Point<Vertebra>{kLeftEntry};
  EXPECT_NEAR((entry->points_in_world[0] - expected).norm(), 0.0, kExact);
  EXPECT_NE(find_entry(frame, "L4", Side::kRight), nullptr);
}

TEST(GradeLimits, NamesEveryProblem) {
  EXPECT_EQ((GradeLimits{0.2, 0.1, 0.002, 0.001}.check().size()), 2u);
  EXPECT_TRUE(GradeLimits{}.check().empty());
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test

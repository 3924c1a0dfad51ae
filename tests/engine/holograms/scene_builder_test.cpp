#include "engine/holograms/scene_builder.h"
#include "engine/holograms/hologram_label.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "engine/holograms/hologram_cross.h"
#include "engine/session/wording.h"
#include "render/float3.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine {
namespace {

using test::guide_at;
using test::pointer_at;
using test::ScriptedOperation;
using enum ClickerAction;
using ::testing::StartsWith;

using enum HologramKind;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr double kExact = 1e-9;

/// What a frame of this guidance shows, in words.
ShownFrame shown(const Guidance& guidance, SceneBuilder& builder) {
  ShownFrame frame;
  builder.update(guidance);
  builder.write_shown(guidance, frame);
  return frame;
}
ShownFrame shown(const Guidance& guidance) {
  SceneBuilder builder;
  return shown(guidance, builder);
}

std::string line_of(const Guidance& guidance) {
  std::string line;
  append_without_heard(line, guidance.status);
  return line;
}

const ShownHologram* find(const ShownFrame& frame, HologramKind kind) {
  const auto it = std::find_if(frame.holograms.begin(), frame.holograms.end(),
                               [&](const ShownHologram& h) { return h.kind == kind; });
  return it == frame.holograms.end() ? nullptr : &*it;
}

const ShownHologram* find_entry(const ShownFrame& frame, const std::string& level, Side side) {
  const auto it =
      std::find_if(frame.holograms.begin(), frame.holograms.end(), [&](const ShownHologram& h) {
        return h.kind == HologramKind::kEntry && h.level == level && h.side == side;
      });
  return it == frame.holograms.end() ? nullptr : &*it;
}

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

/// The holograms (Hn) that a scene of this guidance draws something of.
std::vector<HologramKind> drawn(const Guidance& guidance) {
  SceneBuilder builder;
  render::Scene scene;
  builder.update(guidance);
  builder.write_scene(guidance, scene);
  std::vector<HologramKind> ids;
  const auto note = [&](render::Label label) { ids.push_back(kind_of(label)); };
  for (const auto& item : scene.meshes) {
    note(item.label);
  }
  for (const auto& item : scene.lines) {
    note(item.label);
  }
  for (const auto& item : scene.triangles) {
    note(item.label);
  }
  for (const auto& item : scene.texts) {
    note(item.label);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// The same for the frame that the display is told.
std::vector<HologramKind> told(const Guidance& guidance) {
  std::vector<HologramKind> ids{kStatus};
  for (const ShownHologram& h : shown(guidance).holograms) {
    ids.push_back(h.kind);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

class Guiding : public ::testing::Test {
 protected:
  Guiding() {
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
    s.pairs(3);
  }
  ScriptedOperation s;
};

TEST(SceneBuilder, AlwaysShowsTheStatusLine) {
  ScriptedOperation s;
  const ShownFrame frame = shown(s.pair());
  EXPECT_TRUE(frame.holograms.empty());
  ASSERT_TRUE(frame.status.has_value());
  EXPECT_EQ(frame.status->at, (StepOnDisplay{Step::kSetup, {}, {}}));
  EXPECT_EQ(frame.status->text, step_text(frame.status->at));
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

/// The first screw's wire stands; World is Vertebra.
class PlacedWireShown : public ::testing::Test {
 protected:
  PlacedWireShown() : s({"L4"}, test::three_places(), Verification::kByTouch, false, true) {
    s.registers_within(0.0003);
    s.accepts_first_by_touch();
    s.touches_dimple();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry, 0.0);
    s.pairs(3);
    s.says("next");
  }
  const Guidance& measures(double beside_m) {
    s.tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, 0.004, 0}, 0.0);
    using enum ClickerAction;
    s.does({kPress});
    s.pair();
    s.does({kRelease, kClick});
    return s.pair();
  }
  ScriptedOperation s;
};

/// Each part of H4 that a frame tells of: the plan, then the wire.
std::vector<ShownHologram> trajectories(const ShownFrame& frame) {
  std::vector<ShownHologram> found;
  for (const ShownHologram& hologram : frame.holograms) {
    if (hologram.kind == kTrajectory) {
      found.push_back(hologram);
    }
  }
  return found;
}

TEST_F(PlacedWireShown, IsALineBesideThePlanWithItsNumbers) {
  EXPECT_THAT(drawn(s.pair()), ::testing::ElementsAre(kEntry, kTrajectory, kStatus))
      << "no triangle and no number of the tool, which stands beside";
  EXPECT_EQ(trajectories(shown(s.pair())).size(), 1u) << "the plan alone";
  const Guidance& g = measures(0.0012);
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kStatus));
  EXPECT_EQ(drawn(g), told(g));
  const auto both = trajectories(shown(g));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_THAT(both[1].text, StartsWith("0.0 ± 0.6°, 1.2 ± "));
  ASSERT_EQ(both[1].points_in_world.size(), 3u);
  constexpr double kJoined = 1e-5;  // the touched check points move the registration by micrometres
  EXPECT_NEAR((both[1].points_in_world[1] - both[0].points_in_world[1]).norm(), 0.0012, kJoined);
}

TEST_F(PlacedWireShown, BeyondALimitIsRed) {
  const auto colour = [](const Guidance& g) {
    SceneBuilder builder;
    render::Scene scene;
    builder.update(g);
    builder.write_scene(g, scene);
    for (const auto& line : scene.lines) {
      if (line.label == 402) {
        return line.colour;
      }
    }
    return render::Colour{};
  };
  EXPECT_EQ(colour(measures(0.0012)), look::kCyan);
  EXPECT_EQ(colour(measures(0.0032)), look::kRed);
}

TEST_F(PlacedWireShown, IsHiddenWithTheReferenceAndGoneWithItsRegistration) {
  measures(0.0012);
  s.tracker().reference_seen = false;
  EXPECT_THAT(drawn(s.pairs(5)), ::testing::ElementsAre(kStatus));
  s.tracker().reference_seen = true;
  EXPECT_EQ(trajectories(shown(s.pair())).size(), 2u) << "seen again";
  EXPECT_TRUE(trajectories(shown(s.says("reject"))).empty());
}

TEST(SceneBuilder, DrawsCheckPointsWhereTheyWereTouchedGreenOrRed) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_first_level();
  // Strokes there show that the bone is bare.
  EXPECT_EQ(touched(shown(s.pair())).size(), 0u) << "none yet";
  s.touches({0.0, 0.0204, 0.0});
  const Guidance& g = s.touches({0.02, 0.0231, 0.0});
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kPath, kVertebra, kStatus, kCheckPoint));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  std::vector<std::string> texts;
  for (const ShownHologram& hologram : touched(frame)) {
    texts.push_back(hologram.text);
    ASSERT_EQ(hologram.points_in_world.size(), 1u);
  }
  EXPECT_THAT(texts, ::testing::ElementsAre("0.4 mm", "3.1 mm"));
  SceneBuilder builder;
  render::Scene scene;
  builder.update(g);
  builder.write_scene(g, scene);
  const auto colour = [&](render::Label label) {
    for (const auto& mesh : scene.meshes) {
      if (mesh.label == label) {
        return mesh.colour;
      }
    }
    return render::Colour{};
  };
  const auto open = static_cast<render::Label>(g.to_check.size());
  EXPECT_EQ(colour(1201 + open), look::kGreen);
  EXPECT_EQ(colour(1202 + open), look::kRed);
  // They disappear with the surface that they checked.
  EXPECT_THAT(drawn(s.says("reject")), ::testing::Not(::testing::Contains(kCheckPoint)));
}

TEST(SceneBuilder, FadesADeletedRegionAndThenForgetsIt) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  const auto opacity = [](const Guidance& g) {
    SceneBuilder builder;
    render::Scene scene;
    builder.update(g);
    builder.write_scene(g, scene);
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
  EXPECT_EQ(entry->text, "L4 left");
  const Point<World> expected = pose * Point<Vertebra>{kLeftEntry};
  EXPECT_NEAR((entry->points_in_world[0] - expected).norm(), 0.0, kExact);
  EXPECT_NE(find_entry(frame, "L4", Side::kRight), nullptr);
}

TEST_F(Guiding, ShowsPlanTriangleAndAngle) {
  const Guidance& g = s.pair();
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kTriangle, kAngle, kCross,
                                               kDepth, kStatus, kNumbers));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  EXPECT_EQ(find(frame, kAngle)->text, "5.7°");  // 0.1 rad
  const auto& line = find(frame, kTrajectory)->points_in_world;
  ASSERT_EQ(line.size(), 3u);
  EXPECT_NEAR((line[0].v - Vec3{0.015, 0.080, 0}).norm(), 0.0, 1e-8) << "60 mm outside";
  EXPECT_NEAR((line[1].v - kLeftEntry).norm(), 0.0, kExact);
  const auto& triangle = find(frame, kTriangle)->points_in_world;
  ASSERT_EQ(triangle.size(), 3u);
  EXPECT_NEAR((triangle[0].v - kLeftEntry).norm(), 0.0, kExact);
  EXPECT_NEAR((triangle[1] - triangle[0]).norm(), nav::kTriangleReach_m, kExact);
  EXPECT_NEAR((triangle[2] - triangle[0]).norm(), nav::kTriangleReach_m, kExact);
}

TEST_F(Guiding, ATipBesideTheEntryOpensTheTriangleAndLeavesTheNumber) {
  constexpr double kBeside_m = 0.003;
  std::array<double, 2> open_m{};
  for (const std::size_t i : {0U, 1U}) {
    const double beside_m = i == 0 ? 0.0 : kBeside_m;
    s.tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, 0.010, 0}, 0.0);
    const Guidance& g = s.pairs(2);
    const ShownFrame frame = shown(g);
    EXPECT_EQ(find(frame, kAngle)->text, "0.0°");
    const auto& triangle = find(frame, kTriangle)->points_in_world;
    ASSERT_EQ(triangle.size(), 3u);
    open_m[i] = (triangle[1] - triangle[2]).norm();
  }
  EXPECT_NEAR(open_m[0], 0.0, 1e-6);
  EXPECT_NEAR(open_m[1], kBeside_m, 0.001 * kBeside_m);
}

TEST_F(Guiding, TheCrossHasADotForTheTipAndOneForTheToolFartherUp) {
  // 2 mm beside the plan towards the patient's left, parallel to it.
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.002, 0.010, 0}, 0.0);
  const Guidance& g = s.pairs(2);
  const ShownFrame frame = shown(g);
  const auto& points = find(frame, kCross)->points_in_world;
  ASSERT_EQ(points.size(), 3u);
  const double drawn_m = static_cast<double>(kCrossScale) * 0.002;
  EXPECT_NEAR((points[1] - points[0]).norm(), drawn_m, 1e-6);
  EXPECT_NEAR((points[2] - points[1]).norm(), 0.0, 1e-6) << "parallel";
  EXPECT_EQ(find(frame, kCross)->text, "");
  // Turned about its tip: the tip's dot stays, the other moves.
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.002, 0.010, 0}, 0.02);
  const ShownFrame rotated = shown(s.pairs(2));
  const auto& after = find(rotated, kCross)->points_in_world;
  EXPECT_NEAR((after[1] - points[1]).norm(), 0.0, 1e-6);
  EXPECT_GT((after[2] - points[2]).norm(), 0.003);
}

TEST_F(Guiding, TheCrossShowsNoDotOfAPredictionAndSaysWhenTheToolIsLost) {
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const ShownFrame predicted = shown(s.pair());
  EXPECT_EQ(find(predicted, kCross)->points_in_world.size(), 1u);
  EXPECT_EQ(find(predicted, kCross)->text, "");
  EXPECT_EQ(find(predicted, kDepth), nullptr);
  const ShownFrame lost = shown(s.pairs(4));
  EXPECT_EQ(find(lost, kCross)->points_in_world.size(), 1u);
  EXPECT_EQ(find(lost, kCross)->text, "tool lost");
}

TEST_F(Guiding, SaysHowFarItIsToTheEntryAndThenToTheTarget) {
  EXPECT_EQ(find(shown(s.pair()), kDepth)->text, "10.0 mm to entry");
  s.tracker().guide = guide_at(kLeftEntry - Vec3{0, 0.004, 0}, 0.0);
  const std::string inside = find(shown(s.pairs(2)), kDepth)->text;
  EXPECT_THAT(inside, ::testing::EndsWith(" mm to target"));
  s.tracker().guide = guide_at(kLeftEntry - Vec3{0, 0.039, 0}, 0.0);
  EXPECT_THAT(find(shown(s.pairs(2)), kDepth)->text, ::testing::EndsWith(" mm past target"));
}

TEST_F(Guiding, TheTwinComesAndGoesOnRequest) {
  EXPECT_EQ(find(shown(s.pair()), kTwin), nullptr);
  const Guidance& g = s.says("twin");
  EXPECT_THAT(drawn(g), ::testing::Contains(kTwin));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  const auto& twin = find(frame, kTwin)->points_in_world;
  const auto& line = find(frame, kTrajectory)->points_in_world;
  ASSERT_EQ(twin.size(), 2u);
  EXPECT_NEAR((twin[1] - twin[0]).norm(), 2.0 * (line[2] - line[1]).norm(), 1e-6);
  EXPECT_EQ(find(shown(s.says("twin")), kTwin), nullptr);
}

TEST_F(Guiding, HidesTheTriangleBeyond40mmAndShowsItWithin) {
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.0399, 0}, 0.0);
  s.pair();
  EXPECT_NE(find(shown(s.pair()), kTriangle), nullptr);
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.0401, 0}, 0.0);
  s.pair();
  const ShownFrame far = shown(s.pair());
  EXPECT_EQ(find(far, kTriangle), nullptr);
  EXPECT_EQ(find(far, kAngle), nullptr);
  EXPECT_NE(find(far, kTrajectory), nullptr);
}

TEST_F(Guiding, ALostToolHidesTheTriangleAndTheNumberSaysSo) {
  // The tracker goes on predicting; the overlay stands for a moment, without a number.
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const Guidance& fresh = s.pair();
  EXPECT_NE(find(shown(fresh), kTriangle), nullptr);
  EXPECT_EQ(find(shown(fresh), kAngle)->text, "--.-°");
  EXPECT_EQ(drawn(fresh), told(fresh));
  const Guidance& g = s.pairs(4);
  const ShownFrame frame = shown(g);
  EXPECT_EQ(find(frame, kTriangle), nullptr);
  ASSERT_NE(find(frame, kAngle), nullptr);
  EXPECT_EQ(find(frame, kAngle)->text, "--.-°");
  EXPECT_TRUE(g.status.tool_lost);
  EXPECT_EQ(frame.status->text, line_of(g));
}

TEST_F(Guiding, AFrameThatLightsUpTooLateShowsNoTriangle) {
  // Fresh when it was computed; the display's latency makes it old.
  s.latency = std::chrono::milliseconds(101);
  EXPECT_EQ(find(shown(s.pair()), kTriangle), nullptr);
  s.latency = std::chrono::milliseconds(99);
  EXPECT_NE(find(shown(s.pair()), kTriangle), nullptr);
}

TEST_F(Guiding, TicksAScrewThatIsDone) {
  s.says("next");
  SceneBuilder builder;
  render::Scene scene;
  const Guidance& g = s.pair();
  builder.update(g);
  builder.write_scene(g, scene);
  std::string left;
  std::string right;
  for (const render::TextItem& text : scene.texts) {
    std::string whole;
    for (const render::TextRun& run : text.runs) {
      whole += run.text;
    }
    if (whole.starts_with("L4 left")) {
      left = whole;
    }
    if (whole.starts_with("L4 right")) {
      right = whole;
    }
  }
  EXPECT_THAT(left, ::testing::HasSubstr("✓"));
  EXPECT_EQ(right, "L4 right");
}

TEST_F(Guiding, ARejectedRegistrationTakesItsHologramsAlong) {
  const Guidance& g = s.says("reject");
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kStatus));
  EXPECT_EQ(drawn(g), told(g));
}

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
  const Guidance& g = s.touches({0.02, 0.03, 0.00});
  ASSERT_EQ(g.rods[0].heads.size(), 2u);
  ASSERT_FALSE(g.rods[0].rod.has_value());
  SceneBuilder builder;
  render::Scene scene;
  builder.update(g);
  builder.write_scene(g, scene);
  for (const render::TextItem& text : scene.texts) {
    EXPECT_NE(kind_of(text.label), kRod);
  }
}

TEST_F(Guiding, GradesByTheLimitsItWasGiven) {
  const Guidance& g = s.pair();  // 5.7 degrees off
  const auto colour = [&](const VisibilityRules& rules) {
    SceneBuilder builder(rules);
    render::Scene scene;
    builder.update(g);
    builder.write_scene(g, scene);
    return scene.triangles.at(0).colour;
  };
  VisibilityRules lenient;
  lenient.grades = {0.2, 0.4};
  EXPECT_EQ(colour({}).r, look::kRed.r);
  EXPECT_EQ(colour(lenient).r, look::kGreen.r);
}

TEST_F(Guiding, WhatIsDrawnTooLateLosesTriangleAndNumber) {
  SceneBuilder builder;
  render::Scene scene;
  const Guidance& g = s.pair();
  builder.update(g);
  builder.write_scene(g, scene);
  ASSERT_FALSE(scene.triangles.empty());
  hide_tool_guidance(scene);
  EXPECT_TRUE(scene.triangles.empty());
  for (const render::LineItem& line : scene.lines) {
    EXPECT_NE(kind_of(line.label), kTriangle);
  }
  render::Scene late;
  builder.update(g, g.tool->pose_time + g.stale_after + Duration(1));
  builder.write_scene(g, late);
  const auto readout = [](const render::Scene& of) {
    for (const render::TextItem& text : of.texts) {
      if (kind_of(text.label) == kAngle) {
        return text.runs.at(0).text;
      }
    }
    return std::string("absent");
  };
  EXPECT_EQ(readout(scene), readout(late));
  const auto cross = [](const render::Scene& of) {
    std::vector<std::pair<render::Label, std::string>> items;
    for (const render::MeshItem& mesh : of.meshes) {
      if (kind_of(mesh.label) == kCross) {
        items.emplace_back(mesh.label, "surface");
      }
    }
    for (const render::LineItem& line : of.lines) {
      if (kind_of(line.label) == kCross) {
        items.emplace_back(line.label, "line");
      }
    }
    for (const render::TextItem& text : of.texts) {
      if (kind_of(text.label) == kCross) {
        items.emplace_back(text.label, text.runs.at(0).text);
      }
    }
    return items;
  };
  EXPECT_EQ(cross(scene), cross(late));
  EXPECT_EQ(cross(late).back().second, "tool lost");
}

TEST(VisibilityRules, NamesEveryProblem) {
  VisibilityRules bad;
  bad.triangle_within_m = 0.0;
  bad.rod_moved_away_m = -1.0;
  bad.grades = {0.2, 0.1};
  EXPECT_EQ(bad.check().size(), 3u);
  EXPECT_TRUE(VisibilityRules{}.check().empty());
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
          item.colour == look::kTitanium) {
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
}  // namespace orthonav::engine

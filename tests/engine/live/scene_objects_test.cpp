#include "engine/live/scene_objects.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "render/float3.h"
#include "render/shapes.h"
#include "tests/engine/live/guided_scene.h"

namespace orthonav::engine {
namespace {

using render::Float3;

HologramKind kind_of_object(const DisplayObject& object) {
  return kind_of(static_cast<render::Label>(object.key >> 32));
}

std::vector<DisplayObject> of_kind(const ObjectList& list, HologramKind kind) {
  std::vector<DisplayObject> found;
  for (const DisplayObject& object : list.objects) {
    if (kind_of_object(object) == kind) {
      found.push_back(object);
    }
  }
  return found;
}

std::vector<DisplayObject> texts_of(const ObjectList& list) {
  std::vector<DisplayObject> found;
  for (const DisplayObject& object : list.objects) {
    if (object.shape == ObjectShape::kText) {
      found.push_back(object);
    }
  }
  return found;
}

Vec3 axis_of(const DisplayObject& object, Vec3 axis) {
  return rotation_from_quaternion(object.rotation) * axis;
}

class GuidedObjects : public ::testing::Test, public GuidedScene {
 protected:
  const ObjectList& write(const Guidance& guidance, Float3 eye = kEyeAbove) {
    const Snapshot& shown = snapshot(guidance);
    list.tool_time = shown.tool_time;
    objects.write(shown.scene, head_at(eye), shown.display_time, list);
    return list;
  }
  SceneObjects objects;
  ObjectList list;
};

TEST_F(GuidedObjects, HaveKeysThatDifferAndStay) {
  guide();
  std::set<std::uint64_t> first;
  for (const DisplayObject& object : write(s.pair()).objects) {
    EXPECT_TRUE(first.insert(object.key).second);
  }
  std::set<std::uint64_t> second;
  for (const DisplayObject& object : write(s.pair()).objects) {
    second.insert(object.key);
  }
  EXPECT_EQ(first, second);
  EXPECT_GT(first.size(), 40u);
  EXPECT_LT(first.size(), 250u);
}

TEST_F(GuidedObjects, HangOnTheToolWhereTheirPlaceOrTextDoes) {
  guide();
  write(s.pair());
  ASSERT_TRUE(list.tool_time);
  std::set<HologramKind> of_tool;
  for (const DisplayObject& object : list.objects) {
    if (object.follows_tool) {
      of_tool.insert(kind_of_object(object));
    } else {
      EXPECT_NE(kind_of_object(object), HologramKind::kTriangle);
      EXPECT_NE(kind_of_object(object), HologramKind::kAngle);
    }
  }
  EXPECT_THAT(of_tool, ::testing::IsSupersetOf({HologramKind::kTriangle, HologramKind::kAngle,
                                                HologramKind::kCross, HologramKind::kDepth}));
  EXPECT_EQ(of_tool.count(HologramKind::kTrajectory), 0u);
  EXPECT_EQ(of_tool.count(HologramKind::kStatus), 0u);
}

TEST_F(GuidedObjects, OfALostToolAreDashesThatStay) {
  guide();
  s.tracker().guide.reset();
  write(s.pairs(10));
  EXPECT_FALSE(list.tool_time);
  bool dashes = false;
  for (const DisplayObject& object : list.objects) {
    EXPECT_FALSE(object.follows_tool);
    EXPECT_NE(kind_of_object(object), HologramKind::kTriangle);
    dashes = dashes || (kind_of_object(object) == HologramKind::kAngle && !object.text.empty());
  }
  EXPECT_TRUE(dashes);
}

TEST_F(GuidedObjects, OfTheTrajectoryAreOnePieceOutsideAndDashesInside) {
  guide();
  write(s.pair());
  const auto pieces = of_kind(list, HologramKind::kTrajectory);
  ASSERT_GT(pieces.size(), 2u);
  double longest_m = 0;
  for (const DisplayObject& piece : pieces) {
    EXPECT_EQ(piece.shape, ObjectShape::kCylinder);
    EXPECT_NEAR(piece.scale.x, 0.002, 1e-6) << "as wide as the line";
    longest_m = std::max(longest_m, 2 * piece.scale.y);
  }
  // Flat ends lie a little inside of the round ones that they stand for.
  EXPECT_NEAR(longest_m, static_cast<double>(kTrajectoryOutside_m) + 0.0016, 1e-4);
  EXPECT_NEAR(2 * pieces[1].scale.y, 0.004 - 0.0004, 1e-4) << "a dash";
}

TEST_F(GuidedObjects, ThatAreTextsFaceTheHeadUpright) {
  guide();
  const render::Head head = head_at(kEyeAbove);
  const Vec3 eye{head.position.x, head.position.y, head.position.z};
  int in_world = 0;
  for (const DisplayObject& text : texts_of(write(s.pair()))) {
    if (text.place == ObjectPlace::kHead) {
      EXPECT_LT(text.position_m.z, -0.3);
      EXPECT_GT(axis_of(text, {0, 0, 1}).z, 0.9) << "seen from +z";
      continue;
    }
    ++in_world;
    // They are a little beside the named object, which itself faces the head.
    EXPECT_GT(axis_of(text, {0, 0, 1}).dot((eye - text.position_m).normalized()), 0.97);
    EXPECT_GT(axis_of(text, {0, 1, 0}).dot({head.up.x, head.up.y, head.up.z}), 0.9);
    EXPECT_GT(text.cap_height_m, 0.002);
  }
  EXPECT_GE(in_world, 3);
}

TEST_F(GuidedObjects, ThatAreTextsStayWhileTheHeadHardlyMoves) {
  guide();
  const Guidance& g = s.pair();
  const auto before = texts_of(write(g));
  const auto after = texts_of(write(g, kEyeAbove + Float3{0.002f, 0, 0}));
  const auto far = texts_of(write(g, kEyeAbove + Float3{0.08f, 0, 0}));
  ASSERT_EQ(before.size(), after.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].position_m, after[i].position_m);
    moved += before[i].position_m == far[i].position_m ? 0 : 1;
  }
  EXPECT_GE(moved, 3u);
}

TEST_F(GuidedObjects, MarkARimWithBarsInItsColour) {
  guide();
  write(s.pair());
  const auto angle = of_kind(list, HologramKind::kAngle);
  ASSERT_EQ(angle.size(), 3u) << "the number and two bars";
  EXPECT_EQ(angle[1].shape, ObjectShape::kCylinder);
  EXPECT_GT(angle[1].colour.r, 0.9f) << "red beyond 5 degrees";
  EXPECT_LT(angle[1].colour.g, 0.4f);
  EXPECT_NEAR((0.5 * (angle[1].position_m + angle[2].position_m) - angle[0].position_m).norm(), 0,
              1e-9);
}

TEST_F(GuidedObjects, ThinAStrokedPathToItsBudget) {
  ObjectList paths;
  render::Scene scene;
  for (std::size_t k = 1; k <= 6; ++k) {
    std::vector<Float3> samples;
    for (int i = 0; i < 400; ++i) {
      const float t = 0.05f * static_cast<float>(i);
      samples.push_back({0.001f * t, 0.01f * std::sin(t), 0.01f * static_cast<float>(k)});
    }
    add_sampled_path(scene, samples, PathState::kSaved, label_of(HologramKind::kPath, k));
  }
  const SceneObjectOptions options;
  objects.write(scene, head_at(kEyeAbove), {}, paths);
  EXPECT_LE(paths.objects.size(), options.path_pieces);
  EXPECT_GT(paths.objects.size(), options.path_pieces / 4);
}

TEST_F(GuidedObjects, OfPathsAreFineAgainOnceThereWereNone) {
  std::vector<Float3> circle;
  render::set_ring(circle, {}, {0, 1, 0}, 0.01f, 200);
  render::Scene one;
  add_sampled_path(one, circle, PathState::kSaved, label_of(HologramKind::kPath, 1));
  render::Scene many;
  for (std::size_t k = 1; k <= 40; ++k) {
    add_sampled_path(many, circle, PathState::kSaved, label_of(HologramKind::kPath, k));
  }
  SceneObjectOptions options;
  options.path_pieces = 20;
  SceneObjects few(options);
  const auto pieces = [&](const render::Scene& scene) {
    few.write(scene, head_at(kEyeAbove), {}, list);
    return list.objects.size();
  };
  const std::size_t fine = pieces(one);
  EXPECT_GT(pieces(many), options.path_pieces) << "as coarse as it gets";
  EXPECT_LT(pieces(one), fine) << "kept while there are paths";
  EXPECT_EQ(pieces({}), 0u);
  EXPECT_EQ(pieces(one), fine);
}

TEST_F(GuidedObjects, MakeAChainOfARodAndBallsOfItsHeads) {
  const std::vector<Float3> path = {{0, 0, 0}, {0.01f, 0.001f, 0}, {0.02f, 0.004f, 0}};
  RodHologram rod;
  rod.tube = std::make_shared<const render::MeshData>(render::make_tube(path, 0.00275f));
  rod.heads = path;
  render::Scene scene;
  add_rod(scene, rod, label_of(HologramKind::kRod, 1));
  ObjectList made;
  objects.write(scene, head_at(kEyeAbove), {}, made);
  ASSERT_EQ(made.objects.size(), 5u);
  EXPECT_EQ(made.objects[0].shape, ObjectShape::kCylinder);
  EXPECT_NEAR(made.objects[0].scale.x, 0.0055, 1e-6);
  EXPECT_EQ(made.objects[4].shape, ObjectShape::kSphere);
}

TEST_F(GuidedObjects, DrawTheBoneAndWhatIsToBeTouchedOnIt) {
  test::ScriptedOperation touched({"L4"}, test::three_places(), Verification::kByTouch);
  const Guidance& g = touched.registers_first_level();
  write(g);
  EXPECT_GT(of_kind(list, HologramKind::kVertebra).size(), 3u);
  const auto places = of_kind(list, HologramKind::kCheckPoint);
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.front().shape, ObjectShape::kCube) << "and no halo";
}

TEST_F(GuidedObjects, DrawABoneOfFewTrianglesByItsContoursToo) {
  auto box = std::make_shared<render::MeshData>();
  for (const float x : {-0.03f, 0.03f}) {
    for (const float y : {-0.02f, 0.02f}) {
      for (const float z : {-0.02f, 0.02f}) {
        box->positions.push_back({x, y, z});
      }
    }
  }
  box->indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                  2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  box->normals = render::smooth_normals(box->positions, box->indices);
  render::Scene scene;
  add_vertebra(scene, box, render::kIdentity, label_of(HologramKind::kVertebra, 1));
  ObjectList made;
  objects.write(scene, head_at(kEyeAbove), {}, made);
  EXPECT_FALSE(made.objects.empty());
  for (const DisplayObject& object : made.objects) {
    EXPECT_EQ(object.shape, ObjectShape::kCylinder);
  }
}

TEST_F(GuidedObjects, OfWhatHangsOnTheHeadDoNotMoveWithIt) {
  guide();
  const Guidance& g = s.pair();
  const auto before = of_kind(write(g), HologramKind::kStatus);
  const auto after = of_kind(write(g, {-0.2f, 0.6f, 0.1f}), HologramKind::kStatus);
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(before.size(), 2u);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].place, ObjectPlace::kHead);
    EXPECT_EQ(before[i].position_m, after[i].position_m);
  }
}

}  // namespace
}  // namespace orthonav::engine

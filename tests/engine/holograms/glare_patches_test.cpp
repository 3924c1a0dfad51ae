#include "engine/holograms/labels/glare_patches.h"

#include <gtest/gtest.h>

#include "render/float3.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine {
namespace {

using test::ScriptedOperation;

constexpr float kExactly_m = 1e-6f;

std::vector<GlarePatch> patches_of(const Guidance& guidance) {
  std::vector<GlarePatch> patches(3);
  write_patches(guidance, patches);
  return patches;
}

TEST(GlarePatches, AreTheTagsThatAreTrackedWithTheirPaper) {
  ScriptedOperation s;
  EXPECT_EQ(patches_of(s.pair()).size(), 0u);
  const Transform<World, Marker> pose(rotation_from_vector({0.3, -0.2, 0.5}), {0.1, 0.2, -0.3});
  s.tracker().guide = pose;
  const std::vector<GlarePatch> patches = patches_of(s.pair());
  ASSERT_EQ(patches.size(), 1u);
  const GlarePatch& patch = patches[0];
  const Vec3 middle = pose.translation();
  render::Float3 mean{};
  for (const render::Float3 corner : patch) {
    mean = mean + 0.25f * corner;
  }
  EXPECT_NEAR(mean.x, static_cast<float>(middle.x), kExactly_m);
  EXPECT_NEAR(mean.y, static_cast<float>(middle.y), kExactly_m);
  EXPECT_NEAR(mean.z, static_cast<float>(middle.z), kExactly_m);
  // A quiet zone of one cell of eight around the tag, at least.
  const auto size_m = static_cast<float>(s.session().tracker().tools()[1].marker.size_m);
  const float side_m = render::length(patch[1] - patch[0]);
  EXPECT_GE(side_m, 1.25f * size_m);
  EXPECT_LE(side_m, 1.35f * size_m);
  EXPECT_NEAR(render::length(patch[2] - patch[1]), side_m, kExactly_m);
  const auto across = pose.rotation() * Vec3{1, 0, 0};
  const render::Float3 edge = render::unit_or(patch[1] - patch[0], {});
  EXPECT_NEAR(edge.x, static_cast<float>(across.x), 1e-5f);
  EXPECT_NEAR(edge.y, static_cast<float>(across.y), 1e-5f);
  EXPECT_NEAR(edge.z, static_cast<float>(across.z), 1e-5f);
}

TEST(GlarePatches, GoWithTheToolThatIsLost) {
  ScriptedOperation s;
  s.tracker().guide = test::guide_at({0, 0.05, 0}, 0.1);
  EXPECT_EQ(patches_of(s.pair()).size(), 1u);
  s.tracker().guide.reset();
  EXPECT_EQ(patches_of(s.pair()).size(), 0u);
}

}  // namespace
}  // namespace orthonav::engine

#include "engine/phantom/phantom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "engine/phantom/phantom_file.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Generated once for all tests.
const Case& spine() {
  static const Case kSpine = phantom();
  return kSpine;
}

std::size_t components(const nav::TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices_m.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[1])] = root(t[2]);
  }
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    count += root(i) == i ? 1 : 0;
  }
  return count;
}

Vec3 extent_m(const nav::TriangleMesh& mesh) {
  Vec3 low = mesh.vertices_m.front();
  Vec3 high = low;
  for (const Vec3& v : mesh.vertices_m) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], v[axis]);
      high[axis] = std::max(high[axis], v[axis]);
    }
  }
  return high - low;
}

TEST(Phantom, IsALumbarSpineThatCanBeOperated) {
  EXPECT_THAT(spine().check(), IsEmpty());
  ASSERT_EQ(spine().levels.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(spine().levels[i].label, "L" + std::to_string(i + 1));
    EXPECT_EQ(spine().levels[i].screws.size(), 2u);
  }
}

TEST(Phantom, IsClosedAndInOnePieceWithOneCanal) {
  for (const CaseLevel& level : spine().levels) {
    SCOPED_TRACE(level.label);
    EXPECT_TRUE(nav::checked_bone(level.mesh).ok());
    EXPECT_EQ(components(level.mesh), 1u);
    // Euler: V - E + F = 2 - 2·genus, E = 3F/2; the canal makes genus 1.
    EXPECT_EQ(level.mesh.vertices_m.size() * 2, level.mesh.triangles.size());
    EXPECT_GE(level.mesh.triangles.size(), 8000u);
    EXPECT_LE(level.mesh.triangles.size(), 20000u);
    EXPECT_GT(volume_m3(level.mesh), 0.0) << "outward";
  }
}

TEST(Phantom, HasWellShapedTriangles) {
  // Registration samples surfaces and evaluations cast rays: slivers would spoil normals.
  constexpr double kSmallestAngle_rad = 10.0 * std::numbers::pi / 180.0;
  constexpr double kMaxBelow = 0.005;
  for (const CaseLevel& level : spine().levels) {
    std::size_t thin = 0;
    for (const auto& t : level.mesh.triangles) {
      double smallest = 10.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 corner = level.mesh.vertices_m[t[k]];
        smallest =
            std::min(smallest, angle_between_rad(level.mesh.vertices_m[t[(k + 1) % 3]] - corner,
                                                 level.mesh.vertices_m[t[(k + 2) % 3]] - corner));
      }
      thin += smallest < kSmallestAngle_rad ? 1 : 0;
    }
    EXPECT_LT(static_cast<double>(thin) / static_cast<double>(level.mesh.triangles.size()),
              kMaxBelow)
        << level.label;
  }
}

TEST(Phantom, HasTheSizeOfLumbarVertebrae) {
  // Span of the transverse processes (Panjabi et al. 1992), to within a rounded tip.
  const std::map<std::string, double> span_mm = {
      {"L1", 71.2}, {"L2", 77.0}, {"L3", 86.0}, {"L4", 82.0}, {"L5", 92.5}};
  for (const CaseLevel& level : spine().levels) {
    SCOPED_TRACE(level.label);
    const Vec3 extent = extent_m(level.mesh);
    EXPECT_NEAR(extent.x, span_mm.at(level.label) * 1e-3, 0.0015);
    EXPECT_GT(extent.y, 0.070);
    EXPECT_LT(extent.y, 0.095);
    EXPECT_GT(extent.z, 0.038);
    EXPECT_LT(extent.z, 0.056);
    EXPECT_GT(volume_m3(level.mesh), 35e-6);
    EXPECT_LT(volume_m3(level.mesh), 85e-6);
  }
}

/// Smallest distance from the surface that the screw's axis keeps after the first `skip_m`.
double clearance_m(const nav::SurfaceIndex& bone, const nav::ScrewPlan& screw, double skip_m) {
  const Vec3 along = (screw.target - screw.entry).normalized();
  const double length = (screw.target - screw.entry).norm();
  double least = 1.0;
  for (double s = skip_m; s <= length; s += 0.0005) {
    const Vec3 p = screw.entry.v + s * along;
    const auto nearest = bone.nearest(p);
    least = std::min(least, bone.contains(p) ? nearest->distance_m : -nearest->distance_m);
  }
  return least;
}

TEST(Phantom, PlansScrewsFromTheSurfaceInsideTheBone) {
  constexpr double kPastTheEntry_m = 0.006;  // the head of the screw sits before
  constexpr double kClearOfTheCortex_m = 0.0005;
  for (const CaseLevel& level : spine().levels) {
    const nav::SurfaceIndex bone(level.mesh);
    for (const nav::ScrewPlan& screw : level.screws) {
      SCOPED_TRACE(level.label + (screw.side == nav::Side::kLeft ? " left" : " right"));
      EXPECT_NEAR((screw.target - screw.entry).norm(), 0.045, 1e-9);
      EXPECT_LT(bone.nearest(screw.entry.v)->distance_m, 1e-6);
      EXPECT_GT(clearance_m(bone, screw, kPastTheEntry_m), screw.radius_m + kClearOfTheCortex_m);
    }
  }
}

TEST(Phantom, WouldNotFitAScrewBesideThePedicle) {
  // The control of the test above: the same screw 5 mm further to the middle leaves the bone.
  const CaseLevel& level = *spine().find("L2");
  const nav::SurfaceIndex bone(level.mesh);
  nav::ScrewPlan screw = level.screws[0];
  screw.entry.v.x -= 0.005;
  screw.target.v.x -= 0.005;
  EXPECT_LT(clearance_m(bone, screw, 0.006), screw.radius_m);
}

TEST(Phantom, PlansScrewsThroughThePedicles) {
  for (const CaseLevel& level : spine().levels) {
    SCOPED_TRACE(level.label);
    EXPECT_EQ(level.screws[0].side, nav::Side::kLeft);
    EXPECT_EQ(level.screws[1].side, nav::Side::kRight);
    for (const nav::ScrewPlan& screw : level.screws) {
      const double sign = screw.side == nav::Side::kLeft ? 1.0 : -1.0;
      EXPECT_GT(sign * screw.entry.v.x, 0.012) << "+x is left";
      EXPECT_LT(sign * screw.target.v.x, sign * screw.entry.v.x) << "towards the middle";
      EXPECT_GT(sign * screw.target.v.x, 0.0) << "without crossing it";
      EXPECT_GT(screw.entry.v.y, 0.020) << "from behind";
      EXPECT_LT(screw.target.v.y, 0.0) << "into the front half of the body";
    }
  }
}

TEST(Phantom, LiesInLordosis) {
  double last_tilt = -10.0;
  double last_z = 1.0;
  for (const CaseLevel& level : spine().levels) {
    SCOPED_TRACE(level.label);
    // Tilt of the body's upper side to the front.
    const Vec3 up = level.spine_from_vertebra.rotation().column(2);
    const double tilt = std::atan2(-up.y, up.z);
    EXPECT_GT(tilt, last_tilt);
    EXPECT_LT(level.spine_from_vertebra.translation().z, last_z - 0.028);
    last_tilt = tilt;
    last_z = level.spine_from_vertebra.translation().z;
    if (level.label == "L3") {
      EXPECT_LT(level.spine_from_vertebra.translation().norm(), 1e-12);
    }
  }
  const Vec3 first = spine().levels.front().spine_from_vertebra.rotation().column(2);
  const Vec3 last = spine().levels.back().spine_from_vertebra.rotation().column(2);
  const double lordosis_deg = angle_between_rad(first, last) * 180.0 / std::numbers::pi;
  EXPECT_GT(lordosis_deg, 25.0);
  EXPECT_LT(lordosis_deg, 50.0);
}

TEST(Phantom, KeepsNeighboursApart) {
  // Facets of neighbours face each other with a gap of cartilage; bone must not lie in bone.
  for (std::size_t i = 0; i + 1 < spine().levels.size(); ++i) {
    const CaseLevel& upper = spine().levels[i];
    const CaseLevel& lower = spine().levels[i + 1];
    const nav::SurfaceIndex bone(upper.mesh);
    const auto upper_from_lower = upper.spine_from_vertebra.inverse() * lower.spine_from_vertebra;
    std::size_t inside = 0;
    for (const Vec3& v : lower.mesh.vertices_m) {
      inside += bone.contains((Transform<Vertebra, Vertebra>(upper_from_lower.rotation(),
                                                             upper_from_lower.translation()) *
                               Point<Vertebra>{v})
                                  .v)
                    ? 1
                    : 0;
    }
    EXPECT_EQ(inside, 0u) << lower.label << " in " << upper.label;
  }
}

TEST(Phantom, IsTheSameOnEveryRun) {
  const Case again = phantom({"L4"});
  ASSERT_EQ(again.levels.size(), 1u);
  const CaseLevel& first = *spine().find("L4");
  EXPECT_EQ(again.levels[0].mesh.vertices_m, first.mesh.vertices_m);
  EXPECT_EQ(again.levels[0].mesh.triangles, first.mesh.triangles);
  EXPECT_EQ(again.levels[0].spine_from_vertebra, first.spine_from_vertebra);
}

TEST(Phantom, NamesItsLevelsWithoutMakingThem) {
  std::vector<std::string> labels;
  for (const CaseLevel& level : spine().levels) {
    labels.push_back(level.label);
  }
  EXPECT_EQ(phantom_labels(), labels);
}

TEST(Phantom, IsNotItsOwnMirrorImage) {
  // The spinous processes lean a little to one side, as they do in people.
  for (const CaseLevel& level : spine().levels) {
    Vec3 tip{0, -1, 0};
    for (const Vec3& v : level.mesh.vertices_m) {
      if (v.y > tip.y) {
        tip = v;
      }
    }
    EXPECT_GT(std::abs(tip.x), 0.0005) << level.label;
  }
}

TEST(PhantomParameters, RefusesMeasuresThatAreMissingOrNotPositive) {
  const auto refusal = [](const std::string& text) {
    const auto read = phantom_parameters(text, "phantom.json");
    return read.ok() ? std::string() : read.error().message;
  };
  EXPECT_THAT(refusal(R"({"name": "x"})"), HasSubstr("levels is missing"));
  EXPECT_THAT(refusal(R"({"name": "x", "levels": [{"label": "L1"}]})"),
              HasSubstr("levels[0].body is missing"));
  EXPECT_THAT(refusal(R"({"name": "x", "levels": [{"label": "L1",
                          "body": {"upper_width": -3}}]})"),
              HasSubstr("levels[0].body.upper_width must be greater than 0"));
}

}  // namespace
}  // namespace orthonav::engine

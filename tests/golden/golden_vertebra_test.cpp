#include "engine/golden/golden_vertebra.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "engine/golden/golden_stage.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/io/mesh_file.h"
#include "nav/geometry/mesh.h"
#include "tests/support/is_ok.h"
#include "tests/support/test_data.h"

namespace orthonav::engine {
namespace {

std::set<std::tuple<double, double, double>> vertices_in(const std::string& path) {
  std::set<std::tuple<double, double, double>> found;
  const auto mesh = load_mesh(path, 1e-3);
  EXPECT_TRUE(test::is_ok(mesh));
  for (const Vec3 v : mesh->vertices_m) {
    found.insert({v.x, v.y, v.z});
  }
  return found;
}

TEST(GoldenVertebra, IsMadeOfVerticesOfTheScannedOne) {
  const auto scanned = vertices_in(test::test_data("anatomy/visible-human/L1.stl").string());
  const auto embedded = vertices_in(ORTHONAV_SOURCE_DIR "/data/golden_vertebra.ply");
  EXPECT_EQ(embedded.size(), 1500u);
  for (const auto& vertex : embedded) {
    EXPECT_EQ(scanned.count(vertex), 1u);
  }
}

TEST(GoldenVertebra, CarriesTheEntriesOnItsSurfaceAndTheScrewsInside) {
  const auto drawn = make_golden_vertebra();
  nav::TriangleMesh mesh;
  for (const render::Float3 p : drawn->positions) {
    mesh.vertices_m.push_back(to_vec3(p));
  }
  for (std::size_t i = 0; i < drawn->indices.size(); i += 3) {
    mesh.triangles.push_back({drawn->indices[i], drawn->indices[i + 1], drawn->indices[i + 2]});
  }
  const nav::SurfaceIndex surface(mesh);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const nav::ScrewPlan plan = golden::plan_of(side);
    EXPECT_LT(surface.nearest(plan.entry.v)->distance_m, 0.0001);
    for (int k = 2; k <= 10; ++k) {  // from where the screw is wholly in the bone
      const Vec3 at = plan.entry.v + 0.1 * k * (plan.target.v - plan.entry.v);
      EXPECT_TRUE(surface.contains(at));
      EXPECT_GT(surface.nearest(at)->distance_m, 0.004);
    }
  }
  for (const render::Float3 place : golden::kPlacesToCheck) {
    EXPECT_LT(surface.nearest(to_vec3(place))->distance_m, 0.0001);
  }
}

}  // namespace
}  // namespace orthonav::engine

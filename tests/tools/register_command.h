#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/random.h"
#include "engine/case/plan_file.h"
#include "engine/io/mesh_file.h"
#include "engine/phantom/phantom.h"
#include "nav/geometry/mesh.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::register_test {

inline constexpr double kNoise_m = 0.0005;

/// What a pointer touches from behind and on both flanks of the spinous process, model frame.
inline std::vector<Vec3> touched(const nav::TriangleMesh& mesh, double front_m) {
  const nav::SurfaceIndex surface(mesh);
  std::vector<Vec3> points;
  const auto touch = [&](Vec3 from, Vec3 direction) {
    const auto hit = surface.first_hit(from, direction);
    if (hit && hit->point_m.y > front_m) {
      points.push_back(hit->point_m);
    }
  };
  for (double z = -0.025; z <= 0.015; z += 0.002) {
    for (double x = -0.03; x <= 0.03; x += 0.0015) {
      touch({x, 0.2, z}, {0, -1, 0});
    }
    for (double y = front_m; y < 0.08; y += 0.002) {
      for (const double side : {0.1, -0.1}) {
        touch({side, y + 0.05, z}, {-side, -0.05, 0});
      }
    }
  }
  return points;
}

/// With the built-in phantom, available in every checkout, and with a real bone.
class RegisterCommand : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (std::string(GetParam()) == "phantom") {
      use_phantom();
    } else {
      model_ = shared("anatomy/visible-human/L4.stl");
      plan_file_ = shared("anatomy/visible-human/L4.plan.json");
    }
    mesh_ = engine::load_mesh(model_, 1e-3).value();
    plan_ = engine::load_plan(plan_file_).value();
    Random random(21);
    for (const Vec3& p : touched(mesh_, plan_.screws[0].entry.v.y - 0.010)) {
      const Vec3 noise{random.normal(0, kNoise_m), random.normal(0, kNoise_m),
                       random.normal(0, kNoise_m)};
      points_m_.push_back((truth_ * Point<Vertebra>{p + noise}).v);
    }
  }
  void use_phantom() {
    const engine::Case spine = engine::phantom({"L4"});
    model_ = folder_.file("model.stl");
    plan_file_ = folder_.file("model.plan.json");
    ASSERT_TRUE(engine::save_stl(model_, spine.levels[0].mesh).ok());
    ASSERT_TRUE(engine::save_plan(plan_file_, "L4", spine.levels[0].screws).ok());
  }
  std::string points_file(double per_metre, const std::string& name = "points.csv") const {
    std::string csv = "x,y,z\n";
    char row[120];
    for (const Vec3& p : points_m_) {
      std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g\n", p.x * per_metre, p.y * per_metre,
                    p.z * per_metre);
      csv += row;
    }
    return folder_.with(name, csv);
  }
  /// The largest error of a JSON's matrix at the plan's points; lengths in its unit.
  double error_m(const nlohmann::json& report, double per_metre, double sign_xy = 1.0) const {
    double worst = 0.0;
    const nlohmann::json& m = report.at("model_to_points");
    for (const engine::StatedScrew& screw : plan_.screws) {
      for (const Point<Vertebra>& p : {screw.entry, screw.target}) {
        const Vec3 file{sign_xy * p.v.x * per_metre, sign_xy * p.v.y * per_metre,
                        p.v.z * per_metre};
        Vec3 mapped;
        for (int r = 0; r < 3; ++r) {
          mapped[r] = m[r][0].get<double>() * file.x + m[r][1].get<double>() * file.y +
                      m[r][2].get<double>() * file.z + m[r][3].get<double>();
        }
        worst = std::max(worst, (mapped / per_metre - (truth_ * p).v).norm());
      }
    }
    return worst;
  }
  ScratchFolder folder_;
  std::string model_;
  std::string plan_file_;
  nav::TriangleMesh mesh_;
  engine::Plan plan_;
  Transform<World, Vertebra> truth_{rotation_from_vector({0.4, -1.1, 0.9}), {0.3, -0.5, 1.2}};
  std::vector<Vec3> points_m_;
};

}  // namespace orthonav::test::register_test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "engine/case/plan_file.h"
#include "engine/io/mesh_file.h"
#include "engine/phantom/phantom.h"
#include "nav/geometry/mesh.h"
#include "tests/support/mesh_builder.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::register_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double kNoise_m = 0.0005;
/// Registration errors with that noise are well below this; wrong poses are off by 10 mm and more.
constexpr double kRight_m = 0.001;

/// What a pointer touches from behind and on both flanks of the spinous process, model frame.
std::vector<Vec3> touched(const nav::TriangleMesh& mesh, double front_m) {
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
  double error_m(const json& report, double per_metre, double sign_xy = 1.0) const {
    double worst = 0.0;
    const json& m = report.at("model_to_points");
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

TEST_P(RegisterCommand, SaysTheSameWithAPreparedModelFromItsCache) {
  const std::string points = points_file(1e3);
  const auto called = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"register", "--model", model_, "--points",
                                    points,     "--json",  "-"};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  };
  const Called without = called({});
  const std::string cache = folder_.file("cache/models");
  for (int time = 0; time < 2; ++time) {
    const Called with = called({"--cache", cache});
    EXPECT_EQ(with.code, 0);
    EXPECT_EQ(with.out, without.out);
    EXPECT_THAT(with.err, IsEmpty());
  }
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(cache), {}), 1);
  const std::string kept = std::filesystem::directory_iterator(cache)->path().string();
  std::filesystem::resize_file(kept, 1000);
  const Called damaged = called({"--cache", cache});
  EXPECT_EQ(damaged.code, 0);
  EXPECT_EQ(damaged.out, without.out);
  EXPECT_THAT(damaged.err, HasSubstr(kept + ": is damaged"));
  EXPECT_THAT(called({"--cache", cache}).err, IsEmpty()) << "made anew";
}

TEST_P(RegisterCommand, FindsThePoseAndWritesEveryFigure) {
  const std::string out = folder_.file("out.json");
  const Called called = orthonav({"register", "--model", model_, "--points", points_file(1e3),
                                  "--plan", plan_file_, "--json", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, StartsWith("accepted: "));
  EXPECT_THAT(called.err, IsEmpty());
  const json report = json::parse(content_of(out));
  EXPECT_EQ(report["accepted"], true);
  EXPECT_TRUE(report["reasons"].empty());
  EXPECT_EQ(report["points_unit"], "mm");
  EXPECT_EQ(report["points"], points_m_.size());
  EXPECT_LT(error_m(report, 1e3), kRight_m);
  EXPECT_THAT(report["model_to_points"][3], ElementsAre(0.0, 0.0, 0.0, 1.0));
  EXPECT_NEAR(report["rmse_mm"].get<double>(), kNoise_m * 1e3, 0.1);
  if (report.contains("runner_up_rmse_mm")) {
    EXPECT_GT(report["runner_up_rmse_mm"].get<double>(), 1.25 * report["rmse_mm"].get<double>());
  }
  ASSERT_EQ(report["screws"].size(), 2U);
  double worst_mm = 0.0;
  for (const json& screw : report["screws"]) {
    worst_mm = std::max({worst_mm, screw["predicted_entry_tre_mm"].get<double>(),
                         screw["predicted_target_tre_mm"].get<double>()});
  }
  EXPECT_EQ(report["predicted_tre_mm"].get<double>(), worst_mm);
  EXPECT_GT(worst_mm, 0.02);
  EXPECT_LT(worst_mm, 2.0);
}

/// The screws of the plan as lines of 3D Slicer, in the plan's order and so named.
std::string slicer_lines(const engine::Plan& plan, const std::vector<std::string>& names) {
  json markups = json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const engine::StatedScrew& screw = plan.screws[i];
    json points = json::array();
    for (const Point<Vertebra>& p : {screw.entry, screw.target}) {
      points.push_back({{"position", {p.v.x * 1e3, p.v.y * 1e3, p.v.z * 1e3}}});
    }
    markups.push_back({{"type", "Line"},
                       {"name", names[i]},
                       {"coordinateSystem", "LPS"},
                       {"coordinateUnits", "mm"},
                       {"controlPoints", points}});
  }
  return json{{"markups", markups}}.dump();
}

TEST_P(RegisterCommand, TakesTheSideFromTheBoneNotFromSlicersNameForALine) {
  ASSERT_EQ(plan_.screws[0].side, nav::Side::kLeft);
  ASSERT_EQ(plan_.screws[1].side, nav::Side::kRight);
  std::swap(plan_.screws[0], plan_.screws[1]);
  const std::string points = points_file(1e3);
  const auto called = [&](const std::vector<std::string>& names) {
    return orthonav({"register", "--model", model_, "--points", points, "--plan",
                     folder_.with("L4.mrk.json", slicer_lines(plan_, names))});
  };
  const Called right = called({"L"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_THAT(right.out, HasSubstr("error to expect at the right screw: "));
  EXPECT_THAT(right.out, Not(HasSubstr("left screw")));
  const Called both = called({"L", "L_1"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_LT(both.out.find("the right screw"), both.out.find("the left screw"));
  const Called swapped = called({"L4 left", "L4 right"});
  EXPECT_EQ(swapped.code, 2);
  EXPECT_THAT(swapped.err, AllOf(HasSubstr("L4.mrk.json: line \"L4 left\" says left, but its entry "
                                           "lies "),
                                 HasSubstr(" mm to the right of the bone's midline")));
  EXPECT_EQ(std::count(swapped.err.begin(), swapped.err.end(), '\n'), 1) << swapped.err;
}

TEST_P(RegisterCommand, GivesTheMatrixInThePointsUnit) {
  // The model is in millimetres nevertheless.
  const Called called = orthonav(
      {"register", "--model", model_, "--points", points_file(1.0), "--units", "m", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);  // nothing else on standard output
  EXPECT_EQ(report["points_unit"], "m");
  EXPECT_LT(error_m(report, 1.0), kRight_m);
}

TEST_P(RegisterCommand, TakesAModelInRas) {
  const nav::TriangleMesh rotated =
      test::rotated(mesh_, Mat3::from_columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}));
  std::string obj;
  char row[120];
  for (const Vec3& v : rotated.vertices_m) {
    std::snprintf(row, sizeof row, "v %.9g %.9g %.9g\n", v.x * 1e3, v.y * 1e3, v.z * 1e3);
    obj += row;
  }
  for (const auto& t : rotated.triangles) {
    obj += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
           std::to_string(t[2] + 1) + "\n";
  }
  const std::string model = folder_.with("ras.obj", obj);
  const Called called = orthonav({"register", "--model", model, "--points", points_file(1e3),
                                  "--frame", "RAS", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(report["model_frame"], "RAS");
  EXPECT_LT(error_m(report, 1e3, -1.0), kRight_m);
}

TEST_P(RegisterCommand, SaysNoToACloudThatIsNotTheBone) {
  Random random(3);
  for (Vec3& p : points_m_) {
    p = {random.normal(0, 0.02), random.normal(0, 0.02), random.normal(0, 0.02)};
  }
  const Called called =
      orthonav({"register", "--model", model_, "--points", points_file(1e3), "--json", "-"});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(called.err, StartsWith("orthonav: refused: the points scatter "));
  const json report = json::parse(called.out);
  EXPECT_EQ(report["accepted"], false);
  EXPECT_THAT(report["reasons"][0].get<std::string>(), HasSubstr("limit 1.6 mm"));
  const Called paper =
      orthonav({"register", "--model", model_, "--points", points_file(1e3), "--method", "paper"});
  EXPECT_EQ(paper.code, 1);
  EXPECT_THAT(paper.err, StartsWith("orthonav: refused: registration RMSE "));
}

TEST_P(RegisterCommand, RefusesBadInputInOneLineAndWritesNothing) {
  const std::string good = points_file(1e3);
  std::string few = "x,y,z\n";
  for (int i = 0; i < 99; ++i) {
    few += std::to_string(i) + ",0,0\n";
  }
  const std::string metres = points_file(1.0, "metres.csv");
  struct Case {
    std::string model, points, expected;
  };
  const std::vector<Case> cases = {
      {folder_.file("none.stl"), good, "none.stl"},
      {folder_.with("empty.stl", ""), good, "empty.stl"},
      {model_, folder_.file("none.csv"), "none.csv"},
      {model_, folder_.with("few.csv", few), "99 points, needs at least 100"},
      {model_, folder_.with("nan.csv", "x,y,z\n1,nan,2\n"), "nan.csv"},
      {model_, metres, "in one place"},
  };
  const std::string out = folder_.file("out.json");
  const std::vector<std::string> before = folder_.names();
  for (const Case& c : cases) {
    const Called called =
        orthonav({"register", "--model", c.model, "--points", c.points, "--json", out});
    EXPECT_EQ(called.code, 2) << c.expected;
    EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(c.expected)));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_THAT(folder_.names(), ElementsAreArray(before)) << "no output, whole or in part";
  }
}

TEST_P(RegisterCommand, NamesMetresTakenForMillimetres) {
  nav::TriangleMesh small = mesh_;
  for (Vec3& v : small.vertices_m) {
    v = v * 1e-3;  // written as mm: 0.09 mm across
  }
  const std::string model = folder_.file("small.stl");
  ASSERT_TRUE(engine::save_stl(model, small).ok());
  const Called called = orthonav({"register", "--model", model, "--points", points_file(1e3)});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("metres taken for millimetres"));
}

TEST_P(RegisterCommand, TellsOfThePublishedMethodWhatItKnows) {
  const Called called = orthonav({"register", "--model", model_, "--points", points_file(1e3),
                                  "--plan", plan_file_, "--method", "paper", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(report["method"], "paper");
  EXPECT_LT(error_m(report, 1e3), kRight_m);
  EXPECT_GT(report["runner_up_rmse_mm"].get<double>(), 1.25 * report["rmse_mm"].get<double>());
  EXPECT_THAT(report["ambiguity"].get<std::string>(), StartsWith("unambiguous: "));
  for (const char* key : {"noise_mm", "inlier_share", "coverage_share", "runner_up_margin"}) {
    EXPECT_FALSE(report.contains(key)) << key << " is not known to it";
  }
}

TEST_P(RegisterCommand, RefusesAnUnwritablePlaceAndUnknownWords) {
  const std::string points = points_file(1e3);
  const Called unwritable = orthonav({"register", "--model", model_, "--points", points, "--json",
                                      folder_.file("no/such/folder.json")});
  EXPECT_EQ(unwritable.code, 2);
  const Called nearest =
      orthonav({"register", "--model", model_, "--points", points, "--method", "nearest"});
  EXPECT_EQ(nearest.code, 2);
  EXPECT_THAT(nearest.err, HasSubstr("nearest: unknown (available: best, paper)"));
  EXPECT_EQ(orthonav({"register", "--model", model_}).code, 2);
  EXPECT_EQ(orthonav({"register", "--model", model_, "--points", points, "--units", "inch"}).code,
            2);
}

INSTANTIATE_TEST_SUITE_P(Bones, RegisterCommand, ::testing::Values("phantom", "real"),
                         [](const auto& bone) { return std::string(bone.param); });

}  // namespace
}  // namespace orthonav::test::register_test

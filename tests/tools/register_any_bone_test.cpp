// `register --any-bone`: a bone three times the size of a vertebra, and a real pelvis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "nav/geometry/absolute_orientation.h"
#include "tests/support/stroke_truths.h"
#include "tests/support/stroked_pelvis.h"
#include "tests/tools/register_command.h"

namespace orthonav::test::register_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

Transform<World, Vertebra> pose_of(const json& report) {
  const json& m = report.at("model_to_points");
  const auto column = [&](int c) {
    return Vec3{m[0][c].get<double>(), m[1][c].get<double>(), m[2][c].get<double>()};
  };
  return {Mat3::from_columns(column(0), column(1), column(2)), 1e-3 * column(3)};
}

/// The phantom's L4, three times as large, and what a pointer touches of it.
class RegisterAnyBone : public ::testing::Test {
 protected:
  static constexpr double kLarge = 3.0;

  RegisterAnyBone() {
    const nav::TriangleMesh vertebra = engine::phantom({"L4"}).levels[0].mesh;
    Random random(21);
    for (const Vec3& p : touched(vertebra, 0.0)) {
      const Vec3 noise{random.normal(0, kNoise_m), random.normal(0, kNoise_m),
                       random.normal(0, kNoise_m)};
      points_.push_back(truth_ * Point<Vertebra>{kLarge * p + noise});
    }
    const nav::TriangleMesh large = scaled(vertebra, kLarge);
    EXPECT_TRUE(engine::save_stl(model_, large).ok());
    for (const Vec3& p : large.vertices_m) {
      farthest_m_ = std::max(farthest_m_, p.norm());
    }
  }

  [[nodiscard]] Called called(const std::vector<Point<World>>& points,
                              std::vector<std::string> more) const {
    std::string csv = "x,y,z\n";
    for (const Point<World>& p : points) {
      for (int axis = 0; axis < 3; ++axis) {
        csv += std::to_string(p.v[axis] * 1e3) + (axis < 2 ? "," : "\n");
      }
    }
    std::vector<std::string> all = {"register", "--model", model_, "--points",
                                    folder_.with("points.csv", csv)};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }

  ScratchFolder folder_;
  std::string model_ = folder_.file("large.stl");
  Transform<World, Vertebra> truth_{rotation_from_vector({0.4, -1.1, 0.9}), {0.3, -0.5, 1.2}};
  std::vector<Point<World>> points_;
  double farthest_m_ = 0.0;
};

TEST_F(RegisterAnyBone, TakesABoneThatIsTooLargeForAVertebra) {
  const Called vertebra = called(points_, {});
  EXPECT_EQ(vertebra.code, 2);
  EXPECT_THAT(vertebra.err, AllOf(HasSubstr("limit 30-250 mm for a vertebra"),
                                  HasSubstr("register takes another bone with --any-bone")));
  const Called any = called(points_, {"--any-bone", "--json", folder_.file("found.json")});
  ASSERT_EQ(any.code, 0) << any.err;
  const json report = json::parse(content_of(folder_.file("found.json")));
  EXPECT_LT((pose_of(report) * Point<Vertebra>{} - truth_ * Point<Vertebra>{}).norm(), 0.0005);
  EXPECT_LT(rotation_angle_rad(pose_of(report).rotation(), truth_.rotation()) * farthest_m_,
            0.0005);
  EXPECT_FALSE(report.contains("advice")) << "which names the parts of a vertebra";
  EXPECT_THAT(any.out, AllOf(HasSubstr("95 % of errors at the ends of the bone are expected"),
                             HasSubstr("not its mirror image, was not checked"),
                             Not(HasSubstr("screw")), Not(HasSubstr("level"))));
}

TEST_F(RegisterAnyBone, RefusesByTheErrorToExpectAtTheEnds) {
  // All from one end: nothing is demanded of coverage, but the other end is not determined.
  constexpr double kLoose_m = 0.001;
  Random wobble(4);
  std::vector<Point<World>> near;
  for (const Point<World>& p : points_) {
    const Vec3 at = (truth_.inverse() * p).v;
    if (at.x > 0.070) {
      near.push_back({p.v + Vec3{wobble.normal(0, kLoose_m), wobble.normal(0, kLoose_m),
                                 wobble.normal(0, kLoose_m)}});
    }
  }
  ASSERT_GT(near.size(), 100U);
  const Called one_end = called(near, {"--any-bone"});
  EXPECT_EQ(one_end.code, 1);
  EXPECT_THAT(one_end.err, HasSubstr("99 % of errors at the ends of the bone are below "));

  Random random(3);
  std::vector<Point<World>> cloud = points_;
  for (Point<World>& p : cloud) {
    p.v = {random.normal(0, 0.06), random.normal(0, 0.06), random.normal(0, 0.06)};
  }
  EXPECT_EQ(called(cloud, {"--any-bone"}).code, 1);
}

TEST_F(RegisterAnyBone, ExcludesWhatIsOfAVertebra) {
  const std::string needs =
      "orthonav: register: --any-bone needs --model, and excludes --plan, which is of a vertebra\n";
  EXPECT_EQ(called(points_, {"--any-bone", "--plan", "plan.json"}).err, needs);
  const Called page = called(points_, {"--any-bone", "--report", folder_.file("page.html")});
  EXPECT_EQ(page.code, 2);
  EXPECT_THAT(page.err, HasSubstr("--any-bone excludes --report"));
  const Called paper = called(points_, {"--any-bone", "--method", "paper"});
  EXPECT_EQ(paper.code, 2);
  EXPECT_THAT(paper.err, StartsWith("orthonav: --any-bone: only the method best"));
}

TEST_F(RegisterAnyBone, FindsARealPelvis) {
  const auto pelvis = stroked_pelvis();
  if (!pelvis) {
    GTEST_SKIP() << "needs shared/real";
  }
  ASSERT_TRUE(engine::save_stl(model_, pelvis->mesh).ok());
  const Called found = called(pelvis->strokes, {"--any-bone", "--json", "-"});
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.err, IsEmpty());
  const auto pose = pose_of(json::parse(found.out));
  const auto posts =
      nav::absolute_orientation(pelvis->posts_in_model_m, pelvis->posts_in_world_m).value();
  EXPECT_LT(degrees(rotation_angle_rad(pose.rotation(), posts.rotation)), 0.5);
  // Along the posts (y) model and tracker mean other ends of them.
  Vec3 middle;
  for (const Vec3& p : pelvis->posts_in_model_m) {
    middle += 0.25 * p;
  }
  const Transform<World, Vertebra> by_posts(posts.rotation, posts.translation_m);
  const Vec3 off = (by_posts.inverse() * (pose * Point<Vertebra>{middle})).v - middle;
  EXPECT_LT(std::hypot(off.x, off.z), 0.0015);
}

}  // namespace
}  // namespace orthonav::test::register_test

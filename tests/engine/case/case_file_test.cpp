#include "engine/case/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <tuple>

#include "engine/case/plan_file.h"
#include "engine/io/mesh_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::case_file_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A case of boxes: each level a model, and a plan whose screw enters the back face.
class CaseFile : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const std::string label : {"L4", "L5"}) {
      ASSERT_TRUE(save_stl(folder_.file(label + ".stl"), box_mesh()).ok());
      const std::vector<nav::ScrewPlan> screws = {
          {nav::Side::kLeft, {{0.02, 0.03, 0}}, {{0.01, -0.01, 0}}, 0.003}};
      ASSERT_TRUE(save_plan(folder_.file(label + ".plan.json"), label, screws).ok());
    }
  }
  static std::string level(const std::string& label, const std::string& more = "") {
    return R"({"label": ")" + label + R"(", "model": ")" + label + R"(.stl", "plan": ")" + label +
           R"(.plan.json")" + more + "}";
  }
  Result<Case> load(const std::string& levels) {
    std::ignore = folder_.with("case.json", R"({"name": "boxes", "levels": [)" + levels + "]}");
    return load_case(folder_.path().string());
  }
  std::string refusal(const std::string& levels) {
    const auto loaded = load(levels);
    EXPECT_FALSE(loaded.ok());
    const std::string message = loaded.ok() ? "" : loaded.error().message;
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    return message;
  }
  static std::string place(double z_mm, const std::string& name = "spine_from_model") {
    return ", \"" + name + R"(": [[1,0,0,0],[0,1,0,0],[0,0,1,)" + std::to_string(z_mm) +
           "],[0,0,0,1]]";
  }

  TemporaryFolder folder_;
};

TEST_F(CaseFile, ReadsLevelsWithTheirModelsAndPlans) {
  const auto loaded = load(level("L4", place(0)) + "," + level("L5", place(-40)));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->name, "boxes");
  ASSERT_EQ(loaded->levels.size(), 2u);
  EXPECT_EQ(loaded->levels[1].label, "L5");
  EXPECT_EQ(loaded->levels[1].mesh.triangles.size(), 12u);
  EXPECT_EQ(loaded->levels[1].screws.size(), 1u);
  EXPECT_DOUBLE_EQ(loaded->levels[1].spine_from_vertebra.translation().z, -0.040);
  EXPECT_EQ(loaded->find("L4"), &loaded->levels[0]);
  EXPECT_EQ(loaded->find("L3"), nullptr);
  EXPECT_THAT(loaded->check(), IsEmpty());
}

TEST_F(CaseFile, StacksModelsThatWouldLieInOneAnother) {
  const auto loaded = load(level("L4") + "," + level("L5"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Vec3 gap = loaded->levels[0].spine_from_vertebra.translation() -
                   loaded->levels[1].spine_from_vertebra.translation();
  EXPECT_EQ(gap.x, 0.0);
  EXPECT_GT(gap.z, 0.030) << "the first level lies on top";
}

TEST_F(CaseFile, LeavesModelsOfOneScanWhereTheyAre) {
  nav::TriangleMesh lower = box_mesh();
  for (Vec3& v : lower.vertices_m) {
    v.z -= 0.045;
  }
  ASSERT_TRUE(save_stl(folder_.file("L5.stl"), lower).ok());
  const std::vector<nav::ScrewPlan> screws = {
      {nav::Side::kLeft, {{0.02, 0.03, -0.045}}, {{0.01, -0.01, -0.045}}, 0.003}};
  ASSERT_TRUE(save_plan(folder_.file("L5.plan.json"), "", screws).ok());
  const auto loaded = load(level("L4") + "," + level("L5"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Transform<Spine, Vertebra> as_it_is;
  EXPECT_EQ(loaded->levels[1].spine_from_vertebra, as_it_is);
}

TEST_F(CaseFile, TurnsARasMatrixWithItsModel) {
  nav::TriangleMesh in_ras_axes = box_mesh();
  for (Vec3& v : in_ras_axes.vertices_m) {
    v = to_lps(v, Axes::kRas);
  }
  std::ignore = folder_.with("L4.obj", as_obj(in_ras_axes, 1e3));
  std::ignore =
      folder_.with("L4.plan.json", R"({"units": "mm", "frame": "RAS", "screws": [{"side": "left",
      "entry": [-20, -30, 0], "target": [-10, 10, 0], "radius": 3}]})");
  const auto loaded = load(R"({"label": "L4", "model": "L4.obj", "plan": "L4.plan.json",
      "spine_from_model": [1,0,0,10, 0,0.8,-0.6,20, 0,0.6,0.8,30, 0,0,0,1]})");
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const Transform<Spine, Vertebra>& place = loaded->levels[0].spine_from_vertebra;
  // A point of the model in RAS, sent through the file's matrix there, then turned to LPS...
  const Vec3 in_ras{0.001, 0.002, 0.003};
  const Vec3 in_spine_ras{0.010 + 0.001, 0.020 + 0.8 * 0.002 - 0.6 * 0.003,
                          0.030 + 0.6 * 0.002 + 0.8 * 0.003};
  // ...is where the case puts the same point in LPS.
  const Vec3 placed = (place * Point<Vertebra>{to_lps(in_ras, Axes::kRas)}).v;
  EXPECT_LT((placed - to_lps(in_spine_ras, Axes::kRas)).norm(), 1e-12);
}

TEST_F(CaseFile, TurnsAMatrixByTheAxesThatTheModelDeclaresNotByThePlans) {
  // The model's file says LPS, its plan is written in RAS.
  std::ignore =
      folder_.with("L4.plan.json", R"({"units": "mm", "frame": "RAS", "screws": [{"side": "left",
      "entry": [-20, -30, 0], "target": [-10, 10, 0], "radius": 3}]})");
  const auto loaded = load(level("L4", R"(, "spine_from_model":
      [1,0,0,10, 0,1,0,20, 0,0,1,30, 0,0,0,1])"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->levels[0].spine_from_vertebra.translation(), (Vec3{0.010, 0.020, 0.030}));
}

TEST_F(CaseFile, LeavesItsFolderByNoName) {
  const TemporaryFolder elsewhere;
  ASSERT_TRUE(save_stl(elsewhere.file("other.stl"), box_mesh()).ok());
  const auto with = [&](const std::string& model, const std::string& plan) {
    return refusal(R"({"label": "L4", "model": ")" + model + R"(", "plan": ")" + plan + R"("})");
  };
  const std::string other = elsewhere.file("other.stl");
  EXPECT_THAT(with(other, "L4.plan.json"), HasSubstr("leads out of"));
  const std::string upwards = "../" + elsewhere.path().filename().string() + "/other.stl";
  EXPECT_THAT(with(upwards, "L4.plan.json"), HasSubstr("leads out of"));
  EXPECT_THAT(with("L4.stl", "sub/../../L4.plan.json"), HasSubstr("leads out of"));
  std::filesystem::create_symlink(other, folder_.file("link.stl"));
  EXPECT_THAT(with("link.stl", "L4.plan.json"), HasSubstr("is a link that leads out of"));
  std::filesystem::create_directory_symlink(elsewhere.path(), folder_.file("sub"));
  EXPECT_THAT(with("sub/other.stl", "L4.plan.json"), HasSubstr("is a link that leads out of"));
  ASSERT_EQ(::mkfifo(folder_.file("pipe.stl").c_str(), 0600), 0);
  EXPECT_THAT(with("pipe.stl", "L4.plan.json"), HasSubstr("is not a plain file"));
}

TEST_F(CaseFile, FollowsALinkThatStaysInside) {
  std::filesystem::create_directory(folder_.file("models"));
  std::filesystem::rename(folder_.file("L4.stl"), folder_.file("models/L4.stl"));
  std::filesystem::create_symlink("models/L4.stl", folder_.file("L4.stl"));
  const auto loaded = load(level("L4"));
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  // And the folder itself may be one.
  const TemporaryFolder elsewhere;
  std::filesystem::create_directory_symlink(folder_.path(), elsewhere.file("case"));
  const auto linked = load_case(elsewhere.file("case"));
  EXPECT_TRUE(linked.ok()) << linked.error().message;
}

TEST_F(CaseFile, IsReadFromTheFolderAloneTooWhenItsOwnFileIsALink) {
  const TemporaryFolder elsewhere;
  std::ignore = elsewhere.with("case.json", R"({"levels": [)" + level("L4") + "]}");
  std::filesystem::create_symlink(elsewhere.file("case.json"), folder_.file("case.json"));
  const auto loaded = load_case(folder_.path().string());
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.error().message, HasSubstr("case.json: is a link that leads out of"));
}

TEST_F(CaseFile, RefusesLabelsThatWouldNameFilesElsewhere) {
  const auto labelled = [&](const std::string& label) {
    return R"({"label": ")" + label + R"(", "model": "L4.stl"})";
  };
  EXPECT_THAT(refusal(level("L5") + "," + labelled("../L4")), HasSubstr("no / and no . in front"));
  EXPECT_THAT(refusal(level("L5") + "," + labelled(std::string(65, 'L'))),
              HasSubstr("64 characters at most"));
  const auto longest = load(labelled(std::string(64, 'L')) + "," + level("L5"));
  EXPECT_TRUE(longest.ok()) << longest.error().message;
}

TEST_F(CaseFile, NamesWhatIsMissing) {
  EXPECT_THAT(load_case(folder_.file("none")).error().message, HasSubstr("cannot be opened"));
  EXPECT_EQ(load_case(folder_.file("none")).error().code, ErrorCode::kNotFound);
  EXPECT_THAT(refusal(""), HasSubstr("levels is empty"));
  EXPECT_THAT(refusal(R"({"label": "L4", "plan": "L4.plan.json"})"),
              HasSubstr("levels[0].model is missing"));
  EXPECT_THAT(refusal(level("L3")), HasSubstr("L3.plan.json: cannot be opened"));
  EXPECT_THAT(refusal(level("L4", place(0)) + "," + level("L5")),
              HasSubstr("spine_from_model in all levels or in none"));
}

TEST_F(CaseFile, RefusesMatricesThatAreNoRigidMotion) {
  EXPECT_THAT(refusal(level("L4", R"(, "spine_from_model": [1, 2, 3])")),
              HasSubstr("levels[0].spine_from_model holds 3 numbers, must be 16"));
  EXPECT_THAT(refusal(level("L4", R"(, "spine_from_model":
                      [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])")),
              HasSubstr("mirrors"));
  EXPECT_THAT(refusal(level("L4", R"(, "spine_from_model":
                      [2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1])")),
              HasSubstr("not rigid"));
  EXPECT_THAT(refusal(level("L4", R"(, "spine_from_model":
                      [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2])")),
              HasSubstr("0 0 0 1"));
}

TEST_F(CaseFile, RefusesThePlanOfAnotherLevel) {
  EXPECT_THAT(refusal(R"({"label": "L5", "model": "L5.stl", "plan": "L4.plan.json"})"),
              HasSubstr("is the plan of L4, the case uses it for L5"));
}

TEST_F(CaseFile, RefusesAPlanOffTheBone) {
  std::ignore =
      folder_.with("L4.plan.json", R"({"units": "mm", "frame": "LPS", "screws": [{"side": "left",
      "entry": [20, 45, 0], "target": [10, 5, 0], "radius": 3}]})");
  EXPECT_THAT(refusal(level("L4")),
              HasSubstr("L4.plan.json: screws[0] entry lies 15.0 mm off the bone, limit 10.0 mm"));
}

TEST_F(CaseFile, RefusesAPlanThatNamesTheOtherSide) {
  std::ignore =
      folder_.with("L4.plan.json", R"({"units": "mm", "frame": "LPS", "screws": [{"side": "right",
      "entry": [20, 30, 0], "target": [10, -10, 0], "radius": 3}]})");
  EXPECT_THAT(refusal(level("L4")),
              HasSubstr("L4.plan.json: screws[0] says right, but its entry lies 20.0 mm to the "
                        "left of the bone's midline, must lie to the right"));
}

/// A laminar screw, or one beside the midline, has the side stated in the plan.
TEST_F(CaseFile, LeavesTheSideToThePlanWhereThePlaceDoesNotTell) {
  std::ignore =
      folder_.with("L4.plan.json", R"({"units": "mm", "frame": "LPS", "screws": [{"side": "right",
      "entry": [4, 30, 0], "target": [10, -10, 0], "radius": 3}]})");
  const auto loaded = load(level("L4"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->levels[0].screws[0].side, nav::Side::kRight);
}

}  // namespace
}  // namespace orthonav::engine::case_file_test

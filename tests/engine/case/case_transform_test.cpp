#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "engine/case/case_file.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::case_transform_test {
namespace {

using orthonav::test::error_of;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kKept_m = 1e-9;

/// The worked example of tests/engine/io/tfm_file_test.cpp, moved 40 mm down: a point of the model
/// at (x, y, z) mm, LPS, is shown at (x - 5, z - 7, -y - 29).
constexpr const char* kL5 =
    "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n"
    "Parameters: 1 0 0 0 0 -1 0 1 0 5 -29 7\nFixedParameters: 0 0 0\n";
constexpr const char* kL4 =
    "#Insight Transform File V1.0\nTransform: AffineTransform_double_3_3\n"
    "Parameters: 1 0 0 0 1 0 0 0 1 0 0 -40\nFixedParameters: 0 0 0\n";

/// A case of two boxes without screws, placed by what the test says.
class CaseTransform : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ignore = folder_.with("L4.obj", as_obj(box_mesh(), 1.0));
    std::ignore = folder_.with("L5.obj", as_obj(box_mesh(), 1.0));
    std::ignore = folder_.with("L4.tfm", kL4);
    std::ignore = folder_.with("L5.tfm", kL5);
  }
  Result<Case> load(const std::string& of_l4, const std::string& of_l5) {
    std::ignore = folder_.with(
        "case.json", R"({"units": "m", "levels": [
            {"label": "L4", "model": "L4.obj", "spine_from_model": )" +
                         of_l4 + R"(}, {"label": "L5", "model": "L5.obj", "spine_from_model": )" +
                         of_l5 + "}]}");
    return load_case(folder_.path().string(), CaseUse::kPlanning);
  }
  std::string refusal(const std::string& of_l4, const std::string& of_l5) {
    const std::string message = error_of(load(of_l4, of_l5));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    return message;
  }

  TemporaryFolder folder_;
};

TEST_F(CaseTransform, PlacesLevelsByFilesOfSlicer) {
  // The case counts in metres; a transform file is always in millimetres.
  const auto loaded = load("\"L4.tfm\"", "\"L5.tfm\"");
  ASSERT_TRUE(is_ok(loaded));
  const Vec3 above = (loaded->levels[0].spine_from_vertebra * Point<Vertebra>{}).v;
  EXPECT_LT((above - Vec3{0, 0, 0.040}).norm(), kKept_m);
  const Vec3 placed =
      (loaded->levels[1].spine_from_vertebra * Point<Vertebra>{{0.001, 0.002, 0.003}}).v;
  EXPECT_LT((placed - Vec3{-0.004, -0.004, -0.031}).norm(), kKept_m);
}

TEST_F(CaseTransform, MixesFilesAndMatrices) {
  const auto loaded = load("[1,0,0,0, 0,1,0,0, 0,0,1,0.050, 0,0,0,1]", "\"L5.tfm\"");
  ASSERT_TRUE(is_ok(loaded));
  EXPECT_EQ(loaded->levels[0].spine_from_vertebra.translation(), (Vec3{0, 0, 0.050}));
}

TEST_F(CaseTransform, RefusesFilesInOneLineThatNamesThem) {
  EXPECT_THAT(refusal("\"none.tfm\"", "\"L5.tfm\""), HasSubstr("none.tfm: cannot be opened"));
  EXPECT_THAT(refusal("\"../L4.tfm\"", "\"L5.tfm\""), HasSubstr("leads out of"));
  EXPECT_THAT(refusal("\"L4.obj\"", "\"L5.tfm\""), HasSubstr("L4.obj: is not a transform file"));
  std::ignore = folder_.with("mirror.tfm",
                             "#Insight Transform File V1.0\nTransform: AffineTransform_double_3_3\n"
                             "Parameters: -1 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 0 0 0\n");
  EXPECT_THAT(refusal("\"mirror.tfm\"", "\"L5.tfm\""), HasSubstr("mirror.tfm: transform mirrors"));
  std::ignore = folder_.with("L4.h5", "\x89HDF\r\n\x1a\n");
  EXPECT_THAT(refusal("\"L4.h5\"", "\"L5.tfm\""), HasSubstr("L4.h5: is HDF5"));
}

}  // namespace
}  // namespace orthonav::engine::case_transform_test

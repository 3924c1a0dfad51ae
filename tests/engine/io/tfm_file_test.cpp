#include "engine/io/tfm_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::tfm_file_test {
namespace {

using orthonav::test::error_of;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// What a transform file must keep.
constexpr double kKept_m = 1e-9;

/// In 3D Slicer, RAS: a node below which (r, a, s) is shown at (r + 5, -s + 7, a + 11) mm. In LPS,
/// x = -r and y = -a, that is (x, y, z) -> (x - 5, z - 7, -y + 11); the file keeps the inverse,
/// (x, y, z) -> (x + 5, -z + 11, y + 7).
constexpr const char* kNumbers = "1 0 0 0 0 -1 0 1 0 5 11 7";
/// The same about the centre c = (10, 20, 30): t = offset - c + R c, with R c = (10, -30, 20).
constexpr const char* kAboutACentre = "1 0 0 0 0 -1 0 1 0 5 -39 -3";

std::string tfm(const std::string& kind, const std::string& parameters,
                const std::string& fixed = "0 0 0") {
  return "#Insight Transform File V1.0\n#Transform 0\nTransform: " + kind +
         "\nParameters: " + parameters + "\nFixedParameters: " + fixed + "\n";
}

Result<Transform<Spine, Vertebra>> pose_in(const std::string& text) {
  const auto stored = transform_from_tfm(text, "a.tfm");
  if (!stored) {
    return stored.error();
  }
  return parent_from_node<Spine, Vertebra>(*stored);
}

std::string refusal(const std::string& text) {
  const std::string message = error_of(pose_in(text));
  EXPECT_THAT(message, AllOf(Not(""), Not(HasSubstr("\n")))) << text;
  return message;
}

/// Where the node's child at (1, 2, 3) mm, LPS, is shown by Slicer, mm.
Vec3 shown_at(const Transform<Spine, Vertebra>& pose) {
  return 1e3 * (pose * Point<Vertebra>{{0.001, 0.002, 0.003}}).v;
}

TEST(TfmFile, MovesAModelAsSlicerShowsIt) {
  for (const auto& [parameters, centre] :
       {std::pair(kNumbers, "0 0 0"), std::pair(kAboutACentre, "10 20 30")}) {
    SCOPED_TRACE(centre);
    const auto pose = pose_in(tfm("AffineTransform_double_3_3", parameters, centre));
    ASSERT_TRUE(is_ok(pose));
    // (1, 2, 3) in LPS is (-1, -2, 3) in RAS, shown at (4, 4, 9) there.
    EXPECT_LT((shown_at(*pose) - Vec3{-4, -4, 9}).norm(), 1e3 * kKept_m);
    const auto inverse = pose->inverse();
    const Transform<Spine, Vertebra> wrong_way_round(inverse.rotation(), inverse.translation());
    EXPECT_GT((shown_at(wrong_way_round) - Vec3{-4, -4, 9}).norm(), 5);
  }
}

TEST(TfmFile, WritesWhatSlicerExpects) {
  const Transform<Spine, Vertebra> pose({{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}},
                                        {-0.005, -0.007, 0.011});
  const StoredTransform written = stored(pose);
  EXPECT_EQ(written.kind, "AffineTransform_double_3_3");
  const std::vector<double> expected = {1, 0, 0, 0, 0, -1, 0, 1, 0, 5, 11, 7};
  ASSERT_EQ(written.parameters.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(written.parameters[i], expected[i], 1e-12) << i;
  }
  EXPECT_EQ(written.fixed_parameters, (std::vector<double>{0, 0, 0}));
}

TEST(TfmFile, KeepsAPoseThroughItsText) {
  const Transform<Spine, Vertebra> pose(rotation_from_vector({0.4, -1.1, 0.9}),
                                        {0.3, -0.5, 1.2345678901});
  const auto again = pose_in(tfm_text(stored(pose)));
  ASSERT_TRUE(is_ok(again));
  EXPECT_LT(rotation_angle_rad(pose.rotation(), again->rotation()), 1e-12);
  EXPECT_LT((pose.translation() - again->translation()).norm(), kKept_m);
}

TEST(TfmFile, ReadsEachRigidKind) {
  // A quarter turn about x, as in kNumbers.
  const std::string angle = "1.5707963267948966";
  const std::string half = "0.7071067811865476";
  for (const std::string numbers : {"double", "float"}) {
    const std::string type = "_" + numbers + "_3_3";
    for (const std::string& text :
         {tfm("AffineTransform" + type, kNumbers),
          tfm("MatrixOffsetTransformBase" + type, kNumbers),
          tfm("Euler3DTransform" + type, angle + " 0 0 5 11 7", "0 0 0 1"),
          tfm("Euler3DTransform" + type, angle + " 0 0 5 -39 -3", "10 20 30"),
          tfm("VersorRigid3DTransform" + type, half + " 0 0 5 11 7"),
          tfm("Similarity3DTransform" + type, half + " 0 0 5 11 7 1")}) {
      SCOPED_TRACE(text);
      const auto pose = pose_in(text);
      ASSERT_TRUE(is_ok(pose));
      EXPECT_LT((shown_at(*pose) - Vec3{-4, -4, 9}).norm(), 1e3 * kKept_m);
    }
  }
}

TEST(TfmFile, ReadsLinesAsPeopleAndWindowsLeaveThem) {
  const auto pose = pose_in(
      "#Insight Transform File V1.0\r\n\r\n# by hand\r\n"
      "Transform: AffineTransform_double_3_3\r\nFixedParameters:\t0  0 0 \r\n"
      "Parameters:  1 0 0 0 0 -1.0 0 1 0 5.0e0 +11 7\r\n");
  ASSERT_TRUE(is_ok(pose));
  EXPECT_LT((shown_at(*pose) - Vec3{-4, -4, 9}).norm(), 1e3 * kKept_m);
}

TEST(TfmFile, TurnsRoundedNumbersAboutTheirCentre) {
  // A rotation rounded to four digits, with a centre half a metre away, which has to stay.
  const auto pose = pose_in(
      tfm("AffineTransform_double_3_3", "0.8776 -0.4794 0 0.4794 0.8776 0 0 0 1 0 0 0", "500 0 0"));
  ASSERT_TRUE(is_ok(pose));
  const Vec3 centre{0.5, 0, 0};
  EXPECT_LT(((*pose * Point<Vertebra>{centre}).v - centre).norm(), kKept_m);
}

TEST(TfmFile, RefusesWhatIsNotRigid) {
  const auto affine = [](const std::string& numbers) {
    return refusal(tfm("AffineTransform_double_3_3", numbers));
  };
  EXPECT_THAT(affine("-1 0 0 0 1 0 0 0 1 0 0 0"), HasSubstr("mirrors"));
  EXPECT_THAT(affine("1.001 0 0 0 1.001 0 0 0 1.001 0 0 0"), HasSubstr("is not rigid"));
  EXPECT_THAT(affine("1 0.001 0 0 1 0 0 0 1 0 0 0"), HasSubstr("limit 0.0001"));
  EXPECT_THAT(affine("0 0 0 0 0 0 0 0 0 0 0 0"), HasSubstr("is not rigid"));
  EXPECT_TRUE(is_ok(pose_in(tfm("AffineTransform_double_3_3", "1 0.00005 0 0 1 0 0 0 1 0 0 0"))))
      << "the twin";
  EXPECT_THAT(refusal(tfm("Similarity3DTransform_double_3_3", "0 0 0 0 0 0 1.01")),
              HasSubstr("is not rigid"));
  EXPECT_THAT(refusal(tfm("VersorRigid3DTransform_double_3_3", "0.8 0.8 0 0 0 0")),
              HasSubstr("versor of length 1.131371, limit 1"));
}

TEST(TfmFile, RefusesOtherKinds) {
  for (const std::string kind :
       {"BSplineTransform_double_3_3", "DisplacementFieldTransform_double_3_3",
        "CompositeTransform_double_3_3", "AffineTransform_double_2_2", "AffineTransform", "",
        "ScaleVersor3DTransform_double_3_3"}) {
    EXPECT_THAT(refusal(tfm(kind, kNumbers)),
                AllOf(HasSubstr("is \"" + kind + "\""), HasSubstr("must be an AffineTransform")));
  }
}

TEST(TfmFile, RefusesNumbersThatAreNotThere) {
  const std::string kind = "AffineTransform_double_3_3";
  EXPECT_THAT(refusal(tfm(kind, "1 0 0 0 1 0 0 0 1 0 0")),
              HasSubstr("has 11 parameters, must have 12"));
  EXPECT_THAT(refusal(tfm(kind, kNumbers, "0 0")),
              HasSubstr("has 2 fixed parameters, must have 3"));
  EXPECT_THAT(refusal(tfm(kind, "1 0 0 0 1 0 0 0 1 nan 0 0")),
              HasSubstr("line 4: Parameters: \"nan\" is not a finite number"));
  EXPECT_THAT(refusal(tfm(kind, kNumbers, "0 inf 0")), HasSubstr("\"inf\" is not a finite"));
  EXPECT_THAT(refusal(tfm(kind, "1 0 0 0 1 0 0 0 1 1e308 0 0", "1e308 0 0")),
              HasSubstr("translation that is not finite"));
  EXPECT_THAT(refusal(tfm(kind, "1,0,0 0 1 0 0 0 1 0 0 0")), HasSubstr("\"1,0,0\" is not a"));
}

TEST(TfmFile, RefusesWhatIsNotOneTransform) {
  const std::string one = tfm("AffineTransform_double_3_3", kNumbers);
  const std::string lines = one.substr(one.find("#Transform 0"));
  EXPECT_THAT(refusal(one + lines), HasSubstr("a.tfm: line 7: a second transform begins"));
  EXPECT_THAT(refusal(lines), HasSubstr("must begin with \"#Insight Transform File V1.0\""));
  EXPECT_THAT(refusal(""), HasSubstr("must begin with"));
  EXPECT_THAT(refusal("#Insight Transform File V1.0\n"), HasSubstr("holds no transform"));
  EXPECT_THAT(refusal(one + "FixedParameters: 0 0 0\n"), HasSubstr("stands twice"));
  EXPECT_THAT(refusal(one + "Scale: 1\n"), HasSubstr("\"Scale\" is unknown"));
  EXPECT_THAT(refusal(one + "text\n"), HasSubstr("must be \"NAME: VALUE\""));
}

TEST(TfmFile, RefusesEveryPartOfAFile) {
  const std::string whole = tfm("AffineTransform_double_3_3", kAboutACentre, "10.25 20.5 30.125");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(pose_in(whole.substr(0, size)).ok()) << size;
  }
  EXPECT_TRUE(is_ok(pose_in(whole)));
}

TEST(TfmFile, RefusesFilesByTheirNames) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(load_tfm(folder.file("none.tfm"))), HasSubstr("none.tfm: cannot be opened"));
  EXPECT_THAT(error_of(load_tfm(folder.with("a.h5", "\x89HDF\r\n\x1a\nmore"))),
              HasSubstr("a.h5: is HDF5, which is not read here: save it as .tfm"));
  EXPECT_THAT(
      error_of(load_tfm(folder.with("long.tfm", std::string(kLongestTransformFile + 1, '#')))),
      HasSubstr("long.tfm: larger than 1 MiB"));
}

}  // namespace
}  // namespace orthonav::engine::tfm_file_test

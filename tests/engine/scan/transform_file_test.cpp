#include "engine/scan/transform_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "engine/io/tfm_file.h"
#include "tests/engine/scan/itk_transform.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::transform_file_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::error_of;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

struct Parent;
struct Node;

/// What a file must keep, 100 mm from the origin and from the centre.
constexpr double kKept_mm = 1e-6;
/// A float matrix is orthonormal to 1e-7, and is made exactly so.
constexpr double kFloat_mm = 1e-4;
constexpr Vec3 kPlace_mm{70, -50, 110};

/// A transform as ITK writes it.
struct Written {
  const char* name;
  const char* kind;
  std::vector<double> parameters;
  std::vector<double> fixed;
};

void PrintTo(const Written& written, std::ostream* out) { *out << written.name; }

class ItkTransform : public ::testing::TestWithParam<std::tuple<Written, const char*>> {};

/// Where a point of the parent lies in the node, mm.
Vec3 in_node(const Transform<Parent, Node>& parent_from_node) {
  return 1e3 * (parent_from_node.inverse() * Point<Parent>{1e-3 * kPlace_mm}).v;
}

TEST_P(ItkTransform, IsReadAsItkReadsItAndWrittenBack) {
  const auto& [written, ending] = GetParam();
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string("a") + ending);
  ASSERT_TRUE(test::itk_writes(path, written.kind, written.parameters, written.fixed));
  const auto expected_mm = test::itk_takes(path, kPlace_mm);
  ASSERT_TRUE(expected_mm);
  const auto stored_there = load_transform(path);
  ASSERT_TRUE(is_ok(stored_there));
  EXPECT_EQ(stored_there->kind, written.kind);
  const auto pose = parent_from_node<Parent, Node>(*stored_there);
  ASSERT_TRUE(is_ok(pose));
  const bool is_float = std::string(written.kind).find("float") != std::string::npos;
  EXPECT_LT((in_node(*pose) - *expected_mm).norm(), is_float ? kFloat_mm : kKept_mm);

  for (const std::string ours : {"b.tfm", "b.h5"}) {
    SCOPED_TRACE(ours);
    ASSERT_TRUE(is_ok(save_transform(folder.file(ours), stored(*pose))));
    const auto again_mm = test::itk_takes(folder.file(ours), kPlace_mm);
    ASSERT_TRUE(again_mm) << "ITK reads it";
    EXPECT_LT((in_node(*pose) - *again_mm).norm(), kKept_mm);
    const auto back = load_transform(folder.file(ours));
    ASSERT_TRUE(is_ok(back));
    const auto back_pose = parent_from_node<Parent, Node>(*back);
    ASSERT_TRUE(is_ok(back_pose));
    EXPECT_LT((in_node(*pose) - in_node(*back_pose)).norm(), kKept_mm);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ItkTransform,
    ::testing::Combine(
        ::testing::Values(
            Written{"Affine",
                    "AffineTransform_double_3_3",
                    {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6, 1, 2, 3},
                    {10, 20, 30}},
            Written{"AffineFloat",
                    "AffineTransform_float_3_3",
                    {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6, 1, 2, 3},
                    {10, 20, 30}},
            Written{"Euler", "Euler3DTransform_double_3_3", {0.1, 0.2, 0.3, 1, 2, 3}, {10, 20, 30}},
            Written{"EulerZyx",
                    "Euler3DTransform_double_3_3",
                    {0.1, 0.2, 0.3, 1, 2, 3},
                    {10, 20, 30, 1}},
            Written{
                "EulerFloat", "Euler3DTransform_float_3_3", {0.1, 0.2, 0.3, 1, 2, 3}, {10, 20, 30}},
            Written{"Versor",
                    "VersorRigid3DTransform_double_3_3",
                    {0.1, -0.2, 0.3, 1, 2, 3},
                    {10, 20, 30}},
            Written{"Similarity",
                    "Similarity3DTransform_double_3_3",
                    {0.1, -0.2, 0.3, 1, 2, 3, 1},
                    {10, 20, 30}}),
        ::testing::Values(".tfm", ".h5")),
    [](const auto& each) {
      return std::string(std::get<0>(each.param).name) +
             (std::string(std::get<1>(each.param)) == ".h5" ? "Hdf5" : "Text");
    });

TEST(TransformFile, RefusesADeformationThatItkWrote) {
  const TemporaryFolder folder;
  const std::string path = folder.file("scaled.h5");
  ASSERT_TRUE(test::itk_writes(path, "ScaleVersor3DTransform_double_3_3",
                               {0, 0, 0, 1, 2, 3, 1, 2, 1}, {0, 0, 0}));
  EXPECT_THAT(error_of(load_transform(path)),
              HasSubstr("scaled.h5: is \"ScaleVersor3DTransform_double_3_3\", must be an Affine"));
}

TEST(TransformFile, RefusesEveryPartOfAnHdf5File) {
  const TemporaryFolder folder;
  const std::string whole_path = folder.file("whole.h5");
  ASSERT_TRUE(
      is_ok(save_transform(whole_path, stored(Transform<Parent, Node>(Mat3::identity(), {})))));
  const std::string whole = content_of(whole_path);
  // A process each: every part near the ends, few between.
  constexpr std::size_t kEnds = 24;
  constexpr std::size_t kStep = 199;
  for (std::size_t size = 0; size < whole.size();
       size += size < kEnds || size + kEnds >= whole.size()
                   ? 1
                   : std::min(kStep, whole.size() - kEnds - size)) {
    const std::string message =
        error_of(load_transform(folder.with("part.h5", whole.substr(0, size))));
    EXPECT_THAT(message, HasSubstr("part.h5: ")) << size;
    EXPECT_THAT(message, ::testing::Not(HasSubstr("\n"))) << size;
  }
  EXPECT_TRUE(is_ok(load_transform(folder.with("part.h5", whole))));
}

TEST(TransformFile, ReadsByContentAndWritesByName) {
  const TemporaryFolder folder;
  const StoredTransform here = stored(Transform<Parent, Node>(Mat3::identity(), {0.001, 0, 0}));
  ASSERT_TRUE(is_ok(save_transform(folder.file("a.h5"), here)));
  EXPECT_TRUE(is_hdf5(content_of(folder.file("a.h5"))));
  std::filesystem::rename(folder.file("a.h5"), folder.file("a.tfm"));
  const auto read = load_transform(folder.file("a.tfm"));
  ASSERT_TRUE(is_ok(read));
  EXPECT_EQ(read->parameters, here.parameters);
  EXPECT_THAT(error_of(save_transform(folder.file("a.mat"), here)),
              HasSubstr("a.mat: must end in .tfm or .h5"));
  EXPECT_THAT(error_of(load_transform(folder.file("none.h5"))), HasSubstr("cannot be opened"));
  EXPECT_THAT(
      error_of(load_transform(folder.with("b.h5", std::string(kLongestTransformFile + 1, ' ')))),
      HasSubstr("b.h5: larger than 1 MiB"));
}

}  // namespace
}  // namespace orthonav::engine::transform_file_test

#include "engine/scan/volume_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

#include "engine/scan/scan_case.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::engine::volume_file_test {
namespace {

namespace test = orthonav::test;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

/// The file's digits.
constexpr double kDigits_m = 1e-8;

/// A small map in NRRD with raw text: 3 x 2 x 2 voxels of 1 x 2 x 3 mm.
std::string nrrd(const std::string& more = "", const std::string& space = "left-posterior-superior",
                 const std::string& numbers = "0 1 2 3 4 5 6 7 8 9 10 11") {
  return "NRRD0005\ntype: short\ndimension: 3\nspace: " + space +
         "\nsizes: 3 2 2\nspace directions: (1,0,0) (0,2,0) (0,0,3)\n"
         "kinds: domain domain domain\nencoding: text\nspace origin: (10,20,30)\n" +
         more + "\n" + numbers + "\n";
}

std::string refusal(const std::string& path) {
  const auto volume = load_volume(path);
  EXPECT_FALSE(volume.ok()) << path;
  const std::string message = volume ? "" : volume.error().message;
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(VolumeFile, ReadsNrrdInLps) {
  const TemporaryFolder folder;
  const auto volume = load_volume(folder.with("map.nrrd", nrrd("Segment0_Name:=L4\n")));
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_EQ(volume->grid.size, (std::array<int, 3>{3, 2, 2}));
  EXPECT_LT((volume->grid.spacing_m - Vec3{0.001, 0.002, 0.003}).norm(), kDigits_m);
  EXPECT_LT((volume->grid.place_m({2, 1, 1}) - Vec3{0.012, 0.022, 0.033}).norm(), kDigits_m);
  ASSERT_EQ(volume->values.size(), 12u);
  EXPECT_EQ(volume->values[volume->grid.at(2, 1, 1)], 11.0F);
  EXPECT_EQ(volume->fields.at("Segment0_Name"), "L4");
}

TEST(VolumeFile, TurnsRasIntoLps) {
  const TemporaryFolder folder;
  const auto volume = load_volume(folder.with("map.nrrd", nrrd("", "right-anterior-superior")));
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_LT((volume->grid.place_m({2, 1, 1}) - Vec3{-0.012, -0.022, 0.033}).norm(), kDigits_m);
}

TEST(VolumeFile, ReadsTheLayersOfASegmentation) {
  // 3D Slicer's overlapping segments: two values a voxel, the list axis first.
  const TemporaryFolder folder;
  const auto volume = load_volume(
      folder.with("s.seg.nrrd",
                  "NRRD0005\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\n"
                  "sizes: 2 3 2 2\nspace directions: none (1,0,0) (0,2,0) (0,0,3)\n"
                  "kinds: list domain domain domain\nencoding: text\nspace origin: (10,20,30)\n"
                  "Segment0_Layer:=1\n\n1 0 2 0 3 0 4 0 5 0 6 0 7 0 8 0 9 0 10 0 11 0 12 99\n"));
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_EQ(volume->layers, 2u);
  EXPECT_EQ(volume->grid.size, (std::array<int, 3>{3, 2, 2}));
  EXPECT_LT((volume->grid.place_m({2, 1, 1}) - Vec3{0.012, 0.022, 0.033}).norm(), kDigits_m);
  const std::size_t last = volume->grid.at(2, 1, 1) * 2;
  EXPECT_EQ(volume->values[last], 12.0F);
  EXPECT_EQ(volume->values[last + 1], 99.0F);
  EXPECT_EQ(volume->fields.at("Segment0_Layer"), "1");
}

TEST(VolumeFile, ReadsNoOtherFileThatAHeaderNames) {
  const TemporaryFolder folder;
  const std::string voxels = folder.with("secret.raw", std::string(16, '\1'));
  const std::string header =
      "NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nendian: little\nencoding: raw\n"
      "space origin: (0,0,0)\n";
  for (const std::string& name : {std::string("secret.raw"), voxels}) {
    EXPECT_THAT(refusal(folder.with("a.nrrd", header + "data file: " + name + "\n\n")),
                HasSubstr("a.nrrd: its voxels are in another file"));
  }
  EXPECT_TRUE(load_volume(folder.with("b.nrrd", header + "\n" + std::string(16, '\1'))).ok());
}

TEST(VolumeFile, TakesNoMemoryForVoxelsThatCannotBeThere) {
  const TemporaryFolder folder;
  const std::string refused =
      refusal(folder.with("a.nrrd",
                          "NRRD0005\ntype: double\ndimension: 3\nspace: left-posterior-superior\n"
                          "sizes: 1000 1000 1000\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                          "endian: little\nencoding: raw\nspace origin: (0,0,0)\n\nfew"));
  EXPECT_THAT(refused, HasSubstr("too short for 8000000000 bytes of voxels"));
}

TEST(VolumeFile, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.file("none.nii.gz")), HasSubstr("no such file or folder"));
  EXPECT_THAT(refusal(folder.with("a.tiff", "x")), HasSubstr("must be .nii, .nii.gz, .nrrd"));
  EXPECT_THAT(refusal(folder.with("b.nii.gz", "not a volume")), HasSubstr("b.nii.gz: "));
  EXPECT_THAT(refusal(folder.with("c.nrrd", "NRRD0005\ntype: short\n")), HasSubstr("c.nrrd: "));
  EXPECT_THAT(refusal(folder.with("d.nrrd", nrrd("", "left-posterior-superior", "0 1 2"))),
              HasSubstr("d.nrrd: "));
  EXPECT_THAT(refusal(folder.path().string()), HasSubstr("no DICOM slices"));
}

/// The shared scans; skips where they are absent.
class SharedScan : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) {
      GTEST_SKIP() << "needs shared/ct/totalsegmentator";
    }
  }
  std::filesystem::path folder_ = orthonav::test::test_data("ct/totalsegmentator");
};

TEST_F(SharedScan, ReadsTheSeriesByPlaceWithItsHounsfieldUnits) {
  const auto volume = load_volume((folder_ / "dicom").string());
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_EQ(volume->grid.size, (std::array<int, 3>{512, 512, 20}));
  EXPECT_LT((volume->grid.spacing_m - Vec3{0.0009765625, 0.0009765625, 0.002}).norm(), kDigits_m);
  EXPECT_LT((volume->grid.origin_m - Vec3{-0.24951171875, -0.43751171875, -0.8045}).norm(),
            kDigits_m);
  // Decoded by OpenJPEG, ordered and scaled by hand from the headers.
  struct Slice {
    int k;
    double sum_hu, at_200_256_hu, at_300_100_hu, at_250_330_hu;
  };
  for (const Slice& s :
       {Slice{0, -164982396.0, -71.0, -1002.0, 59.0}, Slice{7, -163641804.0, 17.0, -1004.0, 150.0},
        Slice{19, -163079110.0, 114.0, -994.0, 238.0}}) {
    const auto first = volume->values.begin() + s.k * 512 * 512;
    EXPECT_EQ(std::accumulate(first, first + 512 * 512, 0.0), s.sum_hu) << s.k;
    EXPECT_EQ(volume->values[volume->grid.at(200, 256, s.k)], static_cast<float>(s.at_200_256_hu));
    EXPECT_EQ(volume->values[volume->grid.at(300, 100, s.k)], static_cast<float>(s.at_300_100_hu));
    EXPECT_EQ(volume->values[volume->grid.at(250, 330, s.k)], static_cast<float>(s.at_250_330_hu));
  }
}

TEST_F(SharedScan, RefusesASeriesWithAMissingSlice) {
  const TemporaryFolder folder;
  int left = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "dicom")) {
    if (entry.path().filename() != "slice16580.dcm") {
      std::filesystem::create_symlink(entry.path(), folder.path() / entry.path().filename());
      ++left;
    }
  }
  ASSERT_EQ(left, 19);
  EXPECT_THAT(refusal(folder.path().string()),
              HasSubstr("are 4.00 mm apart, the others 2.00 mm: slices are missing"));
}

TEST_F(SharedScan, RefusesAMapThatIsCutOff) {
  // The reader itself would take missing voxels as zeros, so half a vertebra would look whole.
  const TemporaryFolder folder;
  const std::string whole = test::content_of(folder_ / "labels.nii.gz");
  for (const std::size_t bytes : {whole.size() / 2, whole.size() - 4}) {
    EXPECT_THAT(refusal(folder.with("cut.nii.gz", whole.substr(0, bytes))), HasSubstr("is cut off"))
        << bytes;
  }
  EXPECT_TRUE(load_volume(folder.with("same.nii.gz", whole)).ok()) << "the twin";
}

TEST_F(SharedScan, MakesTheWholeVertebraeOfItsLabels) {
  const auto labels = load_volume((folder_ / "labels.nii.gz").string());
  const auto scan = load_volume((folder_ / "ct.nii.gz").string());
  ASSERT_TRUE(labels.ok() && scan.ok());
  EXPECT_TRUE(check_on_bone(*labels, "totalsegmentator", *scan).ok());
  const auto made = scan_levels(*labels, "totalsegmentator", {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_EQ(made->levels.size(), 5u);
  EXPECT_EQ(made->levels.front().label, "L1");
  for (const ScanLevel& level : made->levels) {
    EXPECT_LE(level.surface.deviation.p95_m, 0.0015) << level.label << ": half a voxel";
  }
  for (const char* other : {"verse", "totalsegmentator-v1"}) {
    const auto wrong = scan_levels(*labels, other, {});
    ASSERT_FALSE(wrong.ok()) << other;
    EXPECT_THAT(wrong.error().message, HasSubstr("is it another convention?"));
  }
}

}  // namespace
}  // namespace orthonav::engine::volume_file_test

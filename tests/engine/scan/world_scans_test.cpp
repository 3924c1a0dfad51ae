// Scans and label maps as other programs write them: read right, or refused by name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nifti1.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>

#include "base/angle.h"
#include "engine/scan/label_convention.h"
#include "engine/scan/scan_case.h"
#include "engine/scan/volume_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::engine::world_scans_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A header of 3 x 2 x 2 voxels of 1 x 2 x 3 mm in RAS, int16, with both forms alike.
nifti_1_header header() {
  nifti_1_header h{};
  h.sizeof_hdr = 348;
  h.dim[0] = 3;
  h.dim[1] = 3;
  h.dim[2] = h.dim[3] = 2;
  for (int d = 4; d < 8; ++d) {
    h.dim[d] = 1;
  }
  h.datatype = 4;
  h.bitpix = 16;
  h.pixdim[0] = h.pixdim[1] = 1;
  h.pixdim[2] = 2;
  h.pixdim[3] = 3;
  h.vox_offset = 352;
  h.xyzt_units = 2;
  h.qform_code = h.sform_code = 1;
  h.qoffset_x = h.srow_x[3] = -10;
  h.qoffset_y = h.srow_y[3] = -20;
  h.qoffset_z = h.srow_z[3] = 30;
  h.srow_x[0] = 1;
  h.srow_y[1] = 2;
  h.srow_z[2] = 3;
  std::memcpy(h.magic, "n+1", 4);
  return h;
}

template <class T>
std::string file_of(const nifti_1_header& h, const std::vector<T>& voxels) {
  std::string bytes(352, '\0');
  std::memcpy(bytes.data(), &h, sizeof h);
  bytes.append(reinterpret_cast<const char*>(voxels.data()), voxels.size() * sizeof(T));
  return bytes;
}

const std::vector<std::int16_t> kVoxels = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};

class WorldNifti : public ::testing::Test {
 protected:
  [[nodiscard]] Result<Volume> read(const nifti_1_header& h) const {
    return load_volume(folder_.with("a.nii", file_of(h, kVoxels)));
  }
  [[nodiscard]] Result<Volume> changed(const std::function<void(nifti_1_header&)>& change) const {
    nifti_1_header h = header();
    change(h);
    return read(h);
  }
  [[nodiscard]] std::string refusal(const std::function<void(nifti_1_header&)>& change) const {
    const auto volume = changed(change);
    return volume ? "read" : volume.error().message;
  }
  TemporaryFolder folder_;
};

TEST_F(WorldNifti, LiesWhereItsFormsSay) {
  const auto volume = read(header());
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_LT((volume->grid.place_m({2, 1, 1}) - Vec3{0.008, 0.018, 0.033}).norm(), 1e-9);
  EXPECT_EQ(volume->values[volume->grid.at(2, 1, 1)], 11.0F);
  EXPECT_TRUE(volume->notes.empty());
  for (const auto& drop : {&nifti_1_header::qform_code, &nifti_1_header::sform_code}) {
    const auto one = changed([&](nifti_1_header& h) { h.*drop = 0; });
    ASSERT_TRUE(one.ok()) << one.error().message;
    EXPECT_LT((one->grid.place_m({2, 1, 1}) - Vec3{0.008, 0.018, 0.033}).norm(), 1e-9);
  }
  // A mirrored grid is a way to store, not a mirrored patient.
  const auto mirrored = changed([](nifti_1_header& h) {
    h.srow_x[0] = -1;
    h.qform_code = 0;
  });
  ASSERT_TRUE(mirrored.ok()) << mirrored.error().message;
  EXPECT_LT((mirrored->grid.place_m({2, 1, 1}) - Vec3{0.012, 0.018, 0.033}).norm(), 1e-9);
}

TEST_F(WorldNifti, IsRefusedWhereItsFormsDisagree) {
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.srow_x[0] = -1; }),
              HasSubstr("sform and qform disagree, by up to 4.0 mm and 180.00°"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.srow_z[3] += 2; }),
              HasSubstr("disagree, by up to 2.0 mm"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.pixdim[0] = -1; }), HasSubstr("disagree"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.srow_y[2] = 0.8F; }), HasSubstr("disagree"))
      << "a tilted gantry in the sform alone";
  EXPECT_THAT(refusal([](nifti_1_header& h) {
                h.qform_code = 0;
                h.srow_y[2] = 0.8F;
              }),
              HasSubstr("14.93° off right angles, limit 0.20°"));
  EXPECT_THAT(refusal([](nifti_1_header& h) {
                h.qform_code = 0;
                h.pixdim[2] = 1;
              }),
              HasSubstr("1 wide by pixdim and 2 by its sform"));
}

TEST_F(WorldNifti, IsRefusedWhereItStatesNoOrientationOrATemplates) {
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.qform_code = h.sform_code = 0; }),
              HasSubstr("states no orientation"));
  EXPECT_THAT(refusal([](nifti_1_header& h) {
                h.qform_code = 0;
                h.sform_code = 4;
              }),
              HasSubstr("in the space of a template (sform_code 4)"));
}

TEST_F(WorldNifti, IsScaledToItsUnit) {
  const auto micron = changed([](nifti_1_header& h) {
    h.xyzt_units = 3;
    for (float* x :
         {&h.pixdim[1], &h.pixdim[2], &h.pixdim[3], &h.qoffset_x, &h.qoffset_y, &h.qoffset_z,
          &h.srow_x[0], &h.srow_x[3], &h.srow_y[1], &h.srow_y[3], &h.srow_z[2], &h.srow_z[3]}) {
      *x *= 1000;
    }
  });
  ASSERT_TRUE(micron.ok()) << micron.error().message;
  EXPECT_LT((micron->grid.place_m({2, 1, 1}) - Vec3{0.008, 0.018, 0.033}).norm(), 1e-9);
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.xyzt_units = 1; }),
              AllOf(HasSubstr("voxels of 1000.000 mm"), HasSubstr("the header states metres")));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.xyzt_units = 5; }), HasSubstr("unknown unit"));
}

TEST_F(WorldNifti, MayMissRightAnglesByRounding) {
  const auto volume = changed([](nifti_1_header& h) {
    h.srow_y[2] = static_cast<float>(3.0 * std::tan(0.1 * kRadiansPerDegree));
  });
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_THAT(volume->notes, ElementsAre(HasSubstr("0.100° off right angles")));
  EXPECT_LT(orthonormality_error(volume->grid.directions), 1e-9);
  // The middle stays where it is; a corner moves by half the shear.
  EXPECT_LT((volume->grid.place_m({1, 0.5, 0.5}) -
             Vec3{0.009, 0.019 - 0.0015 * std::tan(0.1 * kRadiansPerDegree), 0.0315})
                .norm(),
            1e-8);
}

TEST_F(WorldNifti, AppliesItsScalingWhateverItIsStoredAs) {
  const auto check = [&]<class T>(std::int16_t type, T) {
    nifti_1_header h = header();
    h.datatype = type;
    h.bitpix = 8 * sizeof(T);
    h.scl_slope = 0.1F;
    h.scl_inter = -20;
    std::vector<T> stored;
    for (int i = 0; i < 12; ++i) {
      stored.push_back(static_cast<T>(10 * i));
    }
    const auto volume = load_volume(folder_.with("s.nii", file_of(h, stored)));
    ASSERT_TRUE(volume.ok()) << type << volume.error().message;
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(volume->values[i], float(i) - 20.0F) << type;
    }
  };
  check(2, std::uint8_t{});
  check(256, std::int8_t{});
  check(4, std::int16_t{});
  check(512, std::uint16_t{});
  check(8, std::int32_t{});
  check(768, std::uint32_t{});
  check(1024, std::int64_t{});
  check(16, float{});
  check(64, double{});
  EXPECT_EQ(changed([](nifti_1_header& h) { h.scl_inter = 5; })->values[1], 1.0F)
      << "a slope of 0 means no scaling";
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.scl_slope = NAN; }), HasSubstr("not a number"));
  EXPECT_THAT(refusal([](nifti_1_header& h) {
                h.datatype = 128;
                h.bitpix = 24;
                h.dim[1] = h.dim[2] = h.dim[3] = 2;
              }),
              HasSubstr("its voxels are RGB24"));
}

TEST_F(WorldNifti, IsWholeAndOneFile) {
  const std::string whole = file_of(header(), kVoxels);
  EXPECT_THAT(
      load_volume(folder_.with("cut.nii", whole.substr(0, whole.size() - 2))).error().message,
      HasSubstr("is cut off: it holds 374 bytes, must hold 376"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { std::memcpy(h.magic, "ni1", 4); }),
              HasSubstr("its voxels are in another file"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { std::memcpy(h.magic, "\0\0\0", 4); }),
              HasSubstr("ANALYZE"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.srow_x[0] = 1e30F; }), HasSubstr("not a number"));
  EXPECT_THAT(refusal([](nifti_1_header& h) { h.dim[0] = 4, h.dim[4] = 7; }),
              HasSubstr("dimensions, must have 3"));
}

std::string nrrd(const std::string& fields) {
  return "NRRD0005\ntype: short\ndimension: 3\nsizes: 3 2 2\nkinds: domain domain domain\n"
         "encoding: text\n" +
         fields + "\n0 1 2 3 4 5 6 7 8 9 10 11\n";
}

TEST(WorldNrrd, LiesWhereItsSpaceSays) {
  const TemporaryFolder folder;
  const std::string rest = "space directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (10,20,30)\n";
  const auto corner = [&](const std::string& space) {
    const auto volume = load_volume(folder.with("a.nrrd", nrrd("space: " + space + "\n" + rest)));
    EXPECT_TRUE(volume.ok()) << space << volume.error().message;
    return volume ? 1e3 * volume->grid.place_m({2, 1, 1}) : Vec3{};
  };
  for (const char* lps : {"left-posterior-superior", "LPS", "Left-Posterior-Superior"}) {
    EXPECT_LT((corner(lps) - Vec3{12, 22, 33}).norm(), 1e-6);
  }
  EXPECT_LT((corner("RAS") - Vec3{-12, -22, 33}).norm(), 1e-6);
  EXPECT_LT((corner("left-anterior-superior") - Vec3{12, -22, 33}).norm(), 1e-6);
  const auto refusal = [&](const std::string& fields) {
    const auto volume = load_volume(folder.with("b.nrrd", nrrd(fields)));
    return volume ? "read" : volume.error().message;
  };
  EXPECT_THAT(refusal("spacings: 1 2 3\n"),
              HasSubstr("states no space: left and right are undefined"));
  EXPECT_THAT(refusal("space: scanner-xyz\n" + rest),
              HasSubstr("must be left-posterior-superior, "));
  EXPECT_THAT(refusal("space: 3D-right-handed\n" + rest),
              HasSubstr("must be left-posterior-superior, "));
  EXPECT_THAT(refusal("space: LPS\nspace directions: (1,0,0) (0,2,0) (0,0,3)\n"),
              HasSubstr("no space origin"));
  EXPECT_THAT(refusal("space: LPS\nspace units: \"mm\" \"mm\" \"m\"\n" + rest),
              HasSubstr("must be the same for all axes"));
  EXPECT_THAT(refusal("space: LPS\nspace directions: (1,0,0) (0,2,0.2) (0,0,3)\n"
                      "space origin: (10,20,30)\n"),
              HasSubstr("5.71° off right angles"));
}

TEST(VertebraName, IsReadInTheUsualSpellings) {
  for (const char* name :
       {"L4", "l4", "L 4", "vertebrae_L4", "vertebraL4", "L4 vertebra", "lumbar vertebra 4 (L4)",
        "Lumbar 4", "LWK 4", "LWK4", "Lendenwirbel 4", "L4_vertebral_body", "Segment L4", "L04"}) {
    EXPECT_EQ(vertebra_named(name), "L4") << name;
  }
  for (const char* name :
       {"T12", "Th12", "TH 12", "BWK12", "thoracic_12", "D12", "vertebrae_T12"}) {
    EXPECT_EQ(vertebra_named(name), "T12") << name;
  }
  EXPECT_EQ(vertebra_named("HWK 7"), "C7");
  EXPECT_EQ(vertebra_named("vertebrae_S1"), "S1");
  for (const char* name :
       {"disc_L3_L4", "L3-L4", "L4/5", "L4 nerve root left", "L4 left", "screw L4", "L4_2", "L9",
        "T0", "aorta", "", "4", "Segment_4", "vertebrae", "L4 lamina", "canal L4", "L4+L5"}) {
    EXPECT_EQ(vertebra_named(name), std::nullopt) << name;
  }
}

/// Files after public reports: what must come out is in their README.
class SharedCases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) {
      GTEST_SKIP() << "needs shared/cases";
    }
    base_ = levels("base/labels.nii.gz", "verse");
    ASSERT_TRUE(base_.ok()) << base_.error().message;
    ASSERT_EQ(base_->levels.size(), 2u);
  }
  [[nodiscard]] Result<ScanLevels> levels(const std::string& file, const std::string& convention,
                                          bool unusual = false) const {
    const auto volume = load_volume((folder_ / file).string());
    return volume ? scan_levels(*volume, convention, {}, unusual)
                  : Result<ScanLevels>(volume.error());
  }
  [[nodiscard]] std::string refusal(const std::string& file,
                                    const std::string& convention = "") const {
    const auto made = levels(file, convention);
    return made ? "read" : made.error().message;
  }
  [[nodiscard]] std::string scan_refusal(const std::string& path) const {
    const auto volume = load_volume((folder_ / path).string());
    return volume ? "read" : volume.error().message;
  }
  /// Whether the level is the same bone as in the base, in the same place.
  void expect_same(const std::string& file, const std::string& convention, std::size_t index,
                   const std::string& label, double within_m = 1e-5) const {
    const auto made = levels(file, convention);
    ASSERT_TRUE(made.ok()) << file << made.error().message;
    for (const ScanLevel& level : made->levels) {
      if (level.label == label) {
        const auto own = nav::solid_of(level.surface.mesh);
        const auto base = nav::solid_of(base_->levels[index].surface.mesh);
        EXPECT_LT((own.centroid_m - base.centroid_m).norm(), within_m) << file;
        EXPECT_NEAR(own.volume_m3 / base.volume_m3, 1.0, 1e-3) << file;
        return;
      }
    }
    FAIL() << file << " has no " << label;
  }
  std::filesystem::path folder_ = orthonav::test::test_data("cases");
  Result<ScanLevels> base_ = Error{"not loaded"};
};

TEST_F(SharedCases, NiftiIsReadRightOrRefusedByName) {
  const auto base = load_volume((folder_ / "base/ct.nii.gz").string());
  ASSERT_TRUE(base.ok());
  for (const char* file : {"nifti-scaled/half/ct.nii.gz", "nifti-scaled/inter/ct.nii.gz"}) {
    const auto scaled = load_volume((folder_ / file).string());
    ASSERT_TRUE(scaled.ok()) << scaled.error().message;
    ASSERT_EQ(scaled->values.size(), base->values.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < base->values.size(); ++i) {
      worst = std::max(worst, double(std::abs(scaled->values[i] - base->values[i])));
    }
    EXPECT_LE(worst, 8.0) << file << ": HU, a step of its eight bits";
  }
  EXPECT_THAT(scan_refusal("nifti-axes/tilt/ct.nii.gz"), HasSubstr("sform and qform disagree"));
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string label = i == 0 ? "L3" : "L4";
    expect_same("nifti-axes/micron/labels.nii.gz", "verse", i, label);
    expect_same("nifti-axes/nifti2/labels.nii.gz", "verse", i, label);
    expect_same("nifti-axes/shear/s0.01.nii.gz", "verse", i, label, 2e-5);
    expect_same("nifti-axes/shear/s0.05.nii.gz", "verse", i, label, 1e-4);
    expect_same("nrrd/las/left-anterior-superior.seg.nrrd", "", i, label);
    expect_same("nrrd/int64/int64.seg.nrrd", "", i, label);
    expect_same("nrrd/names/all-three.seg.nrrd", "", i, label);
    expect_same("nrrd/names/case.seg.nrrd", "", i, label);
    expect_same("nrrd/names/german.seg.nrrd", "", i, label);
  }
}

TEST_F(SharedCases, SegmentsAreWhatTheirLayersAndNamesSay) {
  expect_same("nrrd/index/L3only-mislabelled-old.seg.nrrd", "", 1, "L4");
  const auto discs = levels("nrrd/names/disc-L3-L4.seg.nrrd", "");
  ASSERT_TRUE(discs.ok()) << discs.error().message;
  EXPECT_EQ(discs->levels.size(), 1u);
  EXPECT_THAT(discs->left_out, ElementsAre(HasSubstr("disc_L3_L4")));
  const auto nerve = levels("nrrd/names/nerve-L4.seg.nrrd", "");
  ASSERT_TRUE(nerve.ok()) << nerve.error().message;
  EXPECT_THAT(nerve->left_out, ElementsAre(HasSubstr("L4 nerve root left")));
}

TEST_F(SharedCases, DicomIsReadRightOrRefusedByName) {
  EXPECT_THAT(scan_refusal("dicom/cut/dcm"), HasSubstr("IM0032.dcm is cut off"));
  EXPECT_THAT(scan_refusal("dicom/mr/dcm"), HasSubstr("is of modality MR, must be CT"));
  EXPECT_THAT(scan_refusal("dicom/no-spacing/dcm"), HasSubstr("states no pixel spacing"));
  const auto nested = load_volume((folder_ / "dicom/nested").string());
  const auto enhanced = load_volume((folder_ / "dicom/enhanced/dcm").string());
  const auto rounded = load_volume((folder_ / "dicom/rounded/dcm").string());
  ASSERT_TRUE(nested.ok()) << nested.error().message;
  ASSERT_TRUE(enhanced.ok()) << enhanced.error().message;
  ASSERT_TRUE(rounded.ok()) << rounded.error().message;
  EXPECT_EQ(nested->values, enhanced->values);
  EXPECT_LT((nested->grid.origin_m - enhanced->grid.origin_m).norm(), 1e-9);
  EXPECT_NEAR(rounded->grid.spacing_m.z, 0.000625, 5e-6);
  const auto list = list_series((folder_ / "dicom/mr").string());
  ASSERT_TRUE(list.ok() && list->size() == 1u);
  EXPECT_EQ(list->front().modality, "MR");
  EXPECT_EQ(list->front().slices, 33);
  EXPECT_THAT(list->front().problem, HasSubstr("must be CT"));
}

TEST_F(SharedCases, ASliceThatStatesSomethingElseIsNamed) {
  // One slice of a series with other bytes in its header.
  const auto with_changed = [&](const std::string& from, const std::string& to) {
    const TemporaryFolder folder;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "dicom/rounded/dcm")) {
      std::string bytes = orthonav::test::content_of(entry.path());
      const std::string name = entry.path().filename().string();
      if (name == "I007.dcm") {
        const std::size_t at = bytes.rfind(from);  // after the group of the file itself
        EXPECT_NE(at, std::string::npos) << from;
        bytes.replace(at, from.size(), to);
      }
      (void)folder.with(name, bytes);
    }
    const auto volume = load_volume(folder.path().string());
    return volume ? "read" : volume.error().message;
  };
  EXPECT_THAT(with_changed("MONOCHROME2", "MONOCHROME1"),
              HasSubstr("I007.dcm has photometric interpretation \"MONOCHROME1\""));
  EXPECT_THAT(with_changed(std::string("\x28\x00\x53\x10", 4), std::string("\x28\x00\x53\x11", 4)),
              HasSubstr("I007.dcm states no rescale slope and intercept"));
  EXPECT_THAT(with_changed("1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.7"),
              HasSubstr("I007.dcm is a secondary capture"));
}

TEST_F(SharedCases, ConventionsAreHeldAgainstTheBones) {
  for (const char* folder : {"child", "four-lumbar"}) {
    const std::string file = std::string("conventions/") + folder + "/labels.nii.gz";
    EXPECT_THAT(refusal(file, "verse"), HasSubstr("--unusual")) << folder;
    const auto made = levels(file, "verse", true);
    ASSERT_TRUE(made.ok()) << made.error().message;
    EXPECT_THAT(made->unusual, HasSubstr("mm, usual are 105 mm"));
    EXPECT_EQ(case_of(*made, "case").unusual, made->unusual);
  }
  EXPECT_THAT(refusal("conventions/verse-for-ts/labels.nii.gz", "totalsegmentator"),
              HasSubstr("holds no vertebra of the convention"));
}

TEST(Conventions, ATotalSegmentatorsMapIsNoVerse) {
  Volume map;
  map.grid.size = {2, 2, 2};
  const auto refusal = [&](std::vector<float> values, const char* convention) {
    map.values = std::move(values);
    const auto found = labelled_levels(map, convention);
    return found ? "read" : found.error().message;
  };
  EXPECT_THAT(refusal({28, 0, 0, 0, 0, 0, 0, 27}, "verse"),
              HasSubstr("T13 (28) without T12 or L1"));
  EXPECT_THAT(refusal({28, 29, 0, 0, 0, 0, 0, 27}, "verse"),
              HasSubstr("holds 29, which verse does not define"));
  EXPECT_THAT(refusal({28, 118, 0, 0, 0, 0, 0, 27}, "totalsegmentator"), HasSubstr("holds 118"));
  EXPECT_EQ(refusal({28, 19, 20, 60, 0, 0, 0, 27}, "verse"), "read") << "T13 between T12 and L1";
}

}  // namespace
}  // namespace orthonav::engine::world_scans_test

#include "engine/scan/dicom_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/angle.h"

namespace orthonav::engine::dicom_order_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Ten slices 2 mm apart along z, out of order.
std::vector<SliceHeader> slices() {
  std::vector<SliceHeader> out;
  for (const int i : {7, 2, 9, 0, 4, 1, 8, 3, 6, 5}) {
    SliceHeader slice;
    slice.file = "folder/" + std::to_string(i) + ".dcm";
    slice.series = "1.2.3";
    slice.position_m = {-0.1, -0.2, 0.002 * i};
    slice.row = {1, 0, 0};
    slice.column = {0, 1, 0};
    slice.spacing_m = {0.0009, 0.0008};
    slice.size = {512, 400};
    out.push_back(slice);
  }
  return out;
}

std::string refusal(std::vector<SliceHeader> all) {
  const auto stack = stacked(std::move(all));
  return stack ? std::string() : stack.error().message;
}

TEST(DicomOrder, SortsByPlaceAlongTheNormal) {
  const auto stack = stacked(slices());
  ASSERT_TRUE(stack.ok()) << stack.error().message;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(stack->slices[i].file, "folder/" + std::to_string(i) + ".dcm");
  }
  EXPECT_EQ(stack->grid.size, (std::array<int, 3>{512, 400, 10}));
  EXPECT_NEAR(stack->grid.spacing_m.z, 0.002, 1e-12);
  EXPECT_EQ(stack->grid.spacing_m.x, 0.0009);
  EXPECT_EQ(stack->grid.origin_m, (Vec3{-0.1, -0.2, 0.0}));
}

TEST(DicomOrder, RefusesGapsAndSlicesAtOnePlace) {
  auto missing = slices();
  std::erase_if(missing, [](const SliceHeader& s) { return s.file == "folder/4.dcm"; });
  EXPECT_EQ(refusal(missing),
            "3.dcm and 5.dcm are 4.00 mm apart, the others 2.00 mm: slices are missing");
  auto twice = slices();
  twice.push_back(twice.front());
  EXPECT_EQ(refusal(twice), "7.dcm and 7.dcm lie at the same place");
  auto rounded = slices();
  rounded[0].position_m.z += 0.00003;  // the header's digits
  EXPECT_EQ(refusal(rounded), "") << "the twin";
}

TEST(DicomOrder, ReadsPositionsThatWereRoundedAndRefusesASliceThatWasShifted) {
  auto rounded = slices();
  for (SliceHeader& s : rounded) {
    s.position_m.z = std::round(s.position_m.z * 0.3125 * 1e4) * 1e-4;  // 0.625 mm to 0.1 mm
  }
  const auto stack = stacked(rounded);
  ASSERT_TRUE(stack.ok()) << stack.error().message;
  EXPECT_NEAR(stack->grid.spacing_m.z, 0.000625, 0.1e-3 / 9);
  auto shifted = slices();
  shifted[4].position_m.x += 0.0005;
  EXPECT_THAT(refusal(shifted), HasSubstr("4.dcm lies 0.50 mm off an evenly spaced stack"));
  auto uneven = slices();
  uneven[4].position_m.z += 0.0005;
  EXPECT_THAT(refusal(uneven), HasSubstr("4.dcm lies 0.50 mm off an evenly spaced stack"));
}

TEST(DicomOrder, ASeriesThatIsNoCtDoesNotCountBesideOneThatIs) {
  auto all = slices();
  all[0].series = "9.9";
  all[0].ct = false;
  EXPECT_EQ(one_series(all, "")->size(), 9u);
  EXPECT_EQ(one_series(all, "9.9")->size(), 1u);
  for (SliceHeader& s : all) {
    s.ct = false;
    s.problem = "is of modality MR, must be CT";
  }
  EXPECT_FALSE(one_series(all, "").ok()) << "two series, none of CT";
  EXPECT_THAT(refusal({all.begin() + 1, all.end()}), HasSubstr("is of modality MR"));
}

TEST(DicomOrder, RefusesGantryTilt) {
  const auto leaning = [](double tilt_deg) {
    auto all = slices();
    for (SliceHeader& s : all) {
      s.position_m.y += s.position_m.z * std::tan(tilt_deg * kRadiansPerDegree);
    }
    return refusal(all);
  };
  EXPECT_THAT(leaning(12.0), HasSubstr("leans by 12.0°, limit 0.2°: gantry tilt"));
  EXPECT_EQ(leaning(0.1), "") << "the twin";
}

TEST(DicomOrder, RefusesSlicesThatAreNotAlike) {
  auto all = slices();
  all[3].size[1] = 512;
  EXPECT_THAT(refusal(all), HasSubstr("0.dcm has another number of rows or columns than 7.dcm"));
  all = slices();
  all[3].spacing_m[0] = 0.001;
  EXPECT_THAT(refusal(all), HasSubstr("another spacing"));
  all = slices();
  all[3].row = {0, 1, 0};
  EXPECT_THAT(refusal(all), HasSubstr("another orientation"));
  EXPECT_EQ(refusal({slices().front()}), "a single slice makes no volume");
}

TEST(DicomOrder, ListsSeveralSeriesAndMixesNone) {
  auto all = slices();
  all[0].series = all[1].series = "9.9";
  all[0].description = "scout";
  const auto open = one_series(all, "");
  ASSERT_FALSE(open.ok());
  EXPECT_THAT(open.error().message, AllOf(HasSubstr("--series"), HasSubstr("1.2.3 (8 slices)"),
                                          HasSubstr("9.9 (2 slices, \"scout\")")));
  EXPECT_EQ(one_series(all, "1.2.3")->size(), 8u);
  EXPECT_THAT(one_series(all, "7").error().message, HasSubstr("no series 7; there are: "));
  EXPECT_EQ(one_series(slices(), "")->size(), 10u);
  all[0].series = all[1].series = "";
  EXPECT_FALSE(one_series(all, "").ok()) << "a series without a UID is not picked unasked";
}

}  // namespace
}  // namespace orthonav::engine::dicom_order_test

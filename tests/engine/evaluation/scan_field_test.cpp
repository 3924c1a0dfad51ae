#include "engine/evaluation/scan_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace orthonav::engine::scan_field_test {
namespace {

using ::testing::HasSubstr;

/// Muscle with fat, and one voxel of metal.
Volume plain() {
  Volume out;
  out.grid.size = {5, 4, 6};
  out.grid.origin_m = {0.1, 0.2, 0.3};
  out.grid.spacing_m = {0.001, 0.002, 0.003};
  out.values.assign(out.grid.voxels(), 40.0F);
  out.values[0] = -90.0F;
  out.values[50] = 3071.0F;
  return out;
}

std::string refusal_of(const Volume& scan) {
  const Status status = check_scan(scan);
  return status ? "" : status.error().message;
}

TEST(ScanField, RefusesWhatIsNoCtWithMetal) {
  EXPECT_EQ(refusal_of(plain()), "") << "the twin";
  Volume layers = plain();
  layers.layers = 2;
  EXPECT_THAT(refusal_of(layers), HasSubstr("2 values a voxel"));
  Volume nan = plain();
  nan.values[7] = std::nanf("");
  EXPECT_THAT(refusal_of(nan), HasSubstr("not a number"));
  Volume labels = plain();
  labels.values[0] = 0.0F;
  EXPECT_THAT(refusal_of(labels), HasSubstr("not a CT in HU: its least value is 0, limit -30"));
  Volume bare = plain();
  bare.values[50] = 1999.0F;
  EXPECT_THAT(refusal_of(bare), HasSubstr("no metal in the scan: its largest value is 1999 HU"));
  Volume full = plain();
  std::fill(full.values.begin() + 1, full.values.begin() + 20, 3000.0F);
  EXPECT_THAT(refusal_of(full), HasSubstr("limit 5 %"));
}

TEST(ScanField, IsLinearBetweenVoxels) {
  Volume scan = plain();
  for (int k = 0; k < 6; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 5; ++i) {
        scan.values[scan.grid.at(i, j, k)] = static_cast<float>(10 * i + 100 * j - 7 * k);
      }
    }
  }
  const ScanField field(scan);
  EXPECT_NEAR(field.at(scan.grid.place_m({1.25, 2.5, 3.75})), 12.5 + 250.0 - 26.25, 1e-4);
  EXPECT_NEAR(field.at(scan.grid.place_m({3.9999999, 3, 5})), 40 + 300 - 35, 1e-4) << "the border";
  EXPECT_TRUE(std::isnan(field.at(scan.grid.place_m({-0.1, 2, 3}))));
  EXPECT_TRUE(std::isnan(field.at(scan.grid.place_m({1, 3.1, 3}))));
}

}  // namespace
}  // namespace orthonav::engine::scan_field_test

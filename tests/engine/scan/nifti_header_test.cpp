#include "engine/scan/nifti_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine::nifti_header_test {
namespace {

/// A header of zeros with its size in front.
std::string header(std::int32_t size, bool swapped = false) {
  std::string bytes(static_cast<std::size_t>(size), '\0');
  const auto first = swapped ? __builtin_bswap32(static_cast<std::uint32_t>(size))
                             : static_cast<std::uint32_t>(size);
  std::memcpy(bytes.data(), &first, sizeof first);
  return bytes;
}

template <class T>
std::string with(std::string bytes, std::size_t at, T number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
  return bytes;
}

class NiftiHeader : public ::testing::Test {
 protected:
  bool passes(const std::string& bytes) const {
    return check_nifti_numbers(folder_.with("scan.nii", bytes)).ok();
  }
  test::TemporaryFolder folder_;
};

TEST_F(NiftiHeader, MayHoldNoNumberThatAScannerCouldNot) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(passes(header(348)));
  EXPECT_TRUE(passes(with(header(348), 80, 0.7F)));
  EXPECT_FALSE(passes(with(header(348), 80, kNaN)));     // pixdim[1]
  EXPECT_FALSE(passes(with(header(348), 256, 1e30F)));   // quatern_b
  EXPECT_FALSE(passes(with(header(348), 324, -1e30F)));  // srow_z[3]
  EXPECT_TRUE(passes(with(header(348), 328, kNaN)));     // the text after it
  EXPECT_FALSE(passes(with(header(540), 112, 1e300)));
  EXPECT_FALSE(passes(with(header(540), 488, -std::numeric_limits<double>::infinity())));
  const auto swapped = __builtin_bswap32(std::bit_cast<std::uint32_t>(kNaN));
  EXPECT_TRUE(
      passes(with(header(348, true), 80, __builtin_bswap32(std::bit_cast<std::uint32_t>(0.7F)))));
  EXPECT_FALSE(passes(with(header(348, true), 80, swapped)));
}

TEST_F(NiftiHeader, LeavesOtherFilesToTheirReaders) {
  EXPECT_TRUE(passes(""));
  EXPECT_TRUE(passes("NRRD0004\n"));
  EXPECT_TRUE(passes(header(348).substr(0, 100)));
  EXPECT_TRUE(check_nifti_numbers(folder_.file("none.nii")).ok());
}

}  // namespace
}  // namespace orthonav::engine::nifti_header_test

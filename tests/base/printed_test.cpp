#include "base/printed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/findings.h"
#include "base/length_text.h"

namespace orthonav {
namespace {

TEST(Printed, PrintsAsPrintfDoes) {
  EXPECT_EQ(printed("plain"), "plain");
  EXPECT_EQ(printed("%d %5d|%-5d|%05d %+d", -3, 42, 42, 42, 7), "-3    42|42   |00042 +7");
  EXPECT_EQ(printed("%zu %lld %u %x", std::size_t{9}, std::int64_t{-8}, 7u, 255u), "9 -8 7 ff");
  EXPECT_EQ(printed("%.2f|%8.1f|%-8.1f|%+.1f|%f|%g|%.2e", 1.236, 2.5, 2.5, 0.4, 1.5, 0.25, 12345.0),
            "1.24|     2.5|2.5     |+0.4|1.500000|0.25|1.23e+04");
  EXPECT_EQ(printed("%.*f %%", 3, 2.0), "2.000 %");
  EXPECT_EQ(printed("%s|%5s|%-5s|%.2s", "ab", "cd", "ef", "ghi"), "ab|   cd|ef   |gh");
  EXPECT_EQ(printed("%.1f", std::nan("")), "nan");
}

TEST(Printed, GivesNoSignToWhatRoundsToZero) {
  constexpr std::array<double, 5> kTiny = {-0.0, -1e-300, -1e-9, -0.0004, -0.00049999};
  for (const double tiny : kTiny) {
    EXPECT_EQ(printed("%.3f", tiny), "0.000") << tiny;
    EXPECT_EQ(printed("%.0f mm", tiny), "0 mm") << tiny;
    EXPECT_EQ(printed("%+.2f", tiny), "+0.00") << tiny;
    EXPECT_EQ(printed("%8.2f", tiny), "    0.00") << "as wide as ever";
    EXPECT_EQ(printed("%-8.2f|", tiny), "0.00    |");
    EXPECT_EQ(printed("%5.2f|", tiny), " 0.00|");
    EXPECT_EQ(in_mm(tiny * 1e-3, 3), "0.000 mm") << tiny;
    EXPECT_EQ(with_numbers("%.2f, at least %.1f", tiny, 1.0), "0.00, at least 1.0") << tiny;
    EXPECT_EQ(value_beside(tiny, 1.0, 1), "0.0") << tiny;
    std::string length;
    append_mm(length, tiny * 1e-3, 2);
    EXPECT_EQ(length, "0.00 mm") << tiny;
  }
  EXPECT_EQ(printed("%.0f", -0.5), "0") << "a tie, rounded to even";
  EXPECT_EQ(printed("%g", -0.0), "0");
  EXPECT_EQ(printed("%.1e", -0.0), "0.0e+00");
}

TEST(Printed, LeavesEveryOtherSign) {
  EXPECT_EQ(printed("%.2f", -0.005000001), "-0.01");
  EXPECT_EQ(printed("%6.1f", -10.0), " -10.0");
  EXPECT_EQ(printed("%.3g", -0.0001), "-0.0001");
  EXPECT_EQ(printed("%.1e", -1e-9), "-1.0e-09");
  EXPECT_EQ(printed("%s", "run-0.json"), "run-0.json") << "texts are nobody's numbers";
}

TEST(BesideLimit, GivesAsManyDecimalsAsItTakes) {
  constexpr const char* kFormat = "%.1f mm, limit %.1f mm";
  EXPECT_EQ(beside_limit(kFormat, 3.41, 2.0), "3.4 mm, limit 2.0 mm");
  EXPECT_EQ(beside_limit(kFormat, 2.04, 2.0), "2.04 mm, limit 2.00 mm");
  EXPECT_EQ(beside_limit(kFormat, 2.004, 2.0), "2.004 mm, limit 2.000 mm");
  EXPECT_EQ(beside_limit(kFormat, 2.0004, 2.0), "2.0004 mm, limit 2.0000 mm");
  EXPECT_EQ(beside_limit(kFormat, 2.00001, 2.0), "just over 2.0 mm, limit 2.0 mm");
  EXPECT_EQ(beside_limit(kFormat, 1.99999, 2.0), "just under 2.0 mm, limit 2.0 mm");
  EXPECT_EQ(beside_limit(kFormat, 2.0, 2.0), "2.0 mm, limit 2.0 mm");
  EXPECT_EQ(beside_limit("margin %.1f, at least %.0f", 11.96, 12.0), "margin 11.96, at least 12.0");
  EXPECT_EQ(beside_limit("%.0f %% of them, at least %.0f %%", 69.6, 70.0),
            "69.6 % of them, at least 70.0 %");
  EXPECT_EQ(beside_limit("%.1f", 2.04, 2.0), "2.04") << "where the limit is known to the reader";
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(beside_limit(kFormat, kInfinite, 2.0), "inf mm, limit 2.0 mm");
}

TEST(BesideLimit, GivesTheValueAlone) {
  EXPECT_EQ(value_beside(1.26, 2.0, 1), "1.3");
  EXPECT_EQ(value_beside(2.04, 2.0, 1), "2.04");
  EXPECT_EQ(value_beside(2.0000001, 2.0, 1), "just over 2.0");
}

TEST(Printed, AllocatesNothingWhereThereIsRoom) {
  std::string out;
  out.reserve(200);
  const char* const at = out.data();
  append_printed(out, "%zu of %.1f mm %s", std::size_t{3}, 1.25, "left");
  append_beside_limit(out, "; %.1f mm, limit %.1f mm", 2.04, 2.0);
  EXPECT_EQ(out, "3 of 1.2 mm left; 2.04 mm, limit 2.00 mm");
  EXPECT_EQ(out.data(), at);
}

}  // namespace
}  // namespace orthonav

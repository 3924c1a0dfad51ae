#include "base/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace orthonav {
namespace {

using ::testing::ElementsAre;

TEST(Wording, PutsValueAndLimitIn) {
  EXPECT_EQ(with_numbers("%.0f %% of them, limit %.1f %%", 12.0, 3.25),
            "12 % of them, limit 3.2 %");
}

TEST(Wording, CutsWhatIsTooLong) {
  // The largest number alone has 309 digits, and is asked for with as many decimals again.
  EXPECT_EQ(with_numbers("%.300f; %.0f", std::numeric_limits<double>::max(), 1.0).size(),
            399u + 3u);
}

TEST(MustBePositive, NotesEachThatIsNot) {
  std::vector<std::string> problems = {"before"};
  must_be_positive({{"zero", 0.0},
                    {"least", std::numeric_limits<double>::denorm_min()},
                    {"negative", -1.5},
                    {"most", std::numeric_limits<double>::max()},
                    {"endless", std::numeric_limits<double>::infinity()},
                    {"none", std::numeric_limits<double>::quiet_NaN()}},
                   problems);
  EXPECT_THAT(problems, ElementsAre("before", "zero 0.000000, must be above 0",
                                    "negative -1.500000, must be above 0",
                                    "endless inf, must be above 0", "none nan, must be above 0"));
}

}  // namespace
}  // namespace orthonav

#include "base/joined.h"

#include <gtest/gtest.h>

#include <vector>

namespace orthonav {
namespace {

TEST(Joined, PutsEveryProblemIntoOneLine) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a is 3"}), "a is 3");
  EXPECT_EQ(joined(std::vector<std::string>{"a is 3", "b", "c is 4, limit 2"}),
            "a is 3; b; c is 4, limit 2");
}

}  // namespace
}  // namespace orthonav

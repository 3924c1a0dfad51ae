#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/tools/command_line.h"

namespace orthonav::test {

/// `orthonav run` with these arguments is refused before anything is prepared, in one line.
inline void expect_run_refusal(const std::vector<std::string>& arguments,
                               const std::string& reason) {
  std::vector<std::string> words = {"run", "--case", "/none"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Called called = orthonav(words);
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.out, ::testing::IsEmpty());
  EXPECT_THAT(called.err, ::testing::HasSubstr(reason));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

}  // namespace orthonav::test

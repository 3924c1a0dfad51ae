#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/result.h"

namespace orthonav::test {

/// For EXPECT_TRUE of a Status or a Result: a failure prints the Error's message.
template <class Answer>
[[nodiscard]] ::testing::AssertionResult is_ok(const Answer& answer) {
  return answer.ok() ? ::testing::AssertionSuccess()
                     : ::testing::AssertionFailure() << answer.error().message;
}

/// The message of an Error, or empty when there is none.
template <class Answer>
[[nodiscard]] std::string error_of(const Answer& answer) {
  return answer.ok() ? std::string() : answer.error().message;
}

}  // namespace orthonav::test

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "nav/evaluation/tip_accuracy.h"

namespace orthonav::tools {

/// The subject of an accuracy test.
struct AccuracySubject {
  std::string pointer;
  std::string method;
  std::string format = {};  ///< of another tracker's poses, which no method of ours measured
};

/// Every figure, units in the keys.
[[nodiscard]] nlohmann::ordered_json accuracy_json(const AccuracySubject& subject,
                                                   const nav::AccuracyReport& report);
/// The same for people.
[[nodiscard]] std::string accuracy_text(const AccuracySubject& subject,
                                        const nav::AccuracyReport& report);

}  // namespace orthonav::tools

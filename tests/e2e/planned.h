#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"

namespace orthonav::engine {

inline const Case& lumbar_spine() {
  static const Case spine = phantom();
  return spine;
}

/// Levels of it, prepared once for all tests of a process.
inline const Operation& planned(const std::vector<std::string>& levels) {
  static std::map<std::vector<std::string>, Operation> operations;
  const auto found = operations.find(levels);
  return found != operations.end()
             ? found->second
             : operations.emplace(levels, plan_operation(lumbar_spine(), levels).value())
                   .first->second;
}

}  // namespace orthonav::engine

#pragma once

#include <string>

#include "engine/report/operation_result.h"

namespace orthonav::tools {

/// The report as lines for people: the same figures as report.json.
[[nodiscard]] std::string operation_summary(const engine::OperationResult& result);

}  // namespace orthonav::tools

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/evaluation/evaluation.h"

namespace orthonav::tools {

/// A table on standard output.
void print(const engine::Evaluation& evaluation);

/// Every figure, units in the keys (docs/evaluation.md).
[[nodiscard]] nlohmann::ordered_json as_json(const engine::Evaluation& evaluation);

/// "shaft, 5.5 mm thick, 42 mm long, tip at (1.0, -20.3, 104.0) mm in the scan: outside the planned
/// vertebrae".
[[nodiscard]] std::string text_of(const engine::UnassignedMetal& metal,
                                  const engine::Evaluation& evaluation);

/// Planned screws that were not found and vertebrae that were not laid on bone.
[[nodiscard]] bool is_complete(const engine::Evaluation& evaluation);

}  // namespace orthonav::tools

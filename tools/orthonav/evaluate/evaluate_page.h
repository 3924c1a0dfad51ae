#pragma once

#include <string>

#include "engine/evaluation/evaluation.h"

namespace orthonav::tools {

/// The evaluation as a self-contained page: the table, for each screw slices along and across it
/// with planned and placed screw and the registered bone, unassigned metal, and the definitions.
Result<std::string> evaluate_page(const engine::Case& subject, const engine::Volume& scan,
                                  const engine::Evaluation& evaluation, const std::string& source);

}  // namespace orthonav::tools

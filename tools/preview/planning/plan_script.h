#pragma once

#include <span>

#include "tools/preview/planning/plan_model.h"
#include "tools/preview/script.h"

namespace orthonav::preview {

/// The words of a script while a plan is edited.
[[nodiscard]] std::span<const ScriptWord> plan_script_words();

/// Performs a line of it. An Error if it is not understood or refused.
Status perform(const ScriptLine& line, PlanModel& model, const ScriptStage& stage);

}  // namespace orthonav::preview

#pragma once

#include <span>
#include <string>

#include "study/study.h"

namespace orthonav::engine {

/// The method in a study and its definition: the method's name, with the patient reference if one
/// is used, or "stated" for a published system's stated error.
[[nodiscard]] std::string method_label(const OperationOptions& operation);

/// Everything that decides the results of a study, as one line of JSON: the version of the program,
/// the method, the room's magnitudes, the cases with the checksums of their meshes, the seeds.
/// Shards of one study have the same.
[[nodiscard]] std::string definition_of(std::span<const Case> cases, const StudyOptions& options);

}  // namespace orthonav::engine

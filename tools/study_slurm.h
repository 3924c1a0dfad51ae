#pragma once

#include <span>

#include "tools/study_arguments.h"

namespace orthonav::tools {

/// Runs a study as an array job of Slurm and joins what its tasks made. Tasks that were lost, by
/// preemption, a kill or a controller that forgot them, are submitted again; started once more
/// after it was killed itself, it goes on where it was. docs/cohorts.md says how.
int run_on_slurm(const StudyArguments& arguments, std::span<const engine::Case> cases,
                 const engine::StudyOptions& options);

}  // namespace orthonav::tools

#pragma once

#include <span>

#include "tools/orthonav/study/study_arguments.h"

namespace orthonav::tools {

/// Runs a study as a Slurm array job and joins the results of its tasks. Tasks lost by preemption,
/// a kill or a controller that forgot them are submitted again; if this command itself was killed,
/// starting it again continues. See docs/cohorts.md.
int run_on_slurm(const StudyArguments& arguments, std::span<const engine::Case> cases,
                 const engine::StudyOptions& options);

}  // namespace orthonav::tools

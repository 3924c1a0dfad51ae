#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tools/orthonav/shared/screw_arguments.h"
#include "tools/orthonav/shared/stop_signals.h"
#include "tools/preview/planning/plan_app.h"

namespace orthonav::tools {

/// What `preview --plan` takes.
struct PlanWindowArguments {
  bool plan = false;  ///< false: an operation is previewed
  std::string volume;
  std::string series;
  std::string case_folder;          ///< empty: the built-in phantom
  std::vector<std::string> levels;  ///< the first of them is selected at first
  engine::ScrewSizes sizes;
  std::string script;
  preview::PlanOptions options;

  /// `--plan`, `--volume` and `--series`; those of `preview` that only concern an operation are
  /// refused beside `--plan`. To be called after they were added.
  void add_to(CLI::App& preview);
};

/// Opens the window in which a plan is edited, until it is closed or a signal ends it.
int edit_plan(PlanWindowArguments arguments, StopSignals& signals);

}  // namespace orthonav::tools

#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/screw_arguments.h"

namespace orthonav::tools {

/// The common arguments of `plan auto` and `plan check`.
struct PlanArguments {
  std::string case_folder;          ///< empty: the built-in phantom
  std::vector<std::string> levels;  ///< empty: all
  ScrewArguments screws;
  JsonOutput json;

  void add_to(CLI::App& command);
  /// Refuses a level that the case does not have.
  [[nodiscard]] Status check_levels(const engine::Case& subject) const;
  [[nodiscard]] bool wants(const std::string& label) const;
};

void add_plan_auto(CLI::App& plan, Action& action);
void add_plan_check(CLI::App& plan, Action& action);
void add_plan_export(CLI::App& plan, Action& action);
void add_plan_receive(CLI::App& plan, Action& action, StopSignals& signals);

}  // namespace orthonav::tools

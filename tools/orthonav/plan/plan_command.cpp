#include "tools/orthonav/plan/plan_command.h"

#include <algorithm>

#include "engine/case/operation_plan.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void PlanArguments::add_to(CLI::App& command) {
  add_case_option(command, case_folder);
  add_levels_option(command, levels, "levels (default: all)");
  screws.add_to(command);
  json.add_to(command);
}

Status PlanArguments::check_levels(const engine::Case& subject) const {
  for (const std::string& label : levels) {
    if (Status s = engine::check_level(subject, label); !s) {
      return s;
    }
  }
  return {};
}

bool PlanArguments::wants(const std::string& label) const {
  return levels.empty() || std::find(levels.begin(), levels.end(), label) != levels.end();
}

void add_plan_command(CLI::App& app, Action& action, StopSignals& signals) {
  CLI::App* command = app.add_subcommand(
      "plan", "Pedicle screws: plans them, judges a plan, takes it to 3D Slicer and back");
  command->require_subcommand(1);
  add_plan_auto(*command, action);
  add_plan_check(*command, action);
  add_plan_export(*command, action);
  add_plan_receive(*command, action, signals);
}

}  // namespace orthonav::tools

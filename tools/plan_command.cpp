#include "tools/plan_command.h"

#include <algorithm>

#include "engine/case/screw_sizes_file.h"
#include "tools/arguments.h"

namespace orthonav::tools {

void PlanArguments::add_to(CLI::App& command) {
  command
      .add_option("--case", case_folder, "folder with case.json (default: the built-in phantom)")
      ->check(some_text())
      ->type_name("DIR");
  command.add_option("--levels", levels, "levels (default: all)")->delimiter(',');
  command
      .add_option("--sizes", sizes_file,
                  "list of screw sizes (default: 4.5 to 8.5 mm, 25 to 60 mm long; "
                  "docs/file-formats.md)")
      ->check(some_text())
      ->type_name("FILE");
  json.add_to(command);
}

Result<engine::ScrewSizes> PlanArguments::sizes() const {
  return sizes_file.empty() ? Result<engine::ScrewSizes>(engine::ScrewSizes::built_in())
                            : engine::load_screw_sizes(sizes_file);
}

Status PlanArguments::check_levels(const engine::Case& subject) const {
  for (const std::string& label : levels) {
    if (subject.find(label) == nullptr) {
      return Error{"case '" + subject.name + "' has no level '" + label + "'"};
    }
  }
  return {};
}

bool PlanArguments::wants(const std::string& label) const {
  return levels.empty() || std::find(levels.begin(), levels.end(), label) != levels.end();
}

void add_plan_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "plan", "Pedicle screws: plans them, judges a plan, takes it to 3D Slicer");
  command->require_subcommand(1);
  add_plan_auto(*command, action);
  add_plan_check(*command, action);
  add_plan_export(*command, action);
}

}  // namespace orthonav::tools

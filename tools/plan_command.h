#pragma once

#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/screw_sizes.h"
#include "tools/command.h"
#include "tools/json_output.h"

namespace orthonav::tools {

/// What `plan auto` and `plan check` have in common.
struct PlanArguments {
  std::string case_folder;          ///< empty: the built-in phantom
  std::vector<std::string> levels;  ///< empty: all
  std::string sizes_file;           ///< empty: the built-in list
  JsonOutput json;

  void add_to(CLI::App& command);
  [[nodiscard]] Result<engine::ScrewSizes> sizes() const;
  /// Refuses a level that the case does not have.
  [[nodiscard]] Status check_levels(const engine::Case& subject) const;
  [[nodiscard]] bool wants(const std::string& label) const;
};

void add_plan_auto(CLI::App& plan, Action& action);
void add_plan_check(CLI::App& plan, Action& action);
void add_plan_export(CLI::App& plan, Action& action);

}  // namespace orthonav::tools

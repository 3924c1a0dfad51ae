#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/case/likely_mistakes.h"
#include "engine/case/plan_file.h"
#include "tools/orthonav/plan/plan_command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/plan_figures.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

struct CheckArguments {
  PlanArguments common;
  std::string model;  ///< empty: a case
  std::vector<std::string> plans;
};

/// The level that the plan states, or else its files' names, if they agree; empty if none does.
std::string level_of(const engine::Plan& plan, const std::vector<std::string>& files) {
  std::string level = engine::level_in_name(files.front());
  for (const std::string& file : files) {
    level = engine::level_in_name(file) == level ? level : std::string();
  }
  return plan.level.empty() ? level : plan.level;
}

/// Warns of a plan that states no level where it does not fit the model, or may fit by chance.
void warn_of_level(const CheckArguments& arguments, const engine::CaseLevel& model,
                   bool names_agree) {
  const std::string& plan = arguments.plans.front();
  const std::string misfit = engine::poor_fit(model.mesh, model.screws);
  if (!misfit.empty()) {
    print_warning(plan + ": states no level and fits " + arguments.model + " badly (" + misfit +
                  "): is it of another level?");
  } else if (!names_agree) {
    print_warning(plan + ": states no level, and that it fits " + arguments.model +
                  " does not prove that it is for this one: plans of neighbouring levels often "
                  "fit (\"level\" in the plan, or both files' names, would tell)");
  }
}

/// The case that is judged: a folder, the phantom, or one model with its plan.
Result<engine::Case> checked_source(const CheckArguments& arguments) {
  if (arguments.model.empty()) {
    return load_checked_case(arguments.common.case_folder);
  }
  const auto plan = engine::load_plan(arguments.plans);
  if (!plan) {
    return plan.error();
  }
  const std::string of_plan = level_of(*plan, arguments.plans);
  const std::string of_model = engine::level_in_name(arguments.model);
  if (!of_plan.empty() && !of_model.empty() && of_plan != of_model) {
    return Error{arguments.plans.front() + ": is the plan of " + of_plan + ", but " +
                 arguments.model + " is named after " + of_model + ": take the model of " +
                 of_plan + ", or rename it"};
  }
  auto level = engine::load_level(arguments.model, *plan);
  if (!level) {
    return level.error();
  }
  if (plan->level.empty()) {
    warn_of_level(arguments, *level, !of_plan.empty() && !of_model.empty());
  }
  if (level->label.empty()) {
    level->label = "plan";
  }
  return engine::Case{arguments.model, {}, {std::move(*level)}};
}

/// Prints each screw that breaks through; whether none does.
bool none_breaks_through(const std::vector<JudgedLevel>& levels) {
  bool none = true;
  for (const JudgedLevel& level : levels) {
    for (const JudgedScrew& screw : level.screws) {
      if (screw.breaks_through()) {
        none = false;
        std::fprintf(stderr, "orthonav: %s\n", breach_text(level.label, screw).c_str());
      }
    }
  }
  return none;
}

int run_check(const CheckArguments& arguments) {
  if (Status s = arguments.common.json.check(); !s) {
    return bad_input(s.error().message);
  }
  if (arguments.model.empty() != arguments.plans.empty()) {
    return bad_input("--model and --plan go together");
  }
  const auto sizes = arguments.common.screws.sizes();
  if (!sizes) {
    return bad_input(sizes.error().message);
  }
  const auto subject = checked_source(arguments);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  if (Status s = arguments.common.check_levels(*subject); !s) {
    return bad_input(s.error().message);
  }
  std::vector<JudgedLevel> levels;
  for (const engine::CaseLevel& level : subject->levels) {
    if (!arguments.common.wants(level.label)) {
      continue;
    }
    levels.push_back(judged(level, *sizes));
  }
  if (Status s = arguments.common.json.write(as_json(levels)); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.common.json.on_stdout()) {
    print(levels);
  }
  return none_breaks_through(levels) ? kDone : kNo;
}

}  // namespace

void add_plan_check(CLI::App& plan, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      plan.add_subcommand("check", "Judges planned screws: clearance to the cortex, and grade");
  arguments->common.add_to(*command);
  command->add_option("--model", arguments->model, "instead of --case: a vertebra, with --plan")
      ->check(some_text())
      ->type_name("MESH");
  command
      ->add_option("--plan", arguments->plans,
                   "its screws: a plan or 3D Slicer's lines; several files are one plan")
      ->check(some_text())
      ->type_name("PLAN")
      ->allow_extra_args(false);
  command->footer(
      "\nExit code 1 where a screw breaks through the cortex and the plan does not say why it "
      "may.");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_check(*arguments); }; });
}

}  // namespace orthonav::tools

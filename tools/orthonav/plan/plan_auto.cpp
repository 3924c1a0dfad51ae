#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/case/case_writer.h"
#include "tools/orthonav/plan/plan_command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/out_folder.h"
#include "tools/orthonav/shared/plan_figures.h"

namespace orthonav::tools {
namespace {

struct AutoArguments {
  PlanArguments common;
  std::string out;
  double clearance_mm = nav::PlanningRules{}.wanted_clearance_m * 1e3;
  double thickest_mm = nav::PlanningRules{}.thickest_m * 1e3;

  [[nodiscard]] nav::PlanningRules rules() const {
    nav::PlanningRules rules;
    rules.wanted_clearance_m = clearance_mm * 1e-3;
    rules.thickest_m = thickest_mm * 1e-3;
    return rules;
  }
  /// Plans go beside the models of the case.
  [[nodiscard]] bool in_place() const { return out.empty() && !common.case_folder.empty(); }
};

/// Plans one level; the new screws replace its old ones.
JudgedLevel planned(const nav::PlanningRules& rules, const engine::ScrewSizes& sizes,
                    engine::CaseLevel& level) {
  const nav::SurfaceIndex bone(level.mesh);
  const auto screws = nav::plan_pedicle_screws(level.mesh, bone, sizes.implants(), rules);
  JudgedLevel out{level.label, {}, {}};
  level.screws.clear();
  for (const nav::Side side : {nav::Side::kLeft, nav::Side::kRight}) {
    if (!screws) {
      out.refused.push_back({side, screws.error().message});
      continue;
    }
    const auto& found = screws->sides[side == nav::Side::kLeft ? 0 : 1];
    if (!found) {
      out.refused.push_back({side, found.error().message});
      continue;
    }
    JudgedScrew screw = judged(bone, found->plan, sizes);
    screw.found = *found;
    out.screws.push_back(std::move(screw));
    level.screws.push_back(found->plan);
  }
  return out;
}

/// Refuses, before anything is planned, a case to which no plan can be written.
Status check_place(const AutoArguments& arguments, const engine::Case& subject) {
  for (const engine::CaseLevel& level : subject.levels) {
    if (arguments.in_place() && arguments.common.wants(level.label) && !level.screws.empty()) {
      return Error{arguments.common.case_folder + ": " + level.label +
                   " has a plan already; --out FOLDER writes a new case with new plans"};
    }
  }
  return {};
}

/// Writes a new case folder, or plans beside the models of the case; nothing for the phantom.
Status write_plans(const AutoArguments& arguments, engine::Case subject) {
  if (arguments.in_place()) {
    std::erase_if(subject.levels, [&](const engine::CaseLevel& level) {
      return !arguments.common.wants(level.label);
    });
    return engine::add_plans(arguments.common.case_folder, subject);
  }
  if (arguments.out.empty()) {
    return {};
  }
  const auto folder = OutFolder::create("--out", arguments.out);
  return folder ? engine::save_case(arguments.out, subject) : Status{folder.error()};
}

/// Prints why a side has no screw; whether every side has one.
bool complete(const std::vector<JudgedLevel>& levels) {
  bool complete = true;
  for (const JudgedLevel& level : levels) {
    for (const RefusedSide& refused : level.refused) {
      std::fprintf(stderr, "orthonav: %s %s: no screw: %s\n", level.label.c_str(),
                   name_of(refused.side), refused.reason.c_str());
      complete = false;
    }
  }
  return complete;
}

int run_auto(const AutoArguments& arguments) {
  if (Status s = arguments.common.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto sizes = arguments.common.screws.sizes();
  if (!sizes) {
    return bad_input(sizes.error().message);
  }
  auto subject = load_checked_case(arguments.common.case_folder, engine::CaseUse::kPlanning);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  for (const Status& s :
       {arguments.common.check_levels(*subject), check_place(arguments, *subject)}) {
    if (!s) {
      return bad_input(s.error().message);
    }
  }
  std::vector<JudgedLevel> levels;
  bool any = false;
  for (engine::CaseLevel& level : subject->levels) {
    if (arguments.common.wants(level.label)) {
      levels.push_back(planned(arguments.rules(), *sizes, level));
      any = any || !level.screws.empty();
    }
  }
  const Status written = any ? write_plans(arguments, *subject) : Status{};
  if (const Status s = written ? arguments.common.json.write(as_json(levels)) : written; !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.common.json.on_stdout()) {
    print(levels);
  }
  return complete(levels) ? kDone : kNo;
}

}  // namespace

void add_plan_auto(CLI::App& plan, Action& action) {
  auto arguments = std::make_shared<AutoArguments>();
  CLI::App* command = plan.add_subcommand("auto", "Plans pedicle screws from the meshes alone");
  arguments->common.add_to(*command);
  command
      ->add_option("-o,--out", arguments->out,
                   "write the whole case, with the plans, into a new folder (default: plans beside "
                   "the models of a case that has none)")
      ->check(some_text())
      ->type_name("DIR");
  command
      ->add_option("--clearance-mm", arguments->clearance_mm,
                   "bone to leave around a screw; the thickest screw that leaves it is taken")
      ->check(finite_number(0, 5))
      ->capture_default_str();
  command->add_option("--thickest-mm", arguments->thickest_mm, "take no thicker screw")
      ->check(finite_number(2, 12))
      ->capture_default_str();
  command->footer(
      "\nOn each side the screw with the largest clearance to the cortex, from 6 mm past the "
      "entry\n"
      "on; both sides the same size; of the lengths in the list the longest that ends at least 5 "
      "mm,\n"
      "and at least 15 % of the way through the bone, before the far cortex.\n"
      "Exit code 1 where a side gets no screw, with the reason (docs/planning.md).");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_auto(*arguments); }; });
}

}  // namespace orthonav::tools

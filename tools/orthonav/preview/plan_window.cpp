#include "tools/orthonav/preview/plan_window.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "engine/scan/mesh_case.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/operation/stopped_run.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/plan_figures.h"
#include "tools/preview/planning/plan_script.h"

namespace orthonav::tools {
namespace {

/// Options of `preview` that have no meaning without an operation, but for those that a
/// configuration file can give: these are ignored.
constexpr std::array<const char*, 13> kOperationOnly = {
    "--seed",       "--replay",     "--profile",      "--perfect", "--pace",
    "--keep",       "--resume",     "--speed",        "--paused",  "--igtl",
    "--igtl-allow", "--igtl-token", "--igtl-commands"};

/// The scan behind the slices; refused if the models do not lie on its bone.
Result<std::optional<engine::Volume>> scan_for(const PlanWindowArguments& arguments,
                                               const engine::Case& subject) {
  if (arguments.volume.empty()) {
    return std::optional<engine::Volume>();
  }
  auto scan = load_scan(arguments.volume, arguments.series);
  if (!scan) {
    return Error{"--volume: " + scan.error().message, scan.error().code};
  }
  std::vector<engine::MeshLevel> levels;
  for (const engine::CaseLevel& level : subject.levels) {
    levels.push_back({level});
  }
  if (const Status on_bone = engine::check_on_bone(levels, *scan); !on_bone) {
    return Error{"--volume: " + arguments.volume + ": " + on_bone.error().message};
  }
  return std::optional(std::move(*scan));
}

/// Selects the first of them. Refuses one that the case does not have.
Status select_level(const std::vector<std::string>& wanted, engine::PlanEditor& editor) {
  const auto& levels = editor.subject().levels;
  // The first one last, so that it stays selected.
  for (auto label = wanted.rbegin(); label != wanted.rend(); ++label) {
    const auto found =
        std::find_if(levels.begin(), levels.end(),
                     [&](const engine::CaseLevel& level) { return level.label == *label; });
    if (found == levels.end()) {
      return Error{"--levels: the case has no level \"" + *label + "\""};
    }
    editor.select({static_cast<std::size_t>(found - levels.begin()), nav::Side::kLeft});
  }
  return {};
}

int run_window(preview::PlanApp& app, const engine::PlanEditor& editor, StopSignals& signals) {
  if (const Status opened = app.open_window(); !opened) {
    return bad_input(opened.error().message);
  }
  signals.on_stop([&app] { app.quit(); });
  const Status done = app.run();
  signals.on_stop(nullptr);
  if (!app.saved().empty()) {
    print_written(app.saved(), editor.subject(), editor.sizes());
  }
  if (signals.caught()) {
    return signals.exit_code();
  }
  return done ? kDone : bad_input(done.error().message);
}

}  // namespace

void PlanWindowArguments::add_to(CLI::App& preview) {
  CLI::Option* flag =
      preview.add_flag("--plan", plan, "edit the plan of the case instead of an operation");
  preview.add_option("--volume", volume, "the scan of the models, behind the slices")
      ->check(some_text())
      ->type_name("SCAN")
      ->needs(flag);
  preview.add_option("--series", series, "UID of the series, where a folder holds several")
      ->check(some_text())
      ->needs(flag);
  for (const char* name : kOperationOnly) {
    if (CLI::Option* option = preview.get_option_no_throw(name)) {
      flag->excludes(option);
    }
  }
}

int edit_plan(PlanWindowArguments arguments, StopSignals& signals) {
  std::optional<preview::Script> script;
  if (!arguments.script.empty()) {
    auto parsed = preview::Script::load(arguments.script, preview::plan_script_words());
    if (!parsed) {
      return bad_input(parsed.error().message);
    }
    script = std::move(*parsed);
  }
  auto subject = load_checked_case(arguments.case_folder, engine::CaseUse::kPlanning);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  const auto scan = scan_for(arguments, *subject);
  if (!scan) {
    return bad_input(scan.error().message);
  }
  auto editor = engine::PlanEditor::create(*std::move(subject), arguments.sizes);
  const Status ready = editor ? select_level(arguments.levels, *editor) : Status(editor.error());
  if (!ready) {
    return bad_input(ready.error().message);
  }
  arguments.options.scan_name = arguments.volume;
  preview::PlanApp app(std::move(arguments.options), std::move(script), *editor,
                       *scan ? &**scan : nullptr);
  return run_window(app, *editor, signals);
}

}  // namespace orthonav::tools

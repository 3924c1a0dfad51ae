#include <filesystem>
#include <memory>

#include "engine/case/case_writer.h"
#include "engine/case/markups_plan.h"
#include "engine/io/mesh_file.h"
#include "tools/arguments.h"
#include "tools/case_source.h"
#include "tools/out_folder.h"
#include "tools/plan_command.h"
#include "tools/print_text.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string case_folder;
  std::string out;
};

std::string markups_name(const engine::CaseLevel& level) { return level.label + ".mrk.json"; }

/// Writes model and screws of each level, to files that must not exist yet.
Status write_scene(const engine::Case& subject, const OutFolder& folder) {
  std::error_code code;
  for (const engine::CaseLevel& level : subject.levels) {
    for (const std::string& name : {engine::model_name(level.label), markups_name(level)}) {
      if (fs::exists(folder.path() / name, code)) {
        return Error{folder.file(name) + ": is there already"};
      }
    }
  }
  for (const engine::CaseLevel& level : subject.levels) {
    if (Status s = engine::save_stl(folder.file(engine::model_name(level.label)), level.mesh); !s) {
      return s;
    }
    if (level.screws.empty()) {
      continue;
    }
    if (Status s =
            engine::save_markups_plan(folder.file(markups_name(level)), level.label, level.screws);
        !s) {
      return s;
    }
  }
  return {};
}

int run_export(const ExportArguments& arguments) {
  const auto subject = load_checked_case(arguments.case_folder, engine::CaseUse::kPlanning);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  if (Status s = engine::check_labels(*subject); !s) {
    return bad_input(s.error().message);
  }
  const auto folder = OutFolder::create("--out", arguments.out);
  if (!folder) {
    return bad_input(folder.error().message);
  }
  if (Status s = write_scene(*subject, *folder); !s) {
    return bad_input(s.error().message);
  }
  for (const engine::CaseLevel& level : subject->levels) {
    print_text("%s: %s%s%s\n", level.label.c_str(), engine::model_name(level.label).c_str(),
               level.screws.empty() ? "" : ", ",
               level.screws.empty() ? "" : markups_name(level).c_str());
  }
  return kDone;
}

}  // namespace

void add_plan_export(CLI::App& plan, Action& action) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      plan.add_subcommand("export", "Models and screws as 3D Slicer opens them by drag and drop");
  add_case_option(*command, arguments->case_folder);
  command->add_option("-o,--out", arguments->out, "folder for LABEL.stl and LABEL.mrk.json")
      ->required()
      ->check(some_text())
      ->type_name("DIR");
  command->footer(
      "\nAll in the models' own frame (mm, LPS): of a case from a scan, that of the scan. A line "
      "moved\n"
      "in 3D Slicer and saved is a plan again: name it as \"plan\" in case.json, or judge it by\n"
      "plan check --model LABEL.stl --plan LABEL.mrk.json.");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_export(*arguments); }; });
}

}  // namespace orthonav::tools

#include <memory>

#include "base/joined.h"
#include "engine/case/case_writer.h"
#include "engine/case/markups_plan.h"
#include "engine/io/mesh_file.h"
#include "engine/scan/transform_file.h"
#include "tools/orthonav/plan/plan_command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/out_folder.h"
#include "tools/orthonav/shared/print_text.h"
#include "tools/orthonav/shared/transform_name.h"

namespace orthonav::tools {
namespace {

struct ExportArguments {
  std::string case_folder;
  std::string out;
};

std::string markups_name(const engine::CaseLevel& level) { return level.label + ".mrk.json"; }

/// The files of a level: its model, its screws if it has any, and its place in the spine.
std::vector<std::string> names_of(const engine::CaseLevel& level) {
  std::vector<std::string> names = {engine::model_name(level.label)};
  if (!level.screws.empty()) {
    names.push_back(markups_name(level));
  }
  names.push_back(transform_name(level.label));
  return names;
}

Status write_level(const engine::CaseLevel& level, const OutFolder& folder) {
  if (Status s = engine::save_stl(folder.file(engine::model_name(level.label)), level.mesh); !s) {
    return s;
  }
  if (!level.screws.empty()) {
    if (Status s =
            engine::save_markups_plan(folder.file(markups_name(level)), level.label, level.screws);
        !s) {
      return s;
    }
  }
  return engine::save_transform(folder.file(transform_name(level.label)),
                                engine::stored(level.spine_from_vertebra));
}

/// Writes every level, to files that must not exist yet.
Status write_scene(const engine::Case& subject, const OutFolder& folder) {
  for (const engine::CaseLevel& level : subject.levels) {
    if (Status s = folder.check_absent(names_of(level)); !s) {
      return s;
    }
  }
  for (const engine::CaseLevel& level : subject.levels) {
    if (Status s = write_level(level, folder); !s) {
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
    print_text("%s: %s\n", level.label.c_str(), joined(names_of(level), ", ").c_str());
  }
  return kDone;
}

}  // namespace

void add_plan_export(CLI::App& plan, Action& action) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      plan.add_subcommand("export", "Models and screws as 3D Slicer opens them by drag and drop");
  add_case_option(*command, arguments->case_folder);
  command->add_option("-o,--out", arguments->out, "folder for LABEL.stl, LABEL.mrk.json, LABEL.tfm")
      ->required()
      ->check(some_text())
      ->type_name("DIR");
  command->footer(
      "\nModels and lines are in the models' own frame (mm, LPS): of a case from a scan, that of\n"
      "the scan. LABEL.tfm says where the level lies in the spine: in 3D Slicer's module Data\n"
      "drag model and line onto it. A line moved there and saved is a plan again: name it as\n"
      "\"plan\" in case.json, or judge it by plan check --model LABEL.stl --plan LABEL.mrk.json.");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_export(*arguments); }; });
}

}  // namespace orthonav::tools

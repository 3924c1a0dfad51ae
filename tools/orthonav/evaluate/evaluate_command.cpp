#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/case/case_writer.h"
#include "engine/evaluation/evaluation.h"
#include "engine/io/atomic_file.h"
#include "engine/scan/transform_file.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/evaluate/evaluate_figures.h"
#include "tools/orthonav/evaluate/evaluate_page.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/out_folder.h"
#include "tools/orthonav/shared/transform_name.h"

namespace orthonav::tools {
namespace {

struct EvaluateArguments {
  std::string case_folder;
  std::string volume;
  std::string series;
  std::string report;  ///< empty: none
  std::string out;     ///< folder for transforms; empty: none
  JsonOutput json;
};

/// Refuses places that can't be written, before the work.
Status check_outputs(const EvaluateArguments& arguments) {
  if (const Status s = arguments.json.check(); !s || arguments.report.empty()) {
    return s;
  }
  return engine::check_place(arguments.report);
}

/// The folder for transforms, if one is asked for, with room for one of each level.
Result<std::optional<OutFolder>> folder_for(const EvaluateArguments& arguments,
                                            const engine::Case& subject) {
  if (arguments.out.empty()) {
    return std::optional<OutFolder>();
  }
  if (Status s = engine::check_labels(subject); !s) {
    return s.error();
  }
  auto folder = OutFolder::create("--out", arguments.out);
  if (!folder) {
    return folder.error();
  }
  for (const engine::CaseLevel& level : subject.levels) {
    if (Status s = folder->check_absent({transform_name(level.label)}); !s) {
      return s.error();
    }
  }
  return std::optional<OutFolder>(std::move(*folder));
}

/// So that 3D Slicer shows the model and the plan of each vertebra where it lies in the scan.
Status write_transforms(const engine::Evaluation& evaluation, const OutFolder& folder) {
  for (const engine::EvaluatedLevel& level : evaluation.levels) {
    if (!level.registration) {
      continue;
    }
    if (Status s = engine::save_transform(folder.file(transform_name(level.label)),
                                          engine::stored(level.registration->scan_from_vertebra));
        !s) {
      return s;
    }
  }
  return {};
}

Status write_outputs(const EvaluateArguments& arguments, const engine::Case& subject,
                     const engine::Volume& scan, const engine::Evaluation& evaluation) {
  if (!arguments.report.empty()) {
    const auto page = evaluate_page(subject, scan, evaluation,
                                    std::filesystem::path(arguments.volume).filename().string());
    if (!page) {
      return page.error();
    }
    if (Status s = engine::write_file(arguments.report, *page); !s) {
      return s;
    }
  }
  return arguments.json.write(as_json(evaluation));
}

int run_evaluate(const EvaluateArguments& arguments) {
  if (Status s = check_outputs(arguments); !s) {
    return bad_input(s.error().message);
  }
  const auto subject = load_checked_case(arguments.case_folder);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  const auto folder = folder_for(arguments, *subject);
  if (!folder) {
    return bad_input(folder.error().message);
  }
  const auto scan = load_scan(arguments.volume, arguments.series);
  if (!scan) {
    return bad_input(scan.error().message);
  }
  const auto evaluation = engine::evaluate(*subject, *scan);
  if (!evaluation) {
    return bad_input(arguments.volume + ": " + evaluation.error().message);
  }
  Status written = *folder ? write_transforms(*evaluation, **folder) : Status{};
  if (written) {
    written = write_outputs(arguments, *subject, *scan, *evaluation);
  }
  if (!written) {
    return bad_input(written.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print_figures(*evaluation);
  }
  return is_complete(*evaluation) ? kDone : kNo;
}

}  // namespace

void add_evaluate_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate", "Planned against placed screws and wires, from a post-operative CT");
  add_case_option(*command, arguments->case_folder);
  command
      ->add_option("--volume", arguments->volume,
                   "the scan, HU: NIfTI, NRRD, or a folder of DICOM slices")
      ->required()
      ->check(some_text())
      ->type_name("CT");
  command
      ->add_option("--series", arguments->series,
                   "which series, where the folder holds several (its UID)")
      ->check(some_text());
  command
      ->add_option("--report", arguments->report,
                   "The evaluation as a page: slices along and across each screw")
      ->check(some_text())
      ->type_name("PAGE");
  command
      ->add_option("-o,--out", arguments->out,
                   "Folder for LABEL.tfm: where each vertebra lies in the scan, for 3D Slicer")
      ->check(some_text())
      ->type_name("DIR");
  arguments->json.add_to(*command);
  command->footer(
      "\nThe patient may lie turned by up to 45° against the case, anywhere in the scan. Exit code "
      "1\n"
      "where a planned screw was not found or a vertebra could not be laid on the scan\n"
      "(docs/evaluation.md).");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_evaluate(*arguments); }; });
}

}  // namespace orthonav::tools

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/evaluation/evaluation.h"
#include "engine/io/atomic_file.h"
#include "engine/scan/volume_file.h"
#include "tools/arguments.h"
#include "tools/case_source.h"
#include "tools/command.h"
#include "tools/evaluate_figures.h"
#include "tools/evaluate_page.h"
#include "tools/json_output.h"

namespace orthonav::tools {
namespace {

struct EvaluateArguments {
  std::string case_folder;
  std::string volume;
  std::string series;
  std::string report;  ///< empty: none
  JsonOutput json;
};

/// Refuses places that can't be written, before the work.
Status check_outputs(const EvaluateArguments& arguments) {
  if (const Status s = arguments.json.check(); !s || arguments.report.empty()) {
    return s;
  }
  const auto place = engine::AtomicFile::create(arguments.report);
  return place ? Status{} : Status{place.error()};
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
  const auto scan = engine::load_volume(arguments.volume, arguments.series);
  if (!scan) {
    return bad_input(scan.error().message);
  }
  const auto evaluation = engine::evaluate(*subject, *scan);
  if (!evaluation) {
    return bad_input(arguments.volume + ": " + evaluation.error().message);
  }
  if (Status s = write_outputs(arguments, *subject, *scan, *evaluation); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(*evaluation);
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

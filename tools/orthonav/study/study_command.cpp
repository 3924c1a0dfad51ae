#include <unistd.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "engine/io/json_document.h"
#include "study/study.h"
#include "study/study_text.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/count_progress.h"
#include "tools/orthonav/shared/stop_signals.h"
#include "tools/orthonav/study/study_arguments.h"
#include "tools/orthonav/study/study_compare.h"
#include "tools/orthonav/study/study_replay.h"
#include "tools/orthonav/study/study_rods.h"

namespace orthonav::tools {
namespace {

/// Keeps the operations completed before a signal, if any.
int stopped(const StudyArguments& arguments, const engine::Study& study, StopSignals& signals) {
  const std::string how_far = "orthonav: stopped by " + signals.caught().value_or("") + " after " +
                              std::to_string(study.made) + " of " + std::to_string(study.planned) +
                              " operations";
  if (study.made == 0) {
    std::fprintf(stderr, "%s; nothing was written\n", how_far.c_str());
    return signals.exit_code();
  }
  if (const int code = write_study(arguments.json, "", study.text); code != kDone) {
    return code;
  }
  std::fprintf(stderr, "%s%s\n", how_far.c_str(),
               arguments.json.given() ? "; they are kept, marked incomplete" : "");
  return signals.exit_code();
}

int run_on(const StudyArguments& arguments, const engine::StudyOptions& options,
           StopSignals& signals) {
  const auto cases = cases_in(arguments.cases);
  if (!cases) {
    return bad_input(cases.error().message);
  }
  const auto study = engine::run_study(
      *cases, options, counted("operations"),
      [&signals](std::function<void()> stop) { signals.on_stop(std::move(stop)); });
  if (!study) {
    return bad_input(study.error().message);
  }
  if (study->made < study->planned) {
    return stopped(arguments, *study, signals);
  }
  if (const int code =
          write_study(arguments.json, arguments.report, study->text, replay_of(arguments, *cases));
      code != kDone) {
    return code;
  }
  // The runs that finished are kept; a run that could not be made still counts as bad input.
  return study->failure ? bad_input(study->failure->message) : kDone;
}

/// A user at a terminal who did not give the number of operations may not know how long they take.
bool wants_so_many(const StudyArguments& arguments) {
  if (arguments.runs_given || ::isatty(STDIN_FILENO) == 0 || ::isatty(STDERR_FILENO) == 0) {
    return true;
  }
  std::fprintf(stderr, "%d operations a case, about a minute each on two cores: go on? [y/N] ",
               arguments.runs);
  const int answer = std::getchar();
  return answer == 'y' || answer == 'Y';
}

int run_study(const StudyArguments& arguments, StopSignals& signals) {
  signals.outlast_terminal();
  const auto method = engine::method_named(arguments.method);
  if (!method) {
    return bad_input(method.error().message);
  }
  const auto options = options_of(arguments);
  if (!options) {
    return bad_input(options.error().message);
  }
  if (const Status place = arguments.json.check(); !place) {
    return bad_input(place.error().message);
  }
  if (!wants_so_many(arguments)) {
    return bad_input("study: nothing was made (--runs N says how many operations)");
  }
  return run_on(arguments, *options, signals);
}

int merge(const StudyArguments& arguments) {
  if (const Status place = arguments.merged_json.check(); !place) {
    return bad_input(place.error().message);
  }
  const auto store = engine::StudyStore::joined(arguments.merged);
  if (!store) {
    return bad_input(store.error().message);
  }
  if (arguments.merged_report.empty() && arguments.merged_json.given()) {
    const Status written = arguments.merged_json.stream(
        [&store](std::ostream& out) { return engine::write_study(*store, out); });
    return written ? kDone : bad_input(written.error().message);
  }
  const auto study = engine::study_text(*store);
  return study ? write_study(arguments.merged_json, arguments.merged_report, *study)
               : bad_input(study.error().message);
}

}  // namespace

void add_study_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<StudyArguments>();
  auto* study = app.add_subcommand("study",
                                   "Many simulated operations and the paper's Table 1 over them; "
                                   "merge joins shards, compare sets "
                                   "two studies beside each other");
  add_options(*study, *arguments);
  add_rods_command(*study, action);
  add_compare_command(*study, action);
  auto* merge_command = study->add_subcommand("merge", "Joins the stores of shards (--db)");
  merge_command->add_option("FILE", arguments->merged, "stores of shards")->required();
  arguments->merged_json.add_to(*merge_command);
  merge_command->add_option("--report", arguments->merged_report, "HTML page to write")
      ->check(some_text());
  study->require_subcommand(0, 1);
  study->callback([arguments, &action, &signals, merge_command, study] {
    const bool merging = merge_command->parsed();
    if (!merging && !study->get_subcommands().empty()) {
      return;
    }
    arguments->runs_given = study->get_option("--runs")->count() > 0;
    action = [arguments, &signals, merging] {
      return merging ? merge(*arguments) : run_study(*arguments, signals);
    };
  });
}

}  // namespace orthonav::tools

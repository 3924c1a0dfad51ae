#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "engine/case/tool_file.h"
#include "engine/io/json_document.h"
#include "engine/study/study.h"
#include "tools/arguments.h"
#include "tools/case_source.h"
#include "tools/command.h"
#include "tools/count_progress.h"
#include "tools/json_output.h"
#include "tools/stop_signals.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string cases;
  std::string method = "best";
  std::vector<std::string> levels;
  int runs = 20;
  std::uint64_t first_seed = 1;
  std::string shard = "1/1";
  int jobs = 0;
  JsonOutput json{JsonOutput::Unasked::kStdout};
  bool perfect = false;
  bool navigation_alone = false;
  std::vector<std::string> merged;
  JsonOutput merged_json{JsonOutput::Unasked::kStdout};
};

/// A case folder, or a folder of case folders in the order of their names; the phantom without one.
Result<std::vector<engine::Case>> cases_in(const std::string& folder) {
  if (folder.empty()) {
    auto spine = load_checked_case(folder);
    if (!spine) {
      return spine.error();
    }
    return std::vector<engine::Case>{std::move(*spine)};
  }
  std::vector<std::string> folders;
  std::error_code code;
  if (fs::exists(fs::path(folder) / "case.json", code)) {
    folders.push_back(folder);
  } else {
    for (const auto& entry : fs::directory_iterator(folder, code)) {
      if (fs::exists(entry.path() / "case.json")) {
        folders.push_back(entry.path().string());
      }
    }
    std::sort(folders.begin(), folders.end());
  }
  if (folders.empty()) {
    return Error{"--cases " + folder + ": no case.json in it or one level below"};
  }
  std::vector<engine::Case> cases;
  for (const std::string& path : folders) {
    auto loaded = load_checked_case(path);
    if (!loaded) {
      return loaded.error();
    }
    cases.push_back(std::move(*loaded));
  }
  return cases;
}

Result<engine::StudyOptions> options_of(const StudyArguments& arguments) {
  engine::StudyOptions options;
  options.operation.method = arguments.method;
  options.operation.levels = arguments.levels;
  options.operation.tools = engine::built_in_tools();
  options.operation.loop.draw_every = 0;
  if (arguments.perfect) {
    options.operation.sim.error_model = sim::ErrorModel::perfect();
  }
  if (arguments.navigation_alone) {
    options.operation.sim.error_model = sim::ErrorModel::navigation_alone();
  }
  options.runs = arguments.runs;
  options.first_seed = arguments.first_seed;
  options.jobs = arguments.jobs > 0
                     ? arguments.jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int used = 0;
  const bool whole = std::sscanf(arguments.shard.c_str(), "%d/%d%n", &options.shard,
                                 &options.shards, &used) == 2 &&
                     used == static_cast<int>(arguments.shard.size());
  if (!whole) {
    return Error{"--shard " + arguments.shard + ": must be I/N with 1 <= I <= N"};
  }
  return options;
}

/// What was made until a signal came is kept, if it is anything.
int stopped(const StudyArguments& arguments, const engine::Study& study, StopSignals& signals) {
  const std::string how_far = "orthonav: stopped by " + signals.caught().value_or("") + " after " +
                              std::to_string(study.made) + " of " + std::to_string(study.planned) +
                              " operations";
  if (study.made == 0) {
    std::fprintf(stderr, "%s; nothing was written\n", how_far.c_str());
    return signals.exit_code();
  }
  if (const Status written = arguments.json.write_text(study.text); !written) {
    return bad_input(written.error().message);
  }
  std::fprintf(stderr, "%s; they are kept, marked incomplete\n", how_far.c_str());
  return signals.exit_code();
}

int run_study(const StudyArguments& arguments, StopSignals& signals) {
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
  const auto cases = cases_in(arguments.cases);
  if (!cases) {
    return bad_input(cases.error().message);
  }
  std::optional<CountProgress> progress;
  const auto count = [&progress](int /*done*/, int all) {
    if (!progress) {
      progress.emplace("operations", all);
    }
    progress->add_one();
  };
  const auto study = engine::run_study(
      *cases, *options, count,
      [&signals](std::function<void()> stop) { signals.on_stop(std::move(stop)); });
  progress.reset();
  if (!study) {
    return bad_input(study.error().message);
  }
  if (study->made < study->planned) {
    return stopped(arguments, *study, signals);
  }
  if (const Status written = arguments.json.write_text(study->text); !written) {
    return bad_input(written.error().message);
  }
  // The runs that finished are kept; a run that could not be made still counts as bad input.
  return study->failure ? bad_input(study->failure->message) : kDone;
}

int merge(const StudyArguments& arguments) {
  if (const Status place = arguments.merged_json.check(); !place) {
    return bad_input(place.error().message);
  }
  std::vector<std::string> texts;
  for (const std::string& path : arguments.merged) {
    auto text = engine::read_text(path);
    if (!text) {
      return bad_input(text.error().message);
    }
    texts.push_back(std::move(*text));
  }
  const auto study = engine::merge_studies(texts, arguments.merged);
  if (!study) {
    return bad_input(study.error().message);
  }
  const Status written = arguments.merged_json.write_text(*study);
  return written ? kDone : bad_input(written.error().message);
}

}  // namespace

void add_study_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<StudyArguments>();
  auto* study = app.add_subcommand(
      "study", "Many simulated operations and the paper's Table 1 over them; merge joins shards");
  study
      ->add_option("--cases", arguments->cases,
                   "case folder or a folder of them (default: the built-in phantom)")
      ->check(some_text());
  study->add_option("--method", arguments->method, "best or paper (the published one)")
      ->capture_default_str();
  study->add_option("--levels", arguments->levels, "levels to operate (default: the two lowest)")
      ->delimiter(',');
  study->add_option("--runs", arguments->runs, "operations a case")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str();
  study->add_option("--seed", arguments->first_seed, "seed of the first run, then one more each")
      ->check(seed_number())
      ->capture_default_str();
  study->add_option("--shard", arguments->shard, "I/N: every N-th run from the I-th on")
      ->capture_default_str();
  study->add_option("--jobs", arguments->jobs, "operations at once (0: as many as cores)")
      ->check(whole_number(0, 1024))
      ->capture_default_str();
  arguments->json.add_to(*study);
  auto* perfect = study->add_flag("--perfect", arguments->perfect, "every source of error at zero");
  study
      ->add_flag("--navigation-alone", arguments->navigation_alone,
                 "the eye, the aiming hand and the wire at zero, all else as documented")
      ->excludes(perfect);
  auto* merge_command = study->add_subcommand("merge", "joins the results of shards");
  merge_command->add_option("files", arguments->merged, "results of shards")->required();
  arguments->merged_json.add_to(*merge_command);
  study->require_subcommand(0, 1);
  study->callback([arguments, &action, &signals, merge_command] {
    const bool merging = merge_command->parsed();
    action = [arguments, &signals, merging] {
      return merging ? merge(*arguments) : run_study(*arguments, signals);
    };
  });
}

}  // namespace orthonav::tools

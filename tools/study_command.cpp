#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "engine/atomic_file.h"
#include "engine/case_file.h"
#include "engine/json_document.h"
#include "engine/phantom.h"
#include "engine/study.h"
#include "engine/tool_file.h"
#include "tools/command.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string cases;
  std::string method = "paper";
  std::vector<std::string> levels;
  int runs = 20;
  std::uint64_t first_seed = 1;
  std::string shard = "1/1";
  int jobs = 0;
  std::string json;
  bool perfect = false;
  std::vector<std::string> merged;
  std::string merged_json;
};

/// A case folder, or a folder of case folders in the order of their names; the phantom without one.
Result<std::vector<engine::Case>> cases_in(const std::string& folder) {
  if (folder.empty()) return std::vector<engine::Case>{engine::phantom()};
  std::vector<std::string> folders;
  std::error_code code;
  if (fs::exists(fs::path(folder) / "case.json", code)) {
    folders.push_back(folder);
  } else {
    for (const auto& entry : fs::directory_iterator(folder, code))
      if (fs::exists(entry.path() / "case.json")) folders.push_back(entry.path().string());
    std::sort(folders.begin(), folders.end());
  }
  if (folders.empty())
    return Error{"--cases " + folder + ": no case.json in it or one level below"};
  std::vector<engine::Case> cases;
  for (const std::string& path : folders) {
    auto loaded = engine::load_case(path);
    if (!loaded) return loaded.error();
    const auto problems = loaded->check();
    if (!problems.empty()) return Error{path + ": " + problems.front()};
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
  if (arguments.perfect) options.operation.sim.magnitudes = sim::Magnitudes::perfect();
  options.runs = arguments.runs;
  options.first_seed = arguments.first_seed;
  options.jobs = arguments.jobs > 0
                     ? arguments.jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  int used = 0;
  const bool whole = std::sscanf(arguments.shard.c_str(), "%d/%d%n", &options.shard,
                                 &options.shards, &used) == 2 &&
                     used == static_cast<int>(arguments.shard.size());
  if (!whole) return Error{"--shard " + arguments.shard + ": must be I/N with 1 <= I <= N"};
  return options;
}

int write_or_print(const std::string& path, const std::string& text) {
  if (path.empty()) {
    std::fputs(text.c_str(), stdout);
    return kDone;
  }
  const Status written = engine::write_file(path, text);
  return written ? kDone : bad_input(written.error().message);
}

int run_study(const StudyArguments& arguments) {
  const auto method = engine::method_named(arguments.method);
  if (!method) return bad_input(method.error().message);
  const auto options = options_of(arguments);
  if (!options) return bad_input(options.error().message);
  const auto cases = cases_in(arguments.cases);
  if (!cases) return bad_input(cases.error().message);
  const auto study = engine::run_study(*cases, *options, [](int done, int all) {
    std::fprintf(stderr, "%d of %d operations\n", done, all);
  });
  if (!study) return bad_input(study.error().message);
  return write_or_print(arguments.json, *study);
}

int merge(const StudyArguments& arguments) {
  std::vector<std::string> texts;
  for (const std::string& path : arguments.merged) {
    auto text = engine::read_text(path);
    if (!text) return bad_input(text.error().message);
    texts.push_back(std::move(*text));
  }
  const auto study = engine::merge_studies(texts, arguments.merged);
  if (!study) return bad_input(study.error().message);
  return write_or_print(arguments.merged_json, *study);
}

}  // namespace

void add_study_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<StudyArguments>();
  auto* study = app.add_subcommand(
      "study", "Many simulated operations and the paper's Table 1 over them; merge joins shards");
  study->add_option("--cases", arguments->cases,
                    "case folder or a folder of them (default: the built-in phantom)");
  study->add_option("--method", arguments->method, "tracking and registration: paper")
      ->capture_default_str();
  study->add_option("--levels", arguments->levels, "levels to operate (default: the two lowest)")
      ->delimiter(',');
  study->add_option("--runs", arguments->runs, "operations a case")->capture_default_str();
  study->add_option("--seed", arguments->first_seed, "seed of the first run, then one more each")
      ->capture_default_str();
  study->add_option("--shard", arguments->shard, "I/N: every N-th run from the I-th on")
      ->capture_default_str();
  study->add_option("--jobs", arguments->jobs, "operations at once (default: the cores)")
      ->check(CLI::NonNegativeNumber);
  study->add_option("--json", arguments->json, "file of the result (default: standard output)");
  study->add_flag("--perfect", arguments->perfect, "every source of error at zero");
  auto* merge_command = study->add_subcommand("merge", "joins the results of shards");
  merge_command->add_option("files", arguments->merged, "results of shards")->required();
  merge_command->add_option("--json", arguments->merged_json,
                            "file of the result (default: standard output)");
  study->require_subcommand(0, 1);
  study->callback([arguments, &action, merge_command] {
    const bool merging = merge_command->parsed();
    action = [arguments, merging] { return merging ? merge(*arguments) : run_study(*arguments); };
  });
}

}  // namespace orthonav::tools

#include "tools/orthonav/study/study_arguments.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>

#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "study/left_out.h"
#include "study/study_text.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/study/build_name.h"

namespace orthonav::tools {

namespace fs = std::filesystem;

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
    return Error{"--cases " + folder + ": no case.json in it or one level below",
                 ErrorCode::kNotFound};
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

namespace {

/// Applies the options other than method and profile.
Status choose(const StudyArguments& arguments, engine::OperationOptions& operation) {
  if (Status set = arguments.surgeon.set_in(operation.sim.guidance, operation.sim.error_model);
      !set) {
    return set;
  }
  if (!arguments.tools.empty()) {
    auto tools = engine::load_tools(arguments.tools);
    if (!tools) {
      return tools.error();
    }
    operation.tools = std::move(*tools);
  }
  for (const std::string& step : arguments.without) {
    if (Status known = engine::leave_out(step, operation); !known) {
      return Error{"--without " + known.error().message};
    }
  }
  return {};
}

}  // namespace

Result<engine::StudyOptions> options_of(const StudyArguments& arguments) {
  engine::StudyOptions options;
  options.operation = study_operation();
  options.operation.method = arguments.method;
  if (!arguments.profile.empty()) {
    const auto profile = engine::profile_named(arguments.profile);
    if (!profile) {
      return profile.error();
    }
    profile->apply(options.operation);
  }
  if (arguments.measurement == "model") {
    options.operation.measurement = engine::Measurement::kModel;
  }
  options.operation.levels = arguments.levels;
  options.operation.use_reference = options.operation.use_reference || arguments.reference;
  if (arguments.perfect) {
    options.operation.sim.error_model = sim::ErrorModel::perfect();
  }
  if (arguments.navigation_alone) {
    options.operation.sim.error_model = sim::ErrorModel::navigation_alone();
  }
  if (const Status chosen = choose(arguments, options.operation); !chosen) {
    return chosen.error();
  }
  options.runs = arguments.runs;
  options.store = arguments.store;
  options.version = build_name();
  options.first_seed = arguments.first_seed;
  options.jobs = jobs_or_cores(arguments.jobs);
  int used = 0;
  const bool whole = std::sscanf(arguments.shard.c_str(), "%d/%d%n", &options.shard,
                                 &options.shards, &used) == 2 &&
                     used == static_cast<int>(arguments.shard.size());
  if (!whole) {
    return Error{"--shard " + arguments.shard + ": must be I/N with 1 <= I <= N"};
  }
  return options;
}

int jobs_or_cores(int jobs) {
  return jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

engine::OperationOptions study_operation() {
  engine::OperationOptions operation;
  operation.tools = engine::built_in_tools();
  operation.loop.draw_every = 0;
  return operation;
}

int write_study(const JsonOutput& json, const std::string& page, const std::string& study,
                const engine::ReplayCommand& replay) {
  if (const Status written = json.write_text(study); !written) {
    return bad_input(written.error().message);
  }
  if (!json.on_stdout()) {
    std::fputs(engine::study_table(study).c_str(), stdout);
  }
  const Status drawn =
      page.empty() ? Status() : engine::write_file(page, engine::study_html(study, replay));
  return drawn ? kDone : bad_input(drawn.error().message);
}

namespace {

/// Options for how many operations, and where.
void add_cohort_options(CLI::App& study, StudyArguments& arguments) {
  study.add_option("-n,--runs", arguments.runs, "operations a case")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str();
  study.add_option("-s,--seed", arguments.first_seed, "seed of the first run, then one more each")
      ->check(seed_number())
      ->capture_default_str();
  study.add_option("--shard", arguments.shard, "I/N: every N-th run from the I-th on")
      ->capture_default_str();
  study.add_option("-j,--jobs", arguments.jobs, "operations at once (0: as many as cores)")
      ->check(whole_number(0, 1024))
      ->capture_default_str();
  study
      .add_option("--db", arguments.store,
                  "SQLite file that keeps each operation; what it holds is not made again")
      ->check(some_text());
  study.add_option("--report", arguments.report, "HTML page to write")->check(some_text());
  arguments.json.add_to(study);
  auto* perfect = study.add_flag("--perfect", arguments.perfect, "every source of error at zero");
  study
      .add_flag("--navigation-alone", arguments.navigation_alone,
                "the eye, the aiming hand and the wire at zero, all else as documented")
      ->excludes(perfect);
}

}  // namespace

void add_options(CLI::App& study, StudyArguments& arguments) {
  study
      .add_option("--cases", arguments.cases,
                  "case folder or a folder of them (default: the built-in phantom)")
      ->check(some_text())
      ->transform(folder_of_case());
  add_method_option(study, arguments.method);
  study
      .add_option("--profile", arguments.profile, "the setting: liebmann-2019 is the publication's")
      ->check(some_text())
      ->type_name("liebmann-2019|FILE");
  study
      .add_option("--measurement", arguments.measurement,
                  "pixels, or model: what pixels would tell, drawn")
      ->check(CLI::IsMember({"pixels", "model"}))
      ->capture_default_str();
  add_levels_option(study, arguments.levels);
  add_reference_flag(study, arguments.reference);
  study
      .add_option(
          "--without", arguments.without,
          "steps of the method that are left out: check-points, landmark, tips, axis, tag-sizes, "
          "wire, redo, numbers, reference")
      ->delimiter(',')
      ->type_name("STEPS|check-points|landmark|tips|axis|tag-sizes|wire|redo|numbers|reference");
  arguments.surgeon.add_to(study);
  study.add_option("-t,--tools", arguments.tools, "tools file (default: the built-in ones)")
      ->check(some_text());
  add_cohort_options(study, arguments);
}

}  // namespace orthonav::tools

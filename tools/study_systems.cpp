#include "tools/study_systems.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/study/study.h"
#include "engine/study/system_table.h"
#include "tools/arguments.h"
#include "tools/build_name.h"
#include "tools/case_source.h"
#include "tools/count_progress.h"
#include "tools/study_arguments.h"

namespace orthonav::tools {
namespace {

struct SystemsArguments {
  std::vector<std::string> names;
  int runs = 25;
  std::uint64_t first_seed = 1;
  int jobs = 0;
  std::string folder;
};

Result<engine::Study> study_of(const engine::SystemProfile& system, const engine::Case& spine,
                               const SystemsArguments& arguments) {
  engine::StudyOptions options;
  options.operation = modelled_operation(system);
  options.runs = arguments.runs;
  options.first_seed = arguments.first_seed;
  options.jobs = jobs_or_cores(arguments.jobs);
  options.version = build_name();
  if (!arguments.folder.empty()) {
    options.store = arguments.folder + "/" + system.name + ".db";
  }
  return engine::run_study({&spine, 1}, options, counted(system.name));
}

int run_systems(const SystemsArguments& arguments) {
  std::vector<engine::SystemProfile> systems;
  for (const std::string& name : arguments.names) {
    auto system = engine::system_named(name);
    if (!system) {
      return bad_input(system.error().message);
    }
    systems.push_back(std::move(*system));
  }
  if (systems.empty()) {
    systems = engine::published_systems();
  }
  const auto spine = load_checked_case("");
  if (!spine) {
    return bad_input(spine.error().message);
  }
  std::fputs(engine::system_table_heading().c_str(), stdout);
  for (const engine::SystemProfile& system : systems) {
    const auto study = study_of(system, *spine, arguments);
    if (!study) {
      return bad_input(study.error().message);
    }
    const auto rows =
        engine::predictions_of(system, nlohmann::json::parse(study->text, nullptr, false));
    std::fputs(engine::system_table_rows(system, rows).c_str(), stdout);
    std::fflush(stdout);
  }
  return kDone;
}

}  // namespace

void add_systems_command(CLI::App& study, Action& action) {
  auto arguments = std::make_shared<SystemsArguments>();
  auto* systems = study.add_subcommand(
      "systems", "What the simulated room predicts of published systems, beside what they reached");
  systems->add_option("SYSTEM", arguments->names, "systems, or files of one (default: all)");
  systems->add_option("-n,--runs", arguments->runs, "operations a system")
      ->check(whole_number(2, 1'000'000))
      ->capture_default_str();
  systems
      ->add_option("-s,--seed", arguments->first_seed, "seed of the first run, then one more each")
      ->check(seed_number())
      ->capture_default_str();
  systems->add_option("-j,--jobs", arguments->jobs, "operations at once (0: as many as cores)")
      ->check(whole_number(0, 1024))
      ->capture_default_str();
  systems->add_option("--db", arguments->folder, "folder that keeps the operations")
      ->check(some_text());
  systems->callback(
      [arguments, &action] { action = [arguments] { return run_systems(*arguments); }; });
}

}  // namespace orthonav::tools

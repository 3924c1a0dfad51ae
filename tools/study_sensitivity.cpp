#include "tools/study_sensitivity.h"

#include <cstdio>
#include <memory>

#include "engine/io/atomic_file.h"
#include "engine/study/sensitivity.h"
#include "engine/study/sensitivity_page.h"
#include "engine/study/sensitivity_regression.h"
#include "engine/study/system_profile.h"
#include "tools/arguments.h"
#include "tools/case_source.h"
#include "tools/count_progress.h"
#include "tools/study_arguments.h"

namespace orthonav::tools {
namespace {

struct SensitivityArguments {
  std::string profile = "liebmann-2019";
  engine::SensitivityOptions options;
  int jobs = 0;
  std::string report;  ///< HTML page; empty: none
};

int run_sensitivity(const SensitivityArguments& arguments) {
  const auto system = engine::system_named(arguments.profile);
  if (!system) {
    return bad_input(system.error().message);
  }
  const auto spine = load_checked_case("");
  if (!spine) {
    return bad_input(spine.error().message);
  }
  engine::SensitivityOptions options = arguments.options;
  options.operation = modelled_operation(*system);
  options.jobs = jobs_or_cores(arguments.jobs);
  std::size_t used = 0;
  const auto found = options.points > 0 ? engine::regressed_sensitivities(*spine, options, used,
                                                                          counted("operations"))
                                        : engine::sensitivities(*spine, options, counted("points"));
  if (!found) {
    return bad_input(found.error().message);
  }
  if (options.points > 0) {
    std::printf("%zu of %d operations placed a screw.\n\n", used, options.points);
  }
  std::fputs(engine::sensitivity_table(*found, options).c_str(), stdout);
  if (arguments.report.empty()) {
    return kDone;
  }
  const Status drawn =
      engine::write_file(arguments.report, engine::sensitivity_html(*found, options));
  return drawn ? kDone : bad_input(drawn.error().message);
}

}  // namespace

void add_sensitivity_command(CLI::App& study, Action& action) {
  auto arguments = std::make_shared<SensitivityArguments>();
  auto* command = study.add_subcommand(
      "sensitivity", "Which magnitude of the simulated room decides entry and angle (Morris)");
  command->add_option("--profile", arguments->profile, "a published system")
      ->check(some_text())
      ->capture_default_str();
  command
      ->add_option("--points", arguments->options.points,
                   "operations at random places, regressed, in place of Morris's method")
      ->check(whole_number(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--trajectories", arguments->options.trajectories, "of Morris's method")
      ->check(whole_number(1, 1000))
      ->capture_default_str();
  command
      ->add_option("-n,--runs", arguments->options.runs,
                   "operations at each point of Morris's method")
      ->check(whole_number(1, 10'000))
      ->capture_default_str();
  command->add_option("-s,--seed", arguments->options.seed, "of everything")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("-j,--jobs", arguments->jobs, "operations at once (0: as many as cores)")
      ->check(whole_number(0, 1024))
      ->capture_default_str();
  command->add_option("--report", arguments->report, "HTML page to write")->check(some_text());
  command->callback(
      [arguments, &action] { action = [arguments] { return run_sensitivity(*arguments); }; });
}

}  // namespace orthonav::tools

#include "tools/study_rods.h"

#include <cstdio>
#include <memory>

#include "engine/study/rod_experiment.h"
#include "tools/arguments.h"

namespace orthonav::tools {
namespace {

struct StudyRodsArguments {
  int rods = 18;
  std::uint64_t seed = 1;
};

void print_arm(const char* name, const engine::RodArm& arm, const char* published) {
  std::printf("| %s | %zu of %zu | %.0f ± %.0f | %.2f | %.2f | %zu | %s |\n", name,
              arm.right_lengths, arm.rods.size(), arm.mean_time_s, arm.time_sd_s,
              arm.mean_first_try_m * 1e3, arm.mean_head_distance_m * 1e3, arm.rebends, published);
}

void print_instructed(const char* name, const engine::InstructedRods& told) {
  const std::size_t instructed = told.rods.size() - told.refused;
  double touched_m = 0.0;
  double heads_m = 0.0;
  for (const engine::InstructedRod& rod : told.rods) {
    touched_m += rod.bends ? rod.off_touched_m / static_cast<double>(instructed) : 0.0;
    heads_m += rod.bends ? rod.off_heads_m / static_cast<double>(instructed) : 0.0;
  }
  std::printf(
      "\n%s: %zu of %zu rods, %zu bends, %.0f s. Farthest head at the first try, as touched: "
      "%.2f mm, %zu within %.1f mm; true: %.2f mm, %zu within.\n",
      name, instructed, told.rods.size(), told.bends, told.arm.mean_time_s, touched_m * 1e3,
      told.within_of_touched, engine::kInstructedLimit_m * 1e3, heads_m * 1e3,
      told.within_of_heads);
}

int run_rods(const StudyRodsArguments& arguments) {
  engine::RodExperimentOptions options;
  options.rods = static_cast<std::size_t>(arguments.rods);
  const engine::RodExperiment found = engine::run_rod_experiment(options, arguments.seed);
  std::puts(
      "| | right length | time, s | heads missed by, first try, mm | in the end | bent again | "
      "published |\n|---|---|---|---|---|---|---|");
  print_arm("with the template", found.with_template, "15 of 18, 374 s");
  const engine::InstructedRods told = engine::run_instructed_rods(options, arguments.seed);
  print_arm("with instructions", told.arm, "374 s and 1.0 mm to be kept");
  print_arm("by eye", found.control, "4 of 18, 465 s (fitted)");
  std::printf(
      "\nTemplate less eye, 95 %% interval: right length %+.2f (%+.2f to %+.2f), time %+.0f s "
      "(%+.0f to %+.0f)\n",
      found.right_length.mean, found.right_length.low, found.right_length.high, found.time_s.mean,
      found.time_s.low, found.time_s.high);
  print_instructed("Instructions", told);
  options.remeasured = false;
  const engine::InstructedRods unmeasured = engine::run_instructed_rods(options, arguments.seed);
  print_instructed("Without measuring after each bend", unmeasured);
  return kDone;
}

}  // namespace

void add_rods_command(CLI::App& study, Action& action) {
  auto arguments = std::make_shared<StudyRodsArguments>();
  auto* rods = study.add_subcommand("rods", "Rods bent with the template, and by eye");
  rods->add_option("--rods", arguments->rods, "rods in each arm")
      ->check(whole_number(3, 1'000'000))
      ->capture_default_str();
  rods->add_option("-s,--seed", arguments->seed, "of everything")
      ->check(seed_number())
      ->capture_default_str();
  rods->callback([arguments, &action] { action = [arguments] { return run_rods(*arguments); }; });
}

}  // namespace orthonav::tools

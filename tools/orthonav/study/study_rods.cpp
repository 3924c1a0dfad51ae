#include "tools/orthonav/study/study_rods.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "base/printed.h"
#include "study/rod_experiment.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

struct StudyRodsArguments {
  int rods = 18;
  std::uint64_t seed = 1;
  bool parts = false;
};

void print_arm(const char* name, const engine::RodArm& arm, const char* published) {
  std::printf("| %s | %zu of %zu | %.0f ± %.0f | %.2f | %.2f | %zu | %s |\n", name,
              arm.right_lengths, arm.rods.size(), arm.mean_time_s, arm.time_sd_s,
              arm.mean_first_try_m * 1e3, arm.mean_head_distance_m * 1e3, arm.rebends, published);
}

/// 95 % interval of a share (Wilson 1927), in percent.
std::string share(std::size_t count, std::size_t all) {
  constexpr double kSds = 1.96;
  const double n = static_cast<double>(all);
  const double p = n > 0.0 ? static_cast<double>(count) / n : 0.0;
  const double shrunk = 1.0 / (1.0 + kSds * kSds / n);
  const double middle = shrunk * (p + 0.5 * kSds * kSds / n);
  const double half = shrunk * kSds * std::sqrt(p * (1.0 - p) / n + 0.25 * kSds * kSds / (n * n));
  return printed("%zu of %zu (%.1f to %.1f %%)", count, all, 100.0 * (middle - half),
                 100.0 * (middle + half));
}

void print_instructed(const char* name, const engine::InstructedRods& told) {
  const std::size_t instructed = told.rods.size() - told.refused;
  double touched_m = 0.0;
  double heads_m = 0.0;
  for (const engine::InstructedRod& rod : told.rods) {
    touched_m += rod.bends ? rod.off_touched_m / static_cast<double>(instructed) : 0.0;
    heads_m += rod.bends ? rod.off_heads_m / static_cast<double>(instructed) : 0.0;
  }
  std::printf("| %s | %zu of %zu | %.2f | %zu | %.2f | %s | %.1f %% | %zu | %.0f ± %.0f |\n", name,
              instructed, told.rods.size(), touched_m * 1e3, told.within_of_touched, heads_m * 1e3,
              share(told.within_of_heads, told.rods.size()).c_str(), 100.0 * told.expected_within,
              told.arm.right_lengths, told.arm.mean_time_s,
              1.96 * told.arm.time_sd_s / std::sqrt(static_cast<double>(told.rods.size())));
}

using Change = void (*)(engine::RodExperimentOptions&);

/// The same rods with one part of the instructed arm taken away, or changed.
void print_parts(const engine::RodExperimentOptions& options, std::uint64_t seed) {
  constexpr std::array<std::pair<const char*, Change>, 5> kParts = {
      {{"heads touched as with the template", [](auto& o) { o.in_socket = false; }},
       {"one touch of every head", [](auto& o) { o.long_rod_touches = 1; }},
       {"two touches of every head", [](auto& o) { o.head_touches = 2; }},
       {"on the headset's map (0.37 mm between heads)",
        [](auto& o) { o.neighbour_navigation_m = 0.00037; }},
       {"ends not marked", [](auto& o) { o.ends_marked = false; }}}};
  for (const auto& [name, change] : kParts) {
    engine::RodExperimentOptions changed = options;
    change(changed);
    print_instructed(name, engine::run_instructed_rods(changed, seed));
  }
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
  std::puts(
      "\nFarthest head of a rod at the first try, and how many rods are within 1.0 mm:\n\n"
      "| instructions | possible for | as touched, mm | within | true, mm | within | expected "
      "| right length | time, s, 95 % |\n|---|---|---|---|---|---|---|---|---|");
  print_instructed("as designed", told);
  if (arguments.parts) {
    print_parts(options, arguments.seed);
  }
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
  rods->add_flag("--parts", arguments->parts,
                 "Also with each part of the instructions left out or changed");
  rods->callback([arguments, &action] { action = [arguments] { return run_rods(*arguments); }; });
}

}  // namespace orthonav::tools

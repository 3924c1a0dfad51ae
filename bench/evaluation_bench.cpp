// Screws and wires in computed post-operative scans, found again: errors against the truth, and
// grades.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "bench/evaluation_errors.h"
#include "engine/case/case_file.h"
#include "engine/evaluation/evaluation.h"
#include "tests/support/operated_spine.h"
#include "tests/support/test_data.h"
#include "tests/support/voxelised_scan.h"

namespace {

using namespace orthonav;

struct Arguments {
  int scans = 50;
  std::uint64_t seed = 1;
  std::vector<double> slices_mm{0.6, 1.0, 2.0};
  std::vector<std::string> cases{"visible-human", "shape-mean", "morph-a", "morph-b"};
  double streaks = 1.0;
  double bow_mm = 0.0;
  double missing = 0.0;
  bool wires = false;
  bool rods = false;
  bool each = false;
};

/// Two levels one above the other of one of the cases.
engine::Case two_levels(const std::vector<engine::Case>& cases, Random& random) {
  const engine::Case& from =
      cases[static_cast<std::size_t>(random.uniform() * static_cast<double>(cases.size()))];
  const auto first =
      static_cast<std::size_t>(random.uniform() * static_cast<double>(from.levels.size() - 1));
  return {from.name, from.folder, {from.levels[first], from.levels[first + 1]}};
}

/// Evaluates a scan and adds its errors.
void add_scan(const engine::Case& subject, const test::OperatedSpine& spine,
              const engine::Volume& scan, std::uint64_t seed, const Arguments& arguments,
              Errors& errors) {
  const Stopwatch watch;
  const auto found = engine::evaluate(subject, scan);
  errors.seconds += watch.elapsed_ms() * 1e-3 / arguments.scans;
  if (found) {
    compare(spine, subject, *found, arguments.each, errors);
    return;
  }
  std::printf("seed %llu refused: %s\n", static_cast<unsigned long long>(seed),
              found.error().message.c_str());
  ++errors.failed_scans;
  for (const test::TrueScrew& screw : spine.screws) {
    errors.screws += screw.placed ? 1 : 0;
    errors.missed += screw.placed ? 1 : 0;
  }
}

/// One operation, scanned with slices of each thickness.
void add_operation(const engine::Case& subject, std::uint64_t seed, Random& random,
                   const Arguments& arguments, std::vector<Errors>& all) {
  test::OperationSettings settings;
  settings.wires = arguments.wires;
  settings.bow_m = arguments.bow_mm * 1e-3;
  settings.rods = arguments.rods;
  settings.missing = arguments.missing;
  const auto spine = test::operated(subject, settings, random.fork("operation"));
  test::BodySettings body_settings;
  body_settings.seed = random.next();
  const test::FineBody body = test::fine_body(spine.bones, spine.metal, body_settings);
  for (std::size_t i = 0; i < all.size(); ++i) {
    test::ScannerSettings scanner;
    scanner.spacing_m.z = arguments.slices_mm[i] * 1e-3;
    scanner.streaks = arguments.streaks;
    scanner.seed = random.next();
    const engine::Volume scan = test::scanned(body, scanner);
    if (arguments.each) {
      std::printf("seed %llu, %s %s, %.1f mm\n", static_cast<unsigned long long>(seed),
                  subject.name.c_str(), subject.levels[0].label.c_str(), arguments.slices_mm[i]);
    }
    add_scan(subject, spine, scan, seed, arguments, all[i]);
    std::fflush(stdout);
  }
}

Result<std::vector<engine::Case>> loaded_cases(const std::vector<std::string>& names) {
  std::vector<engine::Case> cases;
  for (const std::string& name : names) {
    auto loaded = engine::load_case(test::test_data("anatomy/" + name).string());
    if (!loaded) {
      return loaded.error();
    }
    cases.push_back(std::move(*loaded));
  }
  return cases;
}

int run(const Arguments& arguments) {
  const auto cases = loaded_cases(arguments.cases);
  if (!cases) {
    std::fprintf(stderr, "%s\n", cases.error().message.c_str());
    return 2;
  }
  std::vector<Errors> all(arguments.slices_mm.size());
  for (int n = 0; n < arguments.scans; ++n) {
    const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(n);
    Random random(seed);
    const engine::Case subject = two_levels(*cases, random);
    add_operation(subject, seed, random, arguments, all);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    print(all[i], arguments.slices_mm[i]);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Errors of orthonav evaluate on computed scans of real anatomy");
  app.add_option("--scans", arguments.scans, "operations, two vertebrae and four screws each");
  app.add_option("--seed", arguments.seed, "of the first");
  app.add_option("--slices-mm", arguments.slices_mm)->delimiter(',');
  app.add_option("--cases", arguments.cases, "folders of tests/data/anatomy or ../shared/anatomy")
      ->delimiter(',');
  app.add_option("--streaks", arguments.streaks);
  app.add_option("--bow-mm", arguments.bow_mm, "of wires");
  app.add_option("--missing", arguments.missing, "share of screws that are not there");
  app.add_flag("--wires", arguments.wires);
  app.add_flag("--rods", arguments.rods);
  app.add_flag("--each", arguments.each, "a line for each screw");
  CLI11_PARSE(app, argc, argv);
  return run(arguments);
}

// Methods of registration on the same strokes over real vertebrae: how often the screws' entries
// and targets end up within 2 mm, what is accepted, how honest the predicted errors are, times.
//   bench_registration [--summary] [--seeds N] [--variants full,...] [--methods paper,...]
#include <sys/resource.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/registration_asymmetry.h"
#include "bench/registration_levels.h"
#include "bench/registration_runs.h"
#include "bench/registration_tables.h"

namespace orthonav::bench {
namespace {

struct Arguments {
  LevelOptions level;
  std::vector<std::string> variants;
  std::vector<std::string> methods;
  RunOptions run;
  std::vector<std::string> tissues{"smooth"};
  std::vector<double> tissues_mm{0.0};
  double common_mm = 0.0;
  double segmented_mm = 0.0;
  double voxel_mm = 0.0;
  double jitter_mm = 0.0;
  double asymmetric_mm = 0.5;
  bool wrong_level = false;
  bool summary = false;
  bool each = false;
};

void print_costs(const std::vector<BenchLevel>& levels) {
  double slowest_ms = 0.0;
  for (const BenchLevel& level : levels) {
    slowest_ms = std::max(slowest_ms, level.prepare_ms);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "\nPreprocessing of the slowest of %zu levels: %.0f ms. Memory at most, all levels "
      "and methods together: %.0f MB.\n",
      levels.size(), slowest_ms, static_cast<double>(usage.ru_maxrss) / 1024.0);
}

/// One row of the summary for each kind and thickness of tissue.
void summarize(const std::vector<BenchLevel>& levels,
               const std::vector<RegistrationMethod>& methods, const Arguments& arguments) {
  print_summary_head();
  for (const double mm : arguments.tissues_mm) {
    for (const test::Tissue tissue : test::kTissues) {
      const bool any = mm == 0.0 && tissue == test::kTissues[0];
      if (!any && (mm == 0.0 || !chosen(arguments.tissues, test::name_of(tissue)))) {
        continue;
      }
      RunOptions run = arguments.run;
      run.truths.tissue = tissue;
      run.truths.mean_tissue_m = 1e-3 * mm;
      char truth[32];
      std::snprintf(truth, sizeof truth, "%.1f mm %s", mm, any ? "(bare)" : test::name_of(tissue));
      print_summary(truth, measure(levels, methods, run), methods, run.variants);
    }
  }
}

/// The same, separately for bones that are their own mirror image and for others.
void summarize_mirrored(const std::vector<BenchLevel>& levels,
                        const std::vector<RegistrationMethod>& methods,
                        const Arguments& arguments) {
  std::vector<BenchLevel> alike;
  std::vector<BenchLevel> asymmetric;
  for (const BenchLevel& level : levels) {
    const double off_mm = 1e3 * asymmetry_m(*level.model);
    std::printf("%s: %.2f mm from its best mirror image\n", level.name().c_str(), off_mm);
    (off_mm < arguments.asymmetric_mm ? alike : asymmetric).push_back(level);
  }
  std::printf("\n");
  print_summary_head();
  print_summary("nearly its own mirror image", measure(alike, methods, arguments.run), methods,
                arguments.run.variants);
  print_summary("asymmetric", measure(asymmetric, methods, arguments.run), methods,
                arguments.run.variants);
}

void print_tables(const std::vector<BenchLevel>& levels,
                  const std::vector<RegistrationMethod>& methods, const Arguments& arguments) {
  const std::vector<Run> runs = measure(levels, methods, arguments.run);
  if (arguments.each) {
    print_each(runs, methods);
    std::printf("\n");
  }
  print_success(runs, methods, arguments.run.variants);
  if (methods.size() > 1) {
    std::printf("\n");
    print_against_first(runs, methods, arguments.run.variants);
  }
  std::printf("\n");
  print_honesty(runs, methods, arguments.run.variants);
  print_costs(levels);
}

int measured(Arguments& arguments) {
  for (const test::Tissue tissue : test::kTissues) {
    if (arguments.tissues[0] == test::name_of(tissue)) {
      arguments.run.truths.tissue = tissue;
    }
  }
  arguments.run.truths.mean_tissue_m = 1e-3 * arguments.tissues_mm[0];
  arguments.run.truths.common_sd_m = 1e-3 * arguments.common_mm;
  arguments.run.truths.copy_jitter_m = 1e-3 * arguments.jitter_mm;
  arguments.level.segmented_m = 1e-3 * arguments.segmented_mm;
  arguments.level.voxel_m = 1e-3 * arguments.voxel_mm;
  const auto levels = load_levels(arguments.level);
  if (!levels) {
    std::fprintf(stderr, "bench_registration: %s\n", levels.error().message.c_str());
    return 2;
  }
  std::vector<RegistrationMethod> methods = registration_methods(1e-3 * arguments.common_mm);
  std::erase_if(methods, [&](const auto& m) { return !chosen(arguments.methods, m.name); });
  for (const auto variant : test::kStrokeVariants) {
    if (chosen(arguments.variants, test::name_of(variant))) {
      arguments.run.variants.push_back(variant);
    }
  }
  if (methods.empty() || arguments.run.variants.empty()) {
    std::fprintf(stderr, "bench_registration: no such method or variant in this build\n");
    return 2;
  }
  if (arguments.wrong_level) {
    print_wrong_levels(measure_wrong_levels(*levels, methods, arguments.run), methods,
                       arguments.run.variants);
  } else if (arguments.summary && arguments.level.mirrored) {
    summarize_mirrored(*levels, methods, arguments);
  } else if (arguments.summary) {
    summarize(*levels, methods, arguments);
  } else {
    print_tables(*levels, methods, arguments);
  }
  return 0;
}

void add_truths(CLI::App& app, Arguments& arguments) {
  app.add_option("--tissue", arguments.tissues,
                 "uniform, smooth, areas, strokes or valleys; several with --summary")
      ->delimiter(',');
  app.add_option("--tissue-mm", arguments.tissues_mm, "mean thickness of soft tissue")
      ->delimiter(',');
  app.add_option("--common-mm", arguments.common_mm,
                 "SD along an axis of a shift that all points share");
  app.add_option("--copies", arguments.run.truths.copies, "of every point");
  app.add_option("--jitter-mm", arguments.jitter_mm, "SD of a copy's place about the point's");
  app.add_flag("--shuffled", arguments.run.truths.shuffled, "points in any order");
  app.add_flag("--left-handed", arguments.run.truths.left_handed,
               "points of a left-handed frame: any that are accepted fail silently");
  app.add_option("--segmented-mm", arguments.segmented_mm, "SD of the model's own error");
  app.add_option("--voxel-mm", arguments.voxel_mm,
                 "the model is made from a label of such voxels, as by case make");
  app.add_option("--scale", arguments.level.scale, "size of the model, of the bone's");
  app.add_flag("--mirrored", arguments.level.mirrored, "the model is the bone's mirror image");
  app.add_option("--asymmetric-mm", arguments.asymmetric_mm,
                 "from its best mirror image; a bone that is off by more is asymmetric");
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Arguments arguments;
  arguments.level.anatomy = ORTHONAV_SHARED_DIR "/anatomy";
  CLI::App app{"Methods of registration on the same strokes over real vertebrae."};
  app.add_option("--seeds", arguments.run.seeds, "strokes a level and variant")
      ->check(CLI::Range(1, 1000));
  app.add_option("--first-seed", arguments.run.first_seed, "others follow it")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--variants", arguments.variants, "full, partial, noisy, outliers, sparse")
      ->delimiter(',');
  app.add_option("--methods", arguments.methods, "the first is what others are held against")
      ->delimiter(',');
  app.add_option("--levels", arguments.level.levels, "such as visible-human/L4")->delimiter(',');
  app.add_option("--anatomy", arguments.level.anatomy, "folder of case folders");
  app.add_option(
         "--deep", arguments.run.deepest_aside,
         "how deep beside the canal the strokes go, as a share of its depth (1.1); from 1 on "
         "over what trimming cuts off")
      ->check(CLI::Range(0.3, 1.5));
  app.add_option("--jobs", arguments.run.jobs, "levels beside each other")
      ->check(CLI::Range(1, 64));
  orthonav::bench::add_truths(app, arguments);
  app.add_flag("--wrong-level", arguments.wrong_level,
               "strokes fitted to every other level of the case");
  app.add_flag("--alone", arguments.level.alone, "no other levels of the case are known");
  app.add_flag("--summary", arguments.summary, "a row a truth, with intervals");
  app.add_flag("--each", arguments.each, "a line a run as well");
  CLI11_PARSE(app, argc, argv);
  return orthonav::bench::measured(arguments);
}

// Methods of registration on the same strokes over real vertebrae: how often the screws' entries
// and targets end up within 2 mm, what is accepted, how honest the predicted errors are, times.
//   bench_registration [--seeds N] [--variants full,...] [--methods paper,...] [--wrong-level]
#include <sys/resource.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "base/stopwatch.h"
#include "bench/registration_methods.h"
#include "bench/registration_runs.h"
#include "bench/registration_tables.h"
#include "engine/case/case_file.h"

namespace orthonav::bench {
namespace {

struct Arguments {
  std::string anatomy = ORTHONAV_SHARED_DIR "/anatomy";
  std::vector<std::string> levels;
  std::vector<std::string> variants;
  std::vector<std::string> methods;
  RunOptions run;
  std::string tissue = "smooth";
  double tissue_mm = 0.0;
  double common_mm = 0.0;
  double segmented_mm = 0.0;
  double scale = 1.0;
  bool mirrored = false;
  bool wrong_level = false;
  bool alone = false;
  bool each = false;
};

bool chosen(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

/// The bone as the model has it.
nav::TriangleMesh modelled(nav::TriangleMesh mesh, const Arguments& arguments) {
  if (arguments.segmented_mm > 0.0) {
    mesh = test::segmented(mesh, 1e-3 * arguments.segmented_mm, 1);
  }
  mesh = test::scaled(mesh, arguments.scale);
  return arguments.mirrored ? test::mirrored(mesh) : mesh;
}

Result<std::vector<BenchLevel>> load_levels(const Arguments& arguments) {
  std::vector<std::string> folders;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(arguments.anatomy, error)) {
    if (std::filesystem::exists(entry.path() / "case.json", error)) {
      folders.push_back(entry.path().string());
    }
  }
  std::sort(folders.begin(), folders.end());
  std::vector<BenchLevel> levels;
  for (const std::string& folder : folders) {
    const auto source = engine::load_case(folder);
    if (!source) {
      return source.error();
    }
    for (const engine::CaseLevel& from : source->levels) {
      BenchLevel level{std::filesystem::path(folder).filename().string(), from.label, from.mesh,
                       from.screws};
      if (!chosen(arguments.levels, level.name())) {
        continue;
      }
      const Stopwatch watch;
      auto model = nav::VertebraModel::prepare(modelled(from.mesh, arguments));
      const double prepare_ms = watch.elapsed_ms();
      if (!model) {
        return model.error();
      }
      level.model = *model;
      level.prepare_ms = prepare_ms;
      levels.push_back(std::move(level));
    }
  }
  for (std::size_t i = 0; i < levels.size() && !arguments.alone; ++i) {
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (levels[i].case_name == levels[k].case_name && (k + 1 == i || i + 1 == k)) {
        levels[i].neighbours.push_back({levels[k].label, levels[k].model.get()});
      }
    }
  }
  if (levels.empty()) {
    return Error{"no level of a case is found in " + arguments.anatomy};
  }
  return levels;
}

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

int measured(Arguments& arguments) {
  for (const test::Tissue tissue : test::kTissues) {
    if (arguments.tissue == test::name_of(tissue)) {
      arguments.run.truths.tissue = tissue;
    }
  }
  arguments.run.truths.mean_tissue_m = 1e-3 * arguments.tissue_mm;
  arguments.run.truths.common_sd_m = 1e-3 * arguments.common_mm;
  const auto levels = load_levels(arguments);
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
    return 0;
  }
  const std::vector<Run> runs = measure(*levels, methods, arguments.run);
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
  print_costs(*levels);
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Arguments arguments;
  CLI::App app{"Methods of registration on the same strokes over real vertebrae."};
  app.add_option("--seeds", arguments.run.seeds, "strokes a level and variant")
      ->check(CLI::Range(1, 1000));
  app.add_option("--variants", arguments.variants, "full, partial, noisy, outliers, sparse")
      ->delimiter(',');
  app.add_option("--methods", arguments.methods, "the first is what others are held against")
      ->delimiter(',');
  app.add_option("--levels", arguments.levels, "such as visible-human/L4")->delimiter(',');
  app.add_option("--anatomy", arguments.anatomy, "folder of case folders");
  app.add_option(
         "--deep", arguments.run.deepest_aside,
         "how deep beside the canal the strokes go, as a share of its depth (1.1); from 1 on "
         "over what trimming cuts off")
      ->check(CLI::Range(0.3, 1.5));
  app.add_option("--jobs", arguments.run.jobs, "levels beside each other")
      ->check(CLI::Range(1, 64));
  app.add_option("--tissue", arguments.tissue, "uniform, smooth, areas, strokes or valleys");
  app.add_option("--tissue-mm", arguments.tissue_mm, "mean thickness of soft tissue");
  app.add_option("--common-mm", arguments.common_mm,
                 "SD along an axis of a shift that all points share");
  app.add_option("--copies", arguments.run.truths.copies, "of every point");
  app.add_option("--segmented-mm", arguments.segmented_mm, "SD of the model's own error");
  app.add_option("--scale", arguments.scale, "size of the model, of the bone's");
  app.add_flag("--mirrored", arguments.mirrored, "the model is the bone's mirror image");
  app.add_flag("--wrong-level", arguments.wrong_level, "strokes fitted to the neighbouring levels");
  app.add_flag("--alone", arguments.alone,
               "one registration is timed, none of the levels beside are tried");
  app.add_flag("--each", arguments.each, "a line a run as well");
  CLI11_PARSE(app, argc, argv);
  return orthonav::bench::measured(arguments);
}

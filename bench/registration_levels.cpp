#include "bench/registration_levels.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/stopwatch.h"
#include "engine/case/case_file.h"
#include "engine/scan/label_surface.h"
#include "tests/engine/scan/voxelised.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::bench {
namespace {

/// The surface that `case make` finds in a label of the bone.
Result<nav::TriangleMesh> from_label(const nav::TriangleMesh& mesh, double voxel_m) {
  const engine::Volume labels = test::voxelised(mesh, {voxel_m, voxel_m, voxel_m});
  const auto part = engine::label_part(labels, {"bone", 0, 1}, engine::kSurfaceMargin);
  if (!part) {
    return part.error();
  }
  auto surface = engine::label_surface(*part);
  return surface ? Result<nav::TriangleMesh>(std::move(surface->mesh)) : surface.error();
}

/// The model of the bone, with the errors asked for.
Result<nav::TriangleMesh> modelled(nav::TriangleMesh mesh, const LevelOptions& options) {
  if (options.voxel_m > 0.0) {
    auto made = from_label(mesh, options.voxel_m);
    if (!made) {
      return made.error();
    }
    mesh = std::move(*made);
  }
  if (options.segmented_m > 0.0) {
    mesh = test::segmented(mesh, options.segmented_m, 1);
  }
  mesh = test::scaled(mesh, options.scale);
  return options.mirrored ? test::mirrored(mesh) : mesh;
}

std::vector<std::string> case_folders(const std::string& anatomy) {
  std::vector<std::string> folders;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(anatomy, error)) {
    if (std::filesystem::exists(entry.path() / "case.json", error)) {
      folders.push_back(entry.path().string());
    }
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

void introduce(std::vector<BenchLevel>& levels) {
  for (BenchLevel& level : levels) {
    for (const BenchLevel& other : levels) {
      if (level.case_name == other.case_name && &level != &other) {
        level.neighbours.push_back({other.label, other.model.get()});
      }
    }
  }
}

}  // namespace

bool chosen(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

Result<std::vector<BenchLevel>> load_levels(const LevelOptions& options) {
  std::vector<BenchLevel> levels;
  for (const std::string& folder : case_folders(options.anatomy)) {
    const auto source = engine::load_case(folder);
    if (!source) {
      return source.error();
    }
    for (const engine::CaseLevel& from : source->levels) {
      BenchLevel level;
      level.case_name = std::filesystem::path(folder).filename().string();
      level.label = from.label;
      if (!chosen(options.levels, level.name())) {
        continue;
      }
      level.mesh = from.mesh;
      level.screws = from.screws;
      const Stopwatch watch;
      auto mesh = modelled(from.mesh, options);
      if (!mesh) {
        return Error{level.name() + ": " + mesh.error().message};
      }
      auto model = nav::VertebraModel::prepare(std::move(*mesh));
      level.prepare_ms = watch.elapsed_ms();
      if (!model) {
        return model.error();
      }
      level.model = *model;
      levels.push_back(std::move(level));
    }
  }
  if (levels.empty()) {
    return Error{"no level of a case is found in " + options.anatomy};
  }
  if (!options.alone) {
    introduce(levels);
  }
  return levels;
}

}  // namespace orthonav::bench

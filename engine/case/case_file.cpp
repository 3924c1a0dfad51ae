#include "engine/case/case_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/joined.h"
#include "base/length_text.h"
#include "engine/case/likely_mistakes.h"
#include "engine/case/operation.h"
#include "engine/io/inside_folder.h"
#include "engine/io/json_document.h"
#include "engine/io/json_pose.h"
#include "engine/io/mesh_file.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

/// Height of a lumbar body and its disc (Panjabi et al. 1992: 24-27 mm; discs about 10 mm).
constexpr double kStackSpacing_m = 0.037;

void stack_if_they_overlap(Case& subject) {
  bool overlap = false;
  for (std::size_t i = 0; i < subject.levels.size(); ++i) {
    overlap = overlap || subject.overlapped_by(i) != nullptr;
  }
  if (!overlap) {
    return;
  }
  for (std::size_t i = 0; i < subject.levels.size(); ++i) {
    CaseLevel& level = subject.levels[i];
    const Vec3 place{0, 0, -kStackSpacing_m * static_cast<double>(i)};
    level.spine_from_vertebra = {Mat3::identity(), place - nav::bounds_of(level.mesh).centre()};
  }
}

/// The matrix of one level in metres and LPS; problems are noted on the node.
Transform<Spine, Vertebra> spine_from_model(const JsonNode& node, double metres_per_unit,
                                            Axes axes) {
  std::array<double, 16> rows = pose_rows(node, "spine_from_model", metres_per_unit);
  if (axes == Axes::kRas) {
    // Both sides turn half round z: F·M·F with F = diag(-1, -1, 1).
    for (const std::size_t i : {2u, 3u, 6u, 7u, 8u, 9u}) {
      rows[i] = -rows[i];
    }
  }
  return rigid_pose<Spine, Vertebra>(node, "spine_from_model", rows);
}

/// From a transform file in the case's folder: 3D Slicer displays the model below that transform.
Result<Transform<Spine, Vertebra>> spine_from_model_file(const std::string& folder,
                                                         const std::string& name,
                                                         const TransformReader& transforms) {
  const auto path = path_inside(folder, name);
  if (!path) {
    return path.error();
  }
  const auto stored = transforms(*path);
  if (!stored) {
    return stored.error();
  }
  auto pose = parent_from_node<Spine, Vertebra>(*stored);
  return pose ? pose : Error{*path + ": " + pose.error().message};
}

/// Metres per unit of the case's own numbers; problems are noted on the node.
std::optional<double> declared_metres_per_unit(const JsonNode& root) {
  const std::string units = root.text_or("units", "mm");
  const auto metres_per_unit = metres_per_unit_from(units);
  if (!metres_per_unit) {
    root.refuse("units", "is \"" + units + "\", must be mm or m");
  }
  return metres_per_unit;
}

/// What case.json says of one level.
struct Entry {
  std::string label;
  std::string model;
  std::vector<std::string> plans;  ///< files that make one plan; none: no plan
  JsonNode node;
};

std::vector<Entry> entries_of(const JsonNode& root) {
  std::vector<Entry> entries;
  for (const JsonNode& node : root.list("levels")) {
    entries.push_back({node.text("label"), node.text("model"),
                       node.has("plan") ? node.text_or_texts("plan") : std::vector<std::string>(),
                       node});
  }
  return entries;
}

/// A level without a plan has no screws, and a model in the case's unit.
Result<Plan> plan_of(const Entry& entry, const std::string& folder, double metres_per_unit) {
  if (entry.plans.empty()) {
    return Plan{{}, Axes::kLps, metres_per_unit, {}};
  }
  std::vector<std::string> paths;
  for (const std::string& plan : entry.plans) {
    const auto path = path_inside(folder, plan);
    if (!path) {
      return path.error();
    }
    paths.push_back(*path);
  }
  return load_plan(paths);
}

/// What all levels are read with.
struct Reading {
  const std::string& folder;
  double metres_per_unit;
  const TransformReader& transforms;
};

/// Puts the level where the entry says, if it does.
Status place(const Entry& entry, const Reading& reading, Axes model_axes, CaseLevel& level) {
  if (!entry.node.has("spine_from_model")) {
    return {};
  }
  if (!entry.node.is_text("spine_from_model")) {
    level.spine_from_vertebra = spine_from_model(entry.node, reading.metres_per_unit, model_axes);
    return {};
  }
  const auto pose = spine_from_model_file(reading.folder, entry.node.text("spine_from_model"),
                                          reading.transforms);
  if (!pose) {
    return pose.error();
  }
  level.spine_from_vertebra = *pose;
  return {};
}

Result<CaseLevel> loaded(const Entry& entry, const Reading& reading, std::string& note) {
  const std::string& folder = reading.folder;
  const Result<Plan> plan = plan_of(entry, folder, reading.metres_per_unit);
  if (!plan) {
    return plan.error();
  }
  if (!plan->level.empty() && plan->level != entry.label) {
    return Error{(fs::path(folder) / entry.plans.front()).string() + ": is the plan of " +
                 plan->level + ", the case uses it for " + entry.label};
  }
  const std::string operated = level_in_name(entry.label);
  for (const std::string& file : entry.plans) {
    const std::string named = level_in_name(file);
    if (plan->level.empty() && !operated.empty() && !named.empty() && named != operated) {
      return Error{(fs::path(folder) / file).string() + ": is named after " + named +
                   " and states no level, but the case uses it for " + entry.label +
                   " (\"level\" in the plan decides)"};
    }
  }
  const auto model = path_inside(folder, entry.model);
  if (!model) {
    return model.error();
  }
  Result<CaseLevel> level = load_level(*model, *plan, &note);
  if (!level) {
    return level.error();
  }
  level->label = entry.label;
  const Axes axes = declared_axes(*model).value_or(plan->axes);
  if (Status s = place(entry, reading, axes, *level); !s) {
    return s.error();
  }
  return level;
}

Status load_levels(const std::vector<Entry>& entries, const Reading& reading, Case& subject) {
  for (const Entry& entry : entries) {
    std::string note;
    Result<CaseLevel> level = loaded(entry, reading, note);
    if (!level) {
      return level.error();
    }
    if (!note.empty()) {
      subject.notes.push_back(note);
    }
    subject.levels.push_back(std::move(level).value());
  }
  return {};
}

}  // namespace

Result<CaseLevel> load_level(const std::string& model, const Plan& plan, std::string* note) {
  Result<nav::TriangleMesh> mesh = load_mesh(model, plan.metres_per_unit, plan.axes, note);
  if (!mesh) {
    return mesh.error();
  }
  CaseLevel level{plan.level, std::move(mesh).value(), {}, {}};
  if (plan.screws.empty()) {
    return level;
  }
  auto screws = screws_on(level.mesh, plan);
  if (!screws) {
    return screws.error();
  }
  level.screws = std::move(screws).value();
  return level;
}

Result<Case> load_case(const std::string& folder, CaseUse use, const TransformReader& transforms) {
  const auto file = path_inside(folder, "case.json");
  if (!file) {
    return file.error();
  }
  const std::string& path = *file;
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  Case subject;
  subject.folder = folder;
  subject.name = root.text_or("name", fs::path(folder).filename().string());
  subject.unusual = root.text_or("unusual", "");
  const auto metres_per_unit = declared_metres_per_unit(root);
  const std::vector<Entry> entries = entries_of(root);
  const auto placed = static_cast<std::size_t>(
      std::count_if(entries.begin(), entries.end(),
                    [](const Entry& entry) { return entry.node.has("spine_from_model"); }));
  if (placed != 0 && placed != entries.size()) {
    root.refuse("levels", "must have spine_from_model in all levels or in none");
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  if (Status status = load_levels(entries, {folder, *metres_per_unit, transforms}, subject);
      !status) {
    return status.error();
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  if (placed == 0) {
    stack_if_they_overlap(subject);
  }
  if (const auto problems = subject.check(use); !problems.empty()) {
    return Error{path + ": " + joined(problems)};
  }
  return subject;
}

}  // namespace orthonav::engine

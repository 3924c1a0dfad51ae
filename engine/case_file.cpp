#include "engine/case_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "engine/json_document.h"
#include "engine/length_text.h"
#include "engine/mesh_file.h"
#include "engine/operation.h"
#include "engine/plan_file.h"
#include "hal/api/joined.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxEntryOffBone_m = 0.010;
/// A tip may stand out of the front by its radius, or by this where the plan states less.
constexpr double kMinTargetOutside_m = 0.003;
/// Centres of neighbouring lumbar vertebrae lie 30 mm and more apart; closer ones intersect.
constexpr double kMinLevelSpacing_m = 0.015;
/// Height of a lumbar body and its disc (Panjabi et al. 1992: 24-27 mm; discs about 10 mm).
constexpr double kStackSpacing_m = 0.037;

/// The label of a level that lies in this one; nullptr when it has its place for itself.
const CaseLevel* overlapped_by(const Case& subject, std::size_t index) {
  const Point<Spine> centre = subject.levels[index].centre_in_spine();
  for (std::size_t i = 0; i < index; ++i)
    if ((subject.levels[i].centre_in_spine() - centre).norm() < kMinLevelSpacing_m)
      return &subject.levels[i];
  return nullptr;
}

void stack_if_they_overlap(Case& subject) {
  bool overlap = false;
  for (std::size_t i = 0; i < subject.levels.size(); ++i)
    overlap = overlap || overlapped_by(subject, i) != nullptr;
  if (!overlap) return;
  for (std::size_t i = 0; i < subject.levels.size(); ++i) {
    CaseLevel& level = subject.levels[i];
    const Vec3 place{0, 0, -kStackSpacing_m * static_cast<double>(i)};
    level.spine_from_vertebra = {Mat3::identity(), place - nav::bounds_of(level.mesh).centre()};
  }
}

/// The matrix of one level in metres and LPS; the node notes what is wrong with it.
Transform<Spine, Vertebra> spine_from_model(const JsonNode& node, double metres_per_unit,
                                            Axes axes) {
  constexpr double kMaxShear = 1e-3;
  const std::vector<double> numbers = node.numbers("spine_from_model", 16);
  std::array<double, 16> a{};
  std::copy(numbers.begin(), numbers.end(), a.begin());
  for (const std::size_t i : {3u, 7u, 11u}) a[i] *= metres_per_unit;
  if (axes == Axes::kRas) {
    // Both sides turn half round z: F·M·F with F = diag(-1, -1, 1).
    for (const std::size_t i : {2u, 3u, 6u, 7u, 8u, 9u}) a[i] = -a[i];
  }
  const bool affine = a[12] == 0 && a[13] == 0 && a[14] == 0 && a[15] == 1;
  if (!affine) node.refuse("spine_from_model", "must end with the row 0 0 0 1");
  const auto transform = Transform<Spine, Vertebra>::from_row_major(a, kMaxShear);
  if (transform) return *transform;
  node.refuse("spine_from_model", transform.error().message);
  return {};
}

/// What case.json says of one level.
struct Entry {
  std::string label;
  std::string model;
  std::string plan;
  JsonNode node;
};

Result<CaseLevel> loaded(const Entry& entry, const std::string& folder, double metres_per_unit) {
  const Result<Plan> plan = load_plan((fs::path(folder) / entry.plan).string());
  if (!plan) return plan.error();
  if (!plan->level.empty() && plan->level != entry.label)
    return Error{(fs::path(folder) / entry.plan).string() + ": is the plan of " + plan->level +
                 ", the case uses it for " + entry.label};
  const std::string model = (fs::path(folder) / entry.model).string();
  Result<nav::TriangleMesh> mesh = load_mesh(model, plan->metres_per_unit, plan->axes);
  if (!mesh) return mesh.error();
  CaseLevel level{entry.label, std::move(mesh).value(), plan->screws, {}};
  if (entry.node.has("spine_from_model"))
    level.spine_from_vertebra =
        spine_from_model(entry.node, metres_per_unit, declared_axes(model).value_or(plan->axes));
  return level;
}

Status load_levels(const std::vector<Entry>& entries, double metres_per_unit, Case& subject) {
  for (const Entry& entry : entries) {
    Result<CaseLevel> level = loaded(entry, subject.folder, metres_per_unit);
    if (!level) return level.error();
    subject.levels.push_back(std::move(level).value());
  }
  return {};
}

/// What tells that a screw is not of this bone, or is written in other axes; +x left, +y posterior.
std::optional<std::string> screw_problem(const nav::SurfaceIndex& bone, double middle_x_m,
                                         const nav::ScrewPlan& screw) {
  const std::string which = name_of(screw.side);
  const auto at_entry = bone.nearest(screw.entry.v);
  const double off_m = at_entry ? at_entry->distance_m : 1e3;
  if (off_m > kMaxEntryOffBone_m)
    return which + " entry lies " + in_mm(off_m) + " off the bone, limit " +
           in_mm(kMaxEntryOffBone_m);
  const double behind_m = screw.entry.v.y - screw.target.v.y;
  if (!(behind_m > 0.0))
    return which + " entry lies " + in_mm(-behind_m) +
           " in front of its target, must lie behind it (posterior)";
  const auto at_target = bone.nearest(screw.target.v);
  const double outside_m =
      bone.contains(screw.target.v) || !at_target ? 0.0 : at_target->distance_m;
  const double limit_m = std::max(screw.radius_m, kMinTargetOutside_m);
  if (outside_m > limit_m)
    return which + " target lies " + in_mm(outside_m) + " outside the bone, limit " +
           in_mm(limit_m);
  const double left_m = screw.entry.v.x - middle_x_m;
  const bool there = screw.side == nav::Side::kLeft ? left_m > 0.0 : left_m < 0.0;
  if (!there)
    return which + " entry lies " + in_mm(std::abs(left_m)) + " to the " +
           (left_m > 0.0 ? "left" : "right") + " of the bone's middle, must lie to the " + which;
  return std::nullopt;
}

}  // namespace

Point<Spine> CaseLevel::centre_in_spine() const {
  return spine_from_vertebra * Point<Vertebra>{nav::bounds_of(mesh).centre()};
}

const CaseLevel* Case::find(const std::string& label) const {
  const auto found = std::find_if(levels.begin(), levels.end(),
                                  [&](const CaseLevel& level) { return level.label == label; });
  return found == levels.end() ? nullptr : &*found;
}

std::vector<std::string> Case::check() const {
  std::vector<std::string> problems;
  if (levels.empty()) problems.push_back("levels is empty");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const CaseLevel& level = levels[i];
    const std::string which =
        level.label.empty() ? "levels[" + std::to_string(i) + "]" : level.label;
    if (level.label.empty()) problems.push_back(which + " has no label");
    if (!level.label.empty() && find(level.label) != &level)
      problems.push_back("label " + level.label + " stands twice");
    if (level.screws.empty()) problems.push_back(which + " has no screws");
    if (const CaseLevel* other = overlapped_by(*this, i))
      problems.push_back(which + " lies in " + other->label + " (see spine_from_model)");
    if (level.mesh.triangles.empty()) {
      problems.push_back(which + " has no surface");
      continue;
    }
    const nav::SurfaceIndex bone(level.mesh);
    const double middle_x_m = nav::bounds_of(level.mesh).centre().x;
    for (const nav::ScrewPlan& screw : level.screws)
      if (const auto problem = screw_problem(bone, middle_x_m, screw))
        problems.push_back(which + " " + *problem);
  }
  return problems;
}

Result<Case> load_case(const std::string& folder) {
  const std::string path = (fs::path(folder) / "case.json").string();
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) return document.error();
  const JsonNode root = document->root();
  Case subject;
  subject.folder = folder;
  subject.name = root.text_or("name", fs::path(folder).filename().string());
  const std::string units = root.text_or("units", "mm");
  const auto metres_per_unit = metres_per_unit_from(units);
  if (!metres_per_unit) root.refuse("units", "is \"" + units + "\", must be mm or m");
  std::vector<Entry> entries;
  std::size_t placed = 0;
  for (const JsonNode& node : root.list("levels")) {
    entries.push_back({node.text("label"), node.text("model"), node.text("plan"), node});
    placed += node.has("spine_from_model") ? 1 : 0;
  }
  if (placed != 0 && placed != entries.size())
    root.refuse("levels", "must have spine_from_model in all levels or in none");
  if (Status status = document->status(); !status) return status.error();
  if (Status status = load_levels(entries, *metres_per_unit, subject); !status)
    return status.error();
  if (Status status = document->status(); !status) return status.error();
  if (placed == 0) stack_if_they_overlap(subject);
  if (const auto problems = subject.check(); !problems.empty())
    return Error{path + ": " + joined(problems)};
  return subject;
}

}  // namespace orthonav::engine

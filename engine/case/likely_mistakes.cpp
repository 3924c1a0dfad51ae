#include "engine/case/likely_mistakes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "base/joined.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "engine/case/line_name.h"
#include "engine/io/patient_axes.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/planning/canal.h"

namespace orthonav::engine {
namespace {

bool shows_canal(const nav::TriangleMesh& mesh) {
  return nav::find_canal(mesh, nav::SurfaceIndex(mesh)).has_value();
}

}  // namespace

Result<bool> has_canal(const nav::TriangleMesh& vertebra) {
  if (shows_canal(vertebra)) {
    return true;
  }
  nav::TriangleMesh turned = vertebra;
  for (Vec3& v : turned.vertices_m) {
    v = to_lps(v, Axes::kRas);
  }
  if (shows_canal(turned)) {
    return Error{
        "faces backward: its axes are RAS and not LPS, or LPS and not RAS (--frame, or SPACE= in "
        "the file)"};
  }
  return false;
}

Status check_scale(std::span<const Vec3> points_m, bool unit_stated) {
  constexpr double kLeast_m = 0.001, kMax_m = 10.0;
  if (points_m.size() < 2) {
    return {};
  }
  Vec3 low = points_m[0], high = points_m[0];
  for (const Vec3& p : points_m) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const double across_m = (high - low).norm();
  if (across_m >= kLeast_m && across_m <= kMax_m) {
    return {};
  }
  const bool small = across_m < kLeast_m;
  return Error{printed("its points are %.3g mm across, must be 1 mm to 10 m: are they in %s? ",
                       across_m * 1e3, small ? "metres" : "millimetres") +
               (unit_stated ? "Its unit is stated in the file"
                            : std::string("State it with --units ") + (small ? "m" : "mm"))};
}

std::string level_in_name(const std::string& path) {
  const std::vector<std::string> levels = levels_named(std::filesystem::path(path).filename());
  const std::set<std::string> different(levels.begin(), levels.end());
  return different.size() == 1 ? levels.front() : std::string();
}

std::string poor_fit(const nav::TriangleMesh& vertebra, std::span<const nav::ScrewPlan> screws) {
  // Plans by hand and by search on their own vertebra: within 0.1 mm.
  constexpr double kMaxEntryOff_m = 0.002;
  const nav::SurfaceIndex bone(vertebra);
  std::vector<std::string> problems;
  for (const nav::ScrewPlan& screw : screws) {
    const std::string side = name_of(screw.side);
    const auto at_entry = bone.nearest(screw.entry.v);
    if (at_entry && at_entry->distance_m > kMaxEntryOff_m) {
      const char* where = bone.contains(screw.entry.v) ? " below" : " off";
      problems.push_back(side + " entry " + in_mm(at_entry->distance_m) + where +
                         " the surface, limit " + in_mm(kMaxEntryOff_m));
    }
    const auto cylinder = nav::cylinder_of(screw);
    const auto least = cylinder ? nav::least_clearance(bone, *cylinder) : std::nullopt;
    if (least && least->clearance_m < 0.0 && screw.accepted_breach.empty()) {
      problems.push_back(side + " breaks through the cortex by " + in_mm(-least->clearance_m));
    }
  }
  return joined(problems, "; ");
}

}  // namespace orthonav::engine

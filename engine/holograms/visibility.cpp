#include "engine/holograms/visibility.h"

#include <utility>

#include "engine/holograms/screw_holograms.h"

namespace orthonav::engine {

std::vector<std::string> VisibilityRules::check() const {
  std::vector<std::string> problems = grades.check();
  if (!(triangle_within_m > 0.0 && triangle_within_m <= 1.0)) {
    problems.push_back("triangle_within_m must lie in (0, 1]");
  }
  if (!(rod_moved_away_m >= 0.0 && rod_moved_away_m <= 1.0)) {
    problems.push_back("rod_moved_away_m must lie in [0, 1]");
  }
  return problems;
}

void decide_visibility(const Guidance& g, const VisibilityRules& rules, Timestamp display_time,
                       Visibility& out) {
  std::vector<std::size_t> entries = std::move(out.entries_of);  // keeps its buffer
  entries.clear();
  const LabelSide cross_side = out.cross_side;
  out = {};
  out.entries_of = std::move(entries);
  out.cross_side = cross_side;
  if (g.blank) {
    return;
  }
  // H1: the surgeon still compares the paths with the hologram while he verifies; after acceptance
  // they would only cover the bone.
  out.paths = g.step == Step::kDigitize || g.step == Step::kVerify;
  const LevelState* level = g.level < g.levels.size() ? &g.levels[g.level] : nullptr;
  // H2: what is to be verified, and only that; gone with a rejected registration.
  out.vertebra = g.step == Step::kVerify && level && level->registration.has_value();
  // H12: with the surface that they were touched to check.
  out.check_points = out.vertebra;
  // H3: entry points of everything that may be guided on, never faded by distance. An unaccepted
  // registration shows none: an entry point on display reads as "drill here".
  for (std::size_t i = 0; i < g.levels.size(); ++i) {
    if (g.levels[i].usable()) {
      out.entries_of.push_back(i);
    }
  }
  // Once every screw is in, the names would only cover the rod's lengths.
  out.entry_labels = g.step != Step::kRod && g.step != Step::kDone;
  // H4: of the selected screw; it depends on the registration alone, so a lost tool leaves it.
  out.trajectory =
      g.step == Step::kGuide && level && level->usable() && g.screw < level->plan.screws.size();
  // H5, H6: on a pose younger than the limit at the display time. A frozen
  // triangle is worse than none.
  const bool fresh =
      out.trajectory && g.tool.has_value() && display_time - g.tool->pose_time <= g.stale_after;
  const auto near = [&](const nav::ScrewGuidance& guidance) {
    return guidance.tip_to_entry_m <= rules.triangle_within_m;
  };
  out.triangle = fresh && near(g.tool->measured ? *g.tool->measured : g.tool->shown);
  out.angle = out.triangle && g.tool->measured.has_value();
  // A lost value says so in the place of the number, never with the last number, nor with one that
  // was predicted.
  out.angle_lost = out.trajectory && !out.angle && (out.triangle || !fresh);
  // H7: with the trajectory that it measures against, once it is known where the eyes are. Its dots
  // are numbers in another shape: of one stereo pair, never of a prediction.
  out.cross = out.trajectory && g.head.has_value();
  if (out.cross) {
    out.cross_side = clear_side_of(*level, g.screw, *g.head, cross_side);
  }
  out.cross_dots = out.cross && fresh && g.tool->measured.has_value();
  out.cross_lost = out.cross && !fresh;
  // H8: only where the surgeon asked for it, since it takes his eyes off the patient.
  out.twin = out.trajectory && g.twin;
  // H9: under the angle, and with it.
  out.depth = out.angle;
  // H10: from the first head until the end.
  out.rods = g.step == Step::kRod || g.step == Step::kDone;
}

Vec3 rod_shift_m(const Guidance& guidance, const RodState& rod, const VisibilityRules& rules) {
  if (!guidance.rods_moved_away || !rod.visible()) {
    return {};
  }
  constexpr Vec3 kUp{0, 1, 0};
  const Vec3 along = rod.heads.back() - rod.heads.front();
  Vec3 side = along.cross(kUp);
  if (side.norm() < 1e-6) {
    side = {1, 0, 0};
  }
  // Right-handed: which way `side` points depends on the order of touching, so take the way that
  // leads off the other rod.
  Vec3 centre_of_rods{};
  double count = 0.0;
  for (const RodState& other : guidance.rods) {
    if (!other.visible()) {
      continue;
    }
    for (const Point<World>& head : other.heads) {
      centre_of_rods += head.v;
      count += 1.0;
    }
  }
  const Vec3 outward = rod.heads.front().v - centre_of_rods / count;
  const double sign = outward.dot(side) < 0.0 ? -1.0 : 1.0;
  return side.normalized() * (sign * rules.rod_moved_away_m);
}

}  // namespace orthonav::engine

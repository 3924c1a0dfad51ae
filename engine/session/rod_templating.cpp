#include "engine/session/rod_templating.h"

#include <utility>
#include <vector>

namespace orthonav::engine {

bool rod_planned(std::span<const LevelState> levels, nav::Side side) {
  std::size_t screws = 0;
  for (const LevelState& level : levels) {
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      screws += screw.side == side ? 1 : 0;
    }
  }
  return screws >= 2;
}

RodTemplating::RodTemplating(bool left_planned, bool right_planned)
    : planned_{left_planned, right_planned}, current_(right_planned && !left_planned ? 1 : 0) {
  rods_[0].side = nav::Side::kLeft;
  rods_[1].side = nav::Side::kRight;
}

bool RodTemplating::drop_head() {
  if (rod().heads.empty()) {
    return false;
  }
  rod().heads.pop_back();
  return true;
}

Status RodTemplating::bend(double rod_diameter_m) {
  rod().rod.reset();
  if (rod().heads.size() < 2) {
    return {};
  }
  std::vector<Vec3> heads;
  for (const Point<World>& head : rod().heads) {
    heads.push_back(head.v);
  }
  auto made = nav::rod_template(heads, rod_diameter_m);
  if (!made) {
    return made.error();
  }
  rod().rod = std::move(*made);
  return {};
}

bool RodTemplating::finish() {
  rod().done = true;
  const bool another = current_ + 1 < rods_.size() && planned_[current_ + 1];
  if (another) {
    ++current_;
  }
  return another;
}

void RodTemplating::forget_map() {
  for (RodState& rod : rods_) {
    if (rod.done) {
      rod.map_moved = true;
    } else {
      rod = RodState{.side = rod.side};
    }
  }
  touch_.drop();
}

}  // namespace orthonav::engine

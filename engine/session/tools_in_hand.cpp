#include "engine/session/tools_in_hand.h"

#include <algorithm>

namespace orthonav::engine {

namespace {

constexpr double kNearTheBone_m = 0.05;
constexpr Duration kToldAfter = std::chrono::milliseconds(500);

bool near_the_bone(const LevelState& level, Point<World> tip) {
  const auto tip_in_vertebra = level.registration->world_from_vertebra.inverse() * tip;
  return level.plan.model->surface().nearest(tip_in_vertebra.v, kNearTheBone_m).has_value();
}

bool in_hand(const WatchedTools& tools, std::size_t tool, std::optional<std::size_t> own,
             const LevelState* level) {
  const ToolWatch& watch = tools.watch(tool);
  if (!watch.measured_now()) {
    return false;
  }
  if (level != nullptr && level->registration && !level->map_moved) {
    return near_the_bone(*level, watch.newest().value * tools.geometry(tool).tip_in_marker);
  }
  return own && !tools.watch(*own).measured_now();
}

}  // namespace

void ToolsInHand::look(const WatchedTools& tools, Step step, std::optional<std::size_t> own,
                       const LevelState* level, Timestamp now) {
  seen_.resize(tools.sights().size());
  const bool at_work = step != Step::kSetup && step != Step::kDone;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const bool unused = at_work && !used_in(tools.geometry(i).role, step);
    if (!unused || !in_hand(tools, i, own, level)) {
      seen_[i] = {};
      continue;
    }
    seen_[i].since = seen_[i].since.value_or(now);
    seen_[i].told = now - *seen_[i].since >= kToldAfter;
  }
}

std::optional<std::size_t> ToolsInHand::unused() const {
  const auto found = std::find_if(seen_.begin(), seen_.end(), [](const Seen& s) { return s.told; });
  return found == seen_.end() ? std::nullopt
                              : std::optional(static_cast<std::size_t>(found - seen_.begin()));
}

}  // namespace orthonav::engine

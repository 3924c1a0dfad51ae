#include "hal/openxr/placement.h"

#include <algorithm>
#include <limits>

namespace orthonav::openxr {
namespace {

// No more than these moves are ever announced at the same time.
constexpr std::size_t kKept = 8;

}  // namespace

WorldAnchor::WorldAnchor(Placement placement) : placement_(placement) {
  Stretch first;
  first.from = std::numeric_limits<XrTime>::min();
  if (placement == Placement::kMounted) {
    first.world_from_space = Transform<World, Space>();
  }
  stretches_.push_back(first);
}

const WorldAnchor::Stretch& WorldAnchor::at(XrTime time) const {
  const Stretch* found = &stretches_.front();
  for (const Stretch& stretch : stretches_) {
    if (stretch.from <= time) {
      found = &stretch;
    }
  }
  return *found;
}

std::optional<Transform<World, Space>> WorldAnchor::world_from_space(XrTime time) const {
  return at(time).world_from_space;
}

std::int64_t WorldAnchor::epoch(XrTime time) const { return at(time).epoch; }

void WorldAnchor::lay(XrTime time, const Transform<World, Viewer>& world_from_viewer,
                      const Transform<Space, Viewer>& space_from_viewer) {
  auto& stretch = stretches_[static_cast<std::size_t>(&at(time) - stretches_.data())];
  if (!stretch.world_from_space) {
    stretch.world_from_space = world_from_viewer * space_from_viewer.inverse();
  }
}

void WorldAnchor::move(XrTime from, const std::optional<Transform<Space, Space>>& old_from_new) {
  const Stretch& before = stretches_.back();
  Stretch next;
  next.from = std::max(from, before.from);
  next.epoch = before.epoch + 1;
  if (placement_ == Placement::kMounted) {
    // World becomes the new space; measurements in the old one are lost.
    next.world_from_space = Transform<World, Space>();
  } else if (before.world_from_space && old_from_new) {
    // The wearer stays at the same place.
    next.world_from_space = *before.world_from_space * *old_from_new;
  }
  stretches_.push_back(next);
  if (stretches_.size() > kKept) {
    stretches_.erase(stretches_.begin());
  }
}

}  // namespace orthonav::openxr

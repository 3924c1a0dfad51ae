#include <algorithm>
#include <utility>

#include "engine/session/session.h"

namespace orthonav::engine {
namespace {

std::ptrdiff_t saved_regions(std::span<const nav::Region> regions) {
  return std::count_if(regions.begin(), regions.end(),
                       [](const nav::Region& region) { return region.saved; });
}

}  // namespace

// What must be saved, and what the surgeon is told of that.

void Session::save_region(Timestamp time) {
  const std::ptrdiff_t before = saved_regions(digitizing_.regions());
  digitizing_.save();
  const std::span<const nav::Region> regions = digitizing_.regions();
  if (observer_ && saved_regions(regions) > before) {
    // Where the button is still down, the next region has begun behind it.
    const auto last = std::find_if(regions.rbegin(), regions.rend(),
                                   [](const nav::Region& region) { return region.saved; });
    observer_->region_saved(time, level(), *last);
  }
}

void Session::drop_region(Timestamp time) {
  const std::ptrdiff_t before = saved_regions(digitizing_.regions());
  Message answer = digitizing_.drop_region(time);
  if (observer_ && saved_regions(digitizing_.regions()) < before) {
    observer_->region_dropped(time, level());
  }
  if (!std::holds_alternative<std::monostate>(answer)) {
    messages_.say(std::move(answer), time);
  }
}

void Session::tell_places(Timestamp now) {
  const nav::Anchor* anchor = tools_.tracker().anchor();
  if (anchor != nullptr && observer_ && !anchor->places.empty() &&
      std::exchange(places_changed_, anchor->places_changed) != anchor->places_changed) {
    observer_->references_placed(now, anchor->places);
  }
}

Saved Session::saved(Timestamp now) const {
  return saving_ ? saving_->saved(now, options_.heard_for) : Saved::kNothingNew;
}

}  // namespace orthonav::engine

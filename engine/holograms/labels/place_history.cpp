#include "engine/holograms/labels/place_history.h"

namespace orthonav::engine {

void PlaceHistory::wait_for(std::size_t place_to_take, Timestamp now) {
  if (better != place_to_take) {
    better = place_to_take;
    better_since = now;
  } else if (now - better_since >= kPlaceSettled) {
    move(place_to_take, now);
  }
}

void PlaceHistory::move(std::optional<std::size_t> to, Timestamp now) {
  before = place;
  left_at = now;
  place = to;
  better.reset();
}

}  // namespace orthonav::engine

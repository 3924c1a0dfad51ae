#pragma once

#include <optional>
#include <span>

#include "nav/registration/pressed_places.h"

namespace orthonav::nav {

/// `place_to_press` beside places that are joined first.
inline std::optional<NextPlace> next_place(const VertebraModel& model, const Registration& strokes,
                                           std::span<const Point<World>> stroked,
                                           std::span<const PressedPlace> pressed,
                                           const PoseSearchRegistrationOptions& options,
                                           double apart_m = kPressesApart_m) {
  const auto joined = join_places(model, strokes, pressed, options);
  return joined ? place_to_press(model, *joined, stroked, pressed, options, apart_m) : std::nullopt;
}

}  // namespace orthonav::nav

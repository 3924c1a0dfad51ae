#pragma once

#include <optional>
#include <span>

#include "nav/registration/presses.h"

namespace orthonav::nav {

struct Joined {
  PressFit fit;
  Registration registration;
};

/// `with_places` of places that are fitted first.
inline std::optional<Joined> fitted_and_joined(const VertebraModel& model,
                                               const Registration& strokes,
                                               std::span<const PressedPlace> places,
                                               const PoseSearchRegistrationOptions& options,
                                               const PressModel& press = {}) {
  const auto fit = fit_presses(model, strokes, places, press);
  return fit ? std::optional(Joined{*fit, with_places(model, strokes, *fit, press, options)})
             : std::nullopt;
}

/// `place_to_press` beside places that are fitted first.
inline std::optional<NextPlace> next_place(const VertebraModel& model, const Registration& strokes,
                                           std::span<const Point<World>> stroked,
                                           std::span<const PressedPlace> pressed,
                                           const PoseSearchRegistrationOptions& options,
                                           const PressModel& press = {},
                                           double apart_m = kPressesApart_m) {
  const auto fit = fit_presses(model, strokes, pressed, press);
  return fit ? place_to_press(model, strokes, stroked, pressed, *fit, press, options, apart_m)
             : std::nullopt;
}

}  // namespace orthonav::nav

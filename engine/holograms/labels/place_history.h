#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "base/time.h"

namespace orthonav::engine {

/// How long a better place must have been free before a label takes it. For as long, a label does
/// not return to the place that it left if there is another.
inline constexpr Duration kPlaceSettled = std::chrono::seconds(1);
/// A history older than that says nothing.
inline constexpr Duration kForgetPlacesAfter = std::chrono::seconds(2);

/// Which of its numbered places something stands at, and stood at before.
struct PlaceHistory {
  std::optional<std::size_t> place;  ///< none: nowhere
  std::optional<std::size_t> better;
  Timestamp better_since{};
  std::optional<std::size_t> before;  ///< the place that it left
  Timestamp left_at{};

  /// Moves to a place that has been better for `kPlaceSettled`.
  void wait_for(std::size_t place_to_take, Timestamp now);
  void move(std::optional<std::size_t> to, Timestamp now);
  [[nodiscard]] bool just_left(std::size_t from, Timestamp now) const {
    return before == from && now - left_at < kPlaceSettled;
  }
};

}  // namespace orthonav::engine

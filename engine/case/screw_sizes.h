#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/case/operation.h"
#include "nav/planning/pedicle_screws.h"

namespace orthonav::engine {

/// The screws of one diameter.
struct ScrewSize {
  double diameter_m = 0.0;
  std::vector<double> lengths_m;  ///< ascending
  /// Distance along the screw from the head's end to the rod in it; absent: not stated.
  std::optional<double> head_to_seat_m = {};

  friend bool operator==(const ScrewSize&, const ScrewSize&) = default;
};

/// The available screws.
struct ScrewSizes {
  std::vector<ScrewSize> by_diameter;  ///< ascending

  /// 4.5 to 7.5 mm by 0.5 mm and 8.5 mm, each 25 to 60 mm long by 5 mm.
  [[nodiscard]] static ScrewSizes built_in();

  /// Each diameter with each of its lengths.
  [[nodiscard]] std::vector<nav::ImplantSize> implants() const;
  /// The screws of that diameter, to 0.05 mm; null if there are none.
  [[nodiscard]] const ScrewSize* of_diameter(double diameter_m) const;
  /// Whether a screw of that diameter and length (to 0.5 mm) is among them.
  [[nodiscard]] bool has(double diameter_m, double length_m) const;
  /// Whether a screw of any diameter has that length (to 0.5 mm).
  [[nodiscard]] bool has_length(double length_m) const;
  /// The next thicker or thinner one; none at the end of the list.
  [[nodiscard]] std::optional<double> next_diameter_m(double diameter_m, bool thicker) const;
  /// The next longer or shorter one of that diameter, or of the nearest diameter if none has it.
  [[nodiscard]] std::optional<double> next_length_m(double diameter_m, double length_m,
                                                    bool longer) const;

  /// The value for that size; none if it is not in the list or not stated.
  [[nodiscard]] std::optional<double> head_to_seat_m(double diameter_m) const;

  /// Every problem at once: an empty list, diameters outside 2-12 mm, lengths outside 10-120 mm,
  /// seats outside 0-30 mm, numbers that do not ascend or repeat. Empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A line for each planned screw that is not in the list, such as "L4 left: 6.2 x 43.0 mm is not
/// in the list of screws"; for a plan without a radius only the length is checked.
[[nodiscard]] std::vector<std::string> sizes_not_listed(const Operation& operation,
                                                        const ScrewSizes& sizes);

}  // namespace orthonav::engine

#pragma once

#include <array>
#include <optional>

#include "study/surgeon/eyes.h"

namespace orthonav::sim {

/// The deviation that H5 to H7 show at a moment: the rotation vector (Room, rad) that takes the
/// tool's axis onto the planned one.
struct Deviation {
  Timestamp seen_at{};
  Vec3 rotation_rad;
};

/// Reads it off the display. If neither dot of the cross is held at its rim, it is the line from
/// the filled to the hollow one, checked against the number. Otherwise the triangle gives the
/// direction, corrected for the tip's offset that the filled dot shows, and the number gives the
/// size; where it is a bound, the triangle does. The triangle alone is not enough: with the tip
/// beside the entry it closes at another angle. Nothing without triangle, dots or a number, or if
/// dots and number disagree by more than a degree.
[[nodiscard]] std::optional<Deviation> read_deviation(const Eyes& eyes);

/// Reads it off triangle and number alone, as published: the triangle gives the direction, the
/// number the size. With the tip beside the entry, the triangle closes at another angle. Nothing if
/// a part is missing.
[[nodiscard]] std::optional<Deviation> read_triangle(const Eyes& eyes);

/// The tip's offset from the planned axis (Room, m), which leads out of the bone: its direction by
/// the filled dot, its size by the number under the cross; where that is a bound, by the dot.
/// Nothing without dots.
[[nodiscard]] std::optional<Vec3> read_tip_offset(const Eyes& eyes, Vec3 outwards);

/// The readings of the last seconds, one per displayed frame.
class DeviationMemory {
 public:
  void add(const Deviation& reading);
  void clear() { count_ = 0; }
  /// The newest seen at or before `until`.
  [[nodiscard]] std::optional<Deviation> newest(Timestamp until) const;
  /// The mean rotation of the readings since then; nothing if they don't reach back that far.
  [[nodiscard]] std::optional<Vec3> mean_since(Timestamp since) const;

 private:
  static constexpr std::size_t kKept = 256;
  [[nodiscard]] std::size_t size() const { return count_ < kKept ? count_ : kKept; }
  [[nodiscard]] const Deviation& back(std::size_t steps) const {
    return readings_[(count_ - 1 - steps) % kKept];
  }
  std::array<Deviation, kKept> readings_{};
  std::size_t count_ = 0;
};

}  // namespace orthonav::sim

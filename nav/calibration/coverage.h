#pragma once

#include <algorithm>
#include <array>

#include "base/vec.h"

namespace orthonav::nav {

/// The fraction of an image that points cover: of 8 by 6 fields, the fraction that hold a point.
class Coverage {
 public:
  Coverage(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  void add(Vec2 place_px) {
    const int column =
        std::clamp(static_cast<int>(place_px.x * kAcross / width_px_), 0, kAcross - 1);
    const int row = std::clamp(static_cast<int>(place_px.y * kDown / height_px_), 0, kDown - 1);
    reached_[static_cast<std::size_t>(row * kAcross + column)] = true;
  }
  [[nodiscard]] double fraction() const {
    return static_cast<double>(std::count(reached_.begin(), reached_.end(), true)) /
           static_cast<double>(reached_.size());
  }

 private:
  static constexpr int kAcross = 8;
  static constexpr int kDown = 6;

  int width_px_;
  int height_px_;
  std::array<bool, kAcross * kDown> reached_{};
};

}  // namespace orthonav::nav

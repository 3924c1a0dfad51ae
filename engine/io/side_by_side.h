#pragma once

#include <cstddef>
#include <vector>

namespace orthonav::engine {

/// Pictures of one size joined side by side, row by row; `values` is the member that holds their
/// pixels, with `channels` values per pixel.
template <class Picture, class Values>
Picture side_by_side(const std::vector<Picture>& views, Values Picture::*values,
                     std::size_t channels) {
  Picture joined;
  if (views.empty()) {
    return joined;
  }
  joined.height_px = views.front().height_px;
  joined.width_px = views.front().width_px * static_cast<int>(views.size());
  const std::size_t row = channels * static_cast<std::size_t>(views.front().width_px);
  (joined.*values).reserve(row * views.size() * static_cast<std::size_t>(joined.height_px));
  for (std::size_t y = 0; y < static_cast<std::size_t>(joined.height_px); ++y) {
    for (const Picture& view : views) {
      const auto begin = (view.*values).begin() + static_cast<std::ptrdiff_t>(y * row);
      (joined.*values)
          .insert((joined.*values).end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
  }
  return joined;
}

}  // namespace orthonav::engine

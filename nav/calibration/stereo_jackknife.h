#pragma once

#include "nav/calibration/stereo_board.h"

namespace orthonav::nav {

/// Views of the board, left and right separately.
struct BoardViews {
  std::vector<BoardCorners> left;
  std::vector<BoardCorners> right;

  void leave_out(std::size_t view) {
    left.erase(left.begin() + static_cast<long>(view));
    right.erase(right.begin() + static_cast<long>(view));
  }
};

/// How exact a stereo fit is, by leaving out each tenth of the views in turn (each view, if there
/// are fewer than ten). Unlike predictions from residuals, it notices a board that is not flat and
/// correlated errors of corners. Empty with fewer than four views.
[[nodiscard]] std::optional<StereoSigma> stereo_sigma(const Chessboard& board, ImageSize size,
                                                      const BoardViews& views, const StereoFit& fit,
                                                      LensTerms terms);

}  // namespace orthonav::nav

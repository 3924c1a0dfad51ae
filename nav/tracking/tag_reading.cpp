#include "nav/tracking/tag_reading.h"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <Eigen/Dense>
#include <vector>

#include "nav/tracking/bilinear.h"

namespace orthonav::nav {
namespace {

// A highlight or a speck may hide a cell of a ring.
constexpr int kBrightCellsAllowed = 1;
// The library's: how much a cell is set off from its neighbours before it is compared.
constexpr double kSharpening = 0.25;
// A highlight or a marker may hide two of the four squares; a tag beside something dark has one.
constexpr int kFewestDarkCorners = 2;

/// The projective map of the unit square to a quadrangle: (0, 0), (1, 0), (1, 1), (0, 1) to the
/// corners (Heckbert 1989, section 2.2.3).
class SquareToQuad {
 public:
  explicit SquareToQuad(const std::array<Vec2, 4>& q) : origin_(q[0]) {
    const Vec2 d1 = q[1] - q[2];
    const Vec2 d2 = q[3] - q[2];
    const Vec2 sum = q[0] - q[1] + q[2] - q[3];
    const double det = d1.x * d2.y - d2.x * d1.y;
    g_ = (sum.x * d2.y - d2.x * sum.y) / det;
    h_ = (d1.x * sum.y - sum.x * d1.y) / det;
    along_ = q[1] - q[0] + g_ * q[1];
    up_ = q[3] - q[0] + h_ * q[3];
  }
  [[nodiscard]] Vec2 operator()(double u, double v) const {
    return (1.0 / (g_ * u + h_ * v + 1.0)) * (u * along_ + v * up_ + origin_);
  }

 private:
  Vec2 origin_;
  Vec2 along_;
  Vec2 up_;
  double g_ = 0.0;
  double h_ = 0.0;
};

/// +1 for a convex quadrangle whose corners turn to the right as seen (y down), -1 to the left, as
/// those of `MarkerCorners` do; else 0.
int turning_sense(const std::array<Vec2, 4>& corners) {
  int right = 0;
  int left = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corners[(i + 1) % 4] - corners[i];
    const Vec2 b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    const double turn = a.x * b.y - a.y * b.x;
    right += turn > 0;
    left += turn < 0;
  }
  return right == 4 ? 1 : left == 4 ? -1 : 0;
}

/// Calls `visit` with row and column of every cell on the ring `ring` cells inside the outer edge.
template <class Visit>
void along_ring(int cells, int ring, Visit visit) {
  const int last = cells - 1 - ring;
  for (int i = ring; i < last; ++i) {
    visit(i, ring);
    visit(last, i);
    visit(cells - 1 - i, last);
    visit(ring, cells - 1 - i);
  }
}

/// A grey level that changes linearly over the tag.
class GreyPlane {
 public:
  void add(double u, double v, double grey) {
    const Eigen::Vector3d at(u, v, 1);
    normal_ += at * at.transpose();
    right_ += grey * at;
  }
  void solve() { plane_ = normal_.ldlt().solve(right_); }
  [[nodiscard]] double at(double u, double v) const {
    return plane_.x() * u + plane_.y() * v + plane_.z();
  }

 private:
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
};

/// The cells of a quad, above zero where they are nearer to its surroundings' grey than to its
/// border's.
class Cells {
 public:
  Cells(const GreyImage& image, const std::array<Vec2, 4>& corners_px, int cells)
      : cells_(cells), above_(static_cast<std::size_t>(cells * cells)) {
    const SquareToQuad place(corners_px);
    const auto grey = [&](int row, int column) {
      const Vec2 at = place((column + 0.5) / cells_, 1 - (row + 0.5) / cells_);
      return std::isfinite(at.x + at.y) ? grey_at(image, at) : 0.0;
    };
    GreyPlane black;
    GreyPlane white;
    along_ring(cells_, 0, [&](int row, int column) { black.add(column, row, grey(row, column)); });
    along_ring(cells_, -1, [&](int row, int column) {
      const bool corner = (row < 0 || row == cells_) && (column < 0 || column == cells_);
      if (!corner) {
        white.add(column, row, grey(row, column));
      }
    });
    black.solve();
    white.solve();
    for (const int row : {-1, cells_}) {
      for (const int column : {-1, cells_}) {
        const double middle = 0.5 * (black.at(column, row) + white.at(column, row));
        dark_corners_ += grey(row, column) < middle;
      }
    }
    const double middle = 0.5 * (cells_ - 1);
    contrast_ = white.at(middle, middle) - black.at(middle, middle);
    std::vector<double> raw(above_.size());
    for (int row = 0; row < cells_; ++row) {
      for (int column = 0; column < cells_; ++column) {
        raw[index(row, column)] =
            grey(row, column) - 0.5 * (black.at(column, row) + white.at(column, row));
      }
    }
    for (int row = 0; row < cells_; ++row) {
      for (int column = 0; column < cells_; ++column) {
        const double here = raw[index(row, column)];
        double against = 4 * here;
        against -= row > 0 ? raw[index(row - 1, column)] : 0;
        against -= row + 1 < cells_ ? raw[index(row + 1, column)] : 0;
        against -= column > 0 ? raw[index(row, column - 1)] : 0;
        against -= column + 1 < cells_ ? raw[index(row, column + 1)] : 0;
        above_[index(row, column)] = here + kSharpening * against;
      }
    }
  }

  [[nodiscard]] double contrast() const { return contrast_; }
  /// Of the cells just outside the four corners.
  [[nodiscard]] int dark_corners() const { return dark_corners_; }
  [[nodiscard]] int bright_on_ring(int ring) const {
    int bright = 0;
    along_ring(cells_, ring, [&](int row, int column) { bright += above(row, column) > 0; });
    return bright;
  }
  [[nodiscard]] double above(int row, int column) const { return above_[index(row, column)]; }
  /// Of the tag that is upright after `turns` quarter turns.
  [[nodiscard]] double above(int row, int column, int turns) const {
    for (int i = 0; i < turns; ++i) {
      const int before = row;
      row = cells_ - 1 - column;
      column = before;
    }
    return above(row, column);
  }

 private:
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row * cells_ + column);
  }
  int cells_;
  double contrast_ = 0.0;
  int dark_corners_ = 0;
  std::vector<double> above_;
};

/// How many rings of the border hold no bit of the code.
int border_rings(const apriltag_family& family) {
  int rings = family.width_at_border;
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    rings =
        std::min({rings, static_cast<int>(family.bit_x[bit]), static_cast<int>(family.bit_y[bit])});
  }
  return rings;
}

/// Mean distance of the bits from the middle grey, of the worse of black and white.
double margin(const Cells& cells, const apriltag_family& family, int turns) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    const double above = cells.above(static_cast<int>(family.bit_y[bit]),
                                     static_cast<int>(family.bit_x[bit]), turns);
    const std::size_t white = above > 0 ? 1 : 0;
    sum[white] += std::abs(above);
    ++count[white];
  }
  return std::min(sum[0] / std::max(1, count[0]), sum[1] / std::max(1, count[1]));
}

}  // namespace

void thin(const GreyImage& image, const PixelBox& box, int window_px, GreyImage& thinned) {
  thinned.width_px = box.width_px;
  thinned.height_px = box.height_px;
  thinned.pixels.resize(static_cast<std::size_t>(box.width_px) *
                        static_cast<std::size_t>(box.height_px));
  for (int y = 0; y < box.height_px; ++y) {
    for (int x = 0; x < box.width_px; ++x) {
      const int right = std::min(box.x_px + x + window_px, image.width_px);
      const int bottom = std::min(box.y_px + y + window_px, image.height_px);
      std::uint8_t brightest = 0;
      for (int row = box.y_px + y; row < bottom; ++row) {
        for (int column = box.x_px + x; column < right; ++column) {
          brightest = std::max(brightest, image.at(column, row));
        }
      }
      thinned.at(x, y) = brightest;
    }
  }
}

std::optional<MarkerCorners> read_tag(const GreyImage& image, const std::array<Vec2, 4>& corners_px,
                                      const apriltag_family& family, int max_hamming,
                                      bool& touched) {
  std::array<Vec2, 4> corners = corners_px;
  const int sense = turning_sense(corners);
  if (sense == 0) {
    return std::nullopt;
  }
  if (sense > 0) {
    std::swap(corners[1], corners[3]);
  }
  const Cells cells(image, corners, family.width_at_border);
  if (!(cells.contrast() > 0)) {
    return std::nullopt;
  }
  for (int ring = 0; ring < border_rings(family); ++ring) {
    if (cells.bright_on_ring(ring) > kBrightCellsAllowed) {
      return std::nullopt;
    }
  }
  MarkerCorners best;
  best.hamming = max_hamming + 1;
  int best_turns = 0;
  for (int turns = 0; turns < 4; ++turns) {
    std::uint64_t code = 0;
    for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
      const bool white = cells.above(static_cast<int>(family.bit_y[bit]),
                                     static_cast<int>(family.bit_x[bit]), turns) > 0;
      code = code << 1U | (white ? 1U : 0U);
    }
    for (std::uint32_t id = 0; id < family.ncodes; ++id) {
      const int hamming = std::popcount(code ^ family.codes[id]);
      if (hamming < best.hamming) {
        best.hamming = hamming;
        best.id = static_cast<int>(id);
        best_turns = turns;
      }
    }
  }
  if (best.hamming > max_hamming) {
    return std::nullopt;
  }
  best.decision_margin = margin(cells, family, best_turns);
  touched = cells.dark_corners() >= kFewestDarkCorners;
  for (std::size_t i = 0; i < 4; ++i) {
    best.corners_px[i] = corners[(i + static_cast<std::size_t>(best_turns)) % 4];
  }
  return best;
}

}  // namespace orthonav::nav

#include "nav/tracking/wide_border.h"

#include <algorithm>
#include <cmath>

#include "nav/tracking/bilinear.h"

namespace orthonav::nav {
namespace {

constexpr int kCells = 10;
// A highlight or a speck may hide a cell of the ring.
constexpr int kBrightCellsAllowed = 1;

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

/// Calls `visit` with the grey of every cell on the ring that lies `ring` cells inside the outer
/// edge.
template <class Visit>
void along_ring(const GreyImage& image, const SquareToQuad& place, int ring, Visit visit) {
  const int last = kCells - 1 - ring;
  for (int i = ring; i < last; ++i) {
    const double a = (i + 0.5) / kCells;
    const double low = (ring + 0.5) / kCells;
    visit(grey_at(image, place(a, low)));
    visit(grey_at(image, place(1 - low, a)));
    visit(grey_at(image, place(1 - a, 1 - low)));
    visit(grey_at(image, place(low, 1 - a)));
  }
}

double ring_mean(const GreyImage& image, const SquareToQuad& place, int ring) {
  double sum = 0.0;
  int count = 0;
  along_ring(image, place, ring, [&](double grey) {
    sum += grey;
    ++count;
  });
  return sum / count;
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

bool has_wide_border(const GreyImage& image, const std::array<Vec2, 4>& corners_px) {
  const SquareToQuad place(corners_px);
  // The surroundings are not white everywhere (an AprilGrid has black squares), but three quarters
  // of them are.
  const double black = ring_mean(image, place, 0);
  const double white = ring_mean(image, place, -1);
  if (!(white > black)) {
    return false;
  }
  const double middle = 0.5 * (black + white);
  int bright = 0;
  along_ring(image, place, 1, [&](double grey) { bright += grey > middle ? 1 : 0; });
  return bright <= kBrightCellsAllowed;
}

}  // namespace orthonav::nav

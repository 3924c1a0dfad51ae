#include "hal/sim/cameras/room_renderer_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "hal/sim/cameras/tag_pattern.h"

namespace orthonav::sim {
namespace {

/// Sums of some hundred floats near one.
constexpr double kRounding = 1e-4;

struct Canvas {
  int width;
  int height;
  std::vector<float> cells;
  std::vector<CoverageWindow::Span> spans;

  Canvas(int w, int h)
      : width(w),
        height(h),
        cells(static_cast<std::size_t>((w + 2) * h), 0.0F),
        spans(static_cast<std::size_t>(h)) {}
  void draw(const std::vector<Vec2>& polygon) {
    CoverageWindow window(cells.data(), spans.data(), width, height);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      window.add_segment(polygon[i], polygon[(i + 1) % polygon.size()], 1.0);
    }
  }
  [[nodiscard]] double covered(int x, int y) const {
    double sum = 0.0;
    for (int i = 0; i <= x; ++i) {
      sum += static_cast<double>(cells[static_cast<std::size_t>(y * (width + 2) + i)]);
    }
    return sum;
  }
};

/// Turning left on the image, so that the inside is positive.
std::vector<Vec2> triangle(Vec2 a, Vec2 b, Vec2 c) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return area < 0 ? std::vector<Vec2>{a, b, c} : std::vector<Vec2>{a, c, b};
}

/// Area of a polygon inside one pixel, by clipping (Sutherland-Hodgman): another way to the same.
double clipped_area(std::vector<Vec2> polygon, int px, int py) {
  const std::array<std::array<double, 3>, 4> sides = {
      {{1, 0, -1.0 * px}, {-1, 0, px + 1.0}, {0, 1, -1.0 * py}, {0, -1, py + 1.0}}};
  for (const auto& [nx, ny, d] : sides) {
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      const double da = nx * a.x + ny * a.y + d;
      const double db = nx * b.x + ny * b.y + d;
      if (da >= 0) {
        kept.push_back(a);
      }
      if ((da >= 0) != (db >= 0)) {
        kept.push_back(a + (da / (da - db)) * (b - a));
      }
    }
    polygon = kept;
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

TEST(CoverageWindow, IsTheExactAreaInEveryPixel) {
  Random random(9);
  for (int round = 0; round < 200; ++round) {
    const auto corner = [&] {  // also outside the window, on every side
      return Vec2{random.uniform(-6.0, 18.0), random.uniform(-5.0, 14.0)};
    };
    const std::vector<Vec2> shape = triangle(corner(), corner(), corner());
    Canvas canvas(12, 9);
    canvas.draw(shape);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 12; ++x) {
        ASSERT_NEAR(canvas.covered(x, y), clipped_area(shape, x, y), kRounding)
            << "pixel " << x << ", " << y << " of triangle " << round;
      }
    }
  }
}

TEST(CoverageWindow, SpansNameEveryCoveredPixel) {
  Canvas canvas(12, 9);
  canvas.draw(triangle({3.2, 1.5}, {30.0, 4.0}, {5.0, 7.7}));  // open to the right
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 12; ++x) {
      if (canvas.covered(x, y) < kRounding) {
        continue;
      }
      const auto span = canvas.spans[static_cast<std::size_t>(y)];
      EXPECT_GE(x, span.low);
      EXPECT_LT(x, span.high);
    }
  }
}

TEST(CoverageWindow, IgnoresWhatIsNotANumber) {
  Canvas canvas(4, 4);
  canvas.draw({{std::nan(""), 1.0}, {2.0, std::nan("")}, {1.0, 3.0}});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_TRUE(std::isfinite(canvas.covered(x, y)));
    }
  }
}

TEST(TagPattern, HasABlackBorderInAWhiteMargin) {
  const auto pattern = tag_pattern("tag36h11", 3);
  ASSERT_TRUE(pattern);
  EXPECT_EQ(pattern->cells, 10);
  EXPECT_EQ(pattern->border_cells, 8);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(pattern->is_black(0, i));
    EXPECT_FALSE(pattern->is_black(i, 9));
  }
  for (int i = 1; i < 9; ++i) {
    EXPECT_TRUE(pattern->is_black(1, i));
    EXPECT_TRUE(pattern->is_black(i, 8));
  }
  EXPECT_FALSE(pattern->is_black(-1, 3));
  EXPECT_FALSE(pattern->is_black(3, 10));
}

TEST(TagPattern, KnowsFamiliesAndTheirSizes) {
  EXPECT_TRUE(tag_pattern("tag25h9", 0));
  EXPECT_TRUE(tag_pattern("tagStandard41h12", 0));
  EXPECT_FALSE(tag_pattern("tag36h11", -1));
  EXPECT_FALSE(tag_pattern("tag36h11", 587));
  EXPECT_TRUE(tag_pattern("tag36h11", 586));
  EXPECT_FALSE(tag_pattern("qr", 1));
}

}  // namespace
}  // namespace orthonav::sim

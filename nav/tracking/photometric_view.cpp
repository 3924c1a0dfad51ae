#include "nav/tracking/photometric_view.h"

#include <algorithm>
#include <cmath>

#include "base/vectorized.h"
#include "nav/tracking/blur_profile.h"

namespace orthonav::nav {
namespace {

constexpr std::uint8_t kSaturated = 254;
/// In areas without edges every second column and row is enough: they only determine the light.
constexpr int kFlatStep = 2;
/// The position of a corner outside the image is known only roughly.
constexpr double kRoughPx = 24.0;

/// Along one axis: the cell, and for its low and its high edge the fraction of the blur's footprint
/// beyond it, the derivatives of that fraction by position, by the logarithm of the blur and by its
/// excess kurtosis, and the density at the edge.
enum AxisColumn {
  kCell,
  kLow,
  kHigh,
  kLowSlope,
  kHighSlope,
  kLowBlur,
  kHighBlur,
  kLowTails,
  kHighTails,
  kLowDensity,
  kHighDensity,
  kAxisColumns
};
/// The columns for one row of pixels: positions across and up, the blur's scale, and both axes.
enum RowColumn {
  kX,
  kY,
  kScale,
  kAcross,
  kDown = kAcross + kAxisColumns,
  kRowColumns = kDown + kAxisColumns
};
/// Fills the columns of one axis.
ORTHONAV_WIDE void along(const float* __restrict place, const float* __restrict scale, int n,
                         float half, float inverse_blur, float excess_kurtosis,
                         float* __restrict out, std::ptrdiff_t stride) {
  float* __restrict column[kAxisColumns];
  for (int c = 0; c < kAxisColumns; ++c) {
    column[c] = out + c * stride;
  }
  ORTHONAV_VECTORIZED
  for (int i = 0; i < n; ++i) {
    // In this order NaN becomes the low end.
    const float c = std::min(std::max(0.0F, place[i] + half), 2.0F * half - 1e-4F);
    const float cell = static_cast<float>(static_cast<int>(c));
    const float f = c - cell;
    const float inverse = inverse_blur * scale[i];
    const Beyond low = beyond(f, inverse, excess_kurtosis);
    const Beyond high = beyond(1.0F - f, inverse, excess_kurtosis);
    column[kCell][i] = cell;
    column[kLow][i] = low.fraction;
    column[kHigh][i] = high.fraction;
    column[kLowSlope][i] = -low.slope;
    column[kHighSlope][i] = high.slope;
    column[kLowBlur][i] = low.by_blur;
    column[kHighBlur][i] = high.by_blur;
    column[kLowTails][i] = low.by_kurtosis;
    column[kHighTails][i] = high.by_kurtosis;
    column[kLowDensity][i] = low.gaussian;
    column[kHighDensity][i] = high.gaussian;
  }
}

/// Whether a pixel's blur reaches past the template along this axis, where the image is unknown.
/// The densities are zero if the footprint does not reach an edge.
inline bool reaches_out(const float* axis, std::ptrdiff_t stride, float last_cell) {
  const float cell = axis[kCell * stride];
  return (cell == 0.0F && axis[kLowDensity * stride] > 0.0F) ||
         (cell == last_cell && axis[kHighDensity * stride] > 0.0F);
}

inline bool reaches_edge(const float* axis, std::ptrdiff_t stride) {
  return axis[kLowDensity * stride] + axis[kHighDensity * stride] != 0.0F;
}

Mat3 inverse_of(const Mat3& m) {
  const Vec3 a = m.column(0);
  const Vec3 b = m.column(1);
  const Vec3 c = m.column(2);
  const double det = a.dot(b.cross(c));
  const Vec3 r0 = b.cross(c) / det;
  const Vec3 r1 = c.cross(a) / det;
  const Vec3 r2 = a.cross(b) / det;
  return {{{{r0.x, r0.y, r0.z}, {r1.x, r1.y, r1.z}, {r2.x, r2.y, r2.z}}}};
}

/// The pixel of a unit-plane point past the image's edge, by the scale in the middle.
Vec2 rough_pixel(const CameraModel& camera, Vec2 u) {
  const int w = camera.width_px();
  const int h = camera.height_px();
  const auto at = [&](int x, int y) {
    return camera.lookup()[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                           static_cast<std::size_t>(x)];
  };
  const Vec2 a = at(w / 4, h / 2);
  const Vec2 b = at(3 * w / 4, h / 2);
  const Vec2 c = at(w / 2, h / 4);
  const Vec2 d = at(w / 2, 3 * h / 4);
  return {w / 2 + 0.5 + (u.x - 0.5 * (a.x + b.x)) * (3 * w / 4 - w / 4) / (b.x - a.x),
          h / 2 + 0.5 + (u.y - 0.5 * (c.y + d.y)) * (3 * h / 4 - h / 4) / (d.y - c.y)};
}

}  // namespace

ViewModel::ViewModel() : block_(static_cast<std::size_t>(kBlockColumns) * kBlock, 0.0F) {}

/// Computes the camera's centre and the map from its rays to the tag's cells; `t` in cells. False
/// if the tag is seen from behind or lies behind the camera.
bool ViewModel::face(const Mat3& rotation, Vec3 t) {
  const Vec3 eye = -(rotation.transposed() * t);
  if (!(eye.z > 0.5) || !(t.z > 0.5)) {
    return false;
  }
  eye_cells_ = eye;
  const Mat3 inverse = inverse_of(Mat3::from_columns(rotation.column(0), rotation.column(1), t));
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      plane_from_ray_[static_cast<std::size_t>(3 * r + c)] =
          static_cast<float>(inverse[r][static_cast<std::size_t>(c)]);
    }
  }
  depth_ = static_cast<float>(t.z);
  return true;
}

bool ViewModel::place(const CameraModel& camera, const BlurredTag& tag, const CameraFromTag& pose) {
  const Vec3 t = pose.translation_m / tag.cell_m();
  if (!face(pose.rotation, t)) {
    return false;
  }
  half_ = 0.5F * static_cast<float>(tag.cells().cells);
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const Vec3 p = pose.rotation * Vec3{sx * half_, sy * half_, 0.0} + t;
      if (!(p.z > 0.5)) {
        return false;
      }
      const Vec2 u{p.x / p.z, p.y / p.z};
      const auto seen = camera.project(u);
      const Vec2 pixel = seen ? *seen : rough_pixel(camera, u);
      const double room = seen ? 0.0 : kRoughPx;
      low = {std::min(low.x, pixel.x - room), std::min(low.y, pixel.y - room)};
      high = {std::max(high.x, pixel.x + room), std::max(high.y, pixel.y + room)};
    }
  }
  const auto within = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
  };
  x0_ = within(std::floor(low.x - 0.5), camera.width_px());
  x1_ = within(std::ceil(high.x + 0.5), camera.width_px());
  y0_ = within(std::floor(low.y - 0.5), camera.height_px());
  y1_ = within(std::ceil(high.y + 0.5), camera.height_px());
  return x1_ > x0_ && y1_ > y0_;
}

ORTHONAV_WIDE ViewModel::OnTag ViewModel::spread(const RayTable& rays, int y,
                                                 const Photometry& light) {
  const int n = x1_ - x0_;
  const std::ptrdiff_t stride = n;
  if (row_.size() < static_cast<std::size_t>((kRowColumns + 1) * n)) {
    row_.resize(static_cast<std::size_t>((kRowColumns + 1) * std::max(n, rays.width_px)));
  }
  const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(rays.width_px) +
                            static_cast<std::size_t>(x0_);
  const float* __restrict ray_x = rays.x.data() + start;
  const float* __restrict ray_y = rays.y.data() + start;
  float* __restrict across = row_.data() + kX * stride;
  float* __restrict up = row_.data() + kY * stride;
  float* __restrict down = row_.data() + kRowColumns * stride;
  float* __restrict scale = row_.data() + kScale * stride;
  const std::array<float, 9> m = plane_from_ray_;
  ORTHONAV_VECTORIZED
  for (int i = 0; i < n; ++i) {
    const float w = m[6] * ray_x[i] + m[7] * ray_y[i] + m[8];
    const float depth = 1.0F / w;
    across[i] = (m[0] * ray_x[i] + m[1] * ray_y[i] + m[2]) * depth;
    up[i] = (m[3] * ray_x[i] + m[4] * ray_y[i] + m[5]) * depth;
    down[i] = -up[i];
    scale[i] = depth_ * w;  // the blur covers more cells where the tag is farther
  }
  const auto is_on_tag = [&](int i) {
    return std::abs(across[i]) < half_ && std::abs(up[i]) < half_;
  };
  OnTag on{0, n};
  while (on.from < n && !is_on_tag(on.from)) {
    ++on.from;
  }
  while (on.to > on.from && !is_on_tag(on.to - 1)) {
    --on.to;
  }
  along(across + on.from, scale + on.from, on.to - on.from, half_,
        static_cast<float>(1.0 / light.blur_cells[0]), static_cast<float>(light.excess_kurtosis[0]),
        row_.data() + kAcross * stride + on.from, stride);
  along(down + on.from, scale + on.from, on.to - on.from, half_,
        static_cast<float>(1.0 / light.blur_cells[1]), static_cast<float>(light.excess_kurtosis[1]),
        row_.data() + kDown * stride + on.from, stride);
  return on;
}

// Bilinear in the fractions beyond the edges, plus the effect of the blur's correlation at corners
// (the first term of Mehler's series).
void ViewModel::add(int k, int i, std::uint8_t grey, float blur_correlation, const float* c) {
  const std::ptrdiff_t stride = x1_ - x0_;
  const float* row = row_.data() + i;
  const float* x = row + kAcross * stride;
  const float* y = row + kDown * stride;
  const auto of = [stride](const float* axis, int column) { return axis[column * stride]; };
  float* out = block_.data() + k;
  const float lx = of(x, kLow);
  const float hx = of(x, kHigh);
  const float ly = of(y, kLow);
  const float hy = of(y, kHigh);
  const float left = c[1] + ly * c[5] + hy * c[6];
  const float right = c[2] + ly * c[7] + hy * c[8];
  const float above = c[3] + lx * c[5] + hx * c[7];
  const float below = c[4] + lx * c[6] + hx * c[8];
  const float at_left = of(y, kLowDensity) * c[5] - of(y, kHighDensity) * c[6];
  const float at_right = of(y, kLowDensity) * c[7] - of(y, kHighDensity) * c[8];
  const float corners = of(x, kLowDensity) * at_left - of(x, kHighDensity) * at_right;
  out[kGrey * kBlock] = grey;
  out[kBx * kBlock] = row[kX * stride];
  out[kBy * kBlock] = row[kY * stride];
  out[kT * kBlock] =
      c[0] + lx * left + hx * right + ly * c[3] + hy * c[4] + blur_correlation * corners;
  out[kTx * kBlock] = of(x, kLowSlope) * left + of(x, kHighSlope) * right;
  out[kTy * kBlock] = -(of(y, kLowSlope) * above + of(y, kHighSlope) * below);
  out[kTsx * kBlock] = of(x, kLowBlur) * left + of(x, kHighBlur) * right;
  out[kTsy * kBlock] = of(y, kLowBlur) * above + of(y, kHighBlur) * below;
  out[kTtx * kBlock] = of(x, kLowTails) * left + of(x, kHighTails) * right;
  out[kTty * kBlock] = of(y, kLowTails) * above + of(y, kHighTails) * below;
  out[kTc * kBlock] = corners;
}

void ViewModel::collect(const GreyImage& image, const BlurredTag& tag, int y, OnTag row,
                        const Photometry& light, double doubt_cells, ViewEquations& out) {
  const std::ptrdiff_t stride = x1_ - x0_;
  const float* r = row_.data();
  const auto last = static_cast<float>(tag.cells().cells - 1);
  const std::uint8_t* pixels =
      image.pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
      static_cast<std::size_t>(x0_);
  for (int i = row.from; i < row.to; ++i) {
    const float x = r[kX * stride + i];
    const float up = r[kY * stride + i];
    if (!(std::abs(x) < half_ && std::abs(up) < half_) || pixels[i] >= kSaturated) {
      continue;
    }
    const float* across = r + kAcross * stride + i;
    const float* down = r + kDown * stride + i;
    if (reaches_out(across, stride, last) || reaches_out(down, stride, last)) {
      continue;
    }
    const bool flat = !reaches_edge(across, stride) && !reaches_edge(down, stride);
    if (flat && ((i + x0_) % kFlatStep != 0 || y % kFlatStep != 0)) {
      continue;
    }
    const int cell_row = static_cast<int>(down[kCell * stride]);
    const int cell_column = static_cast<int>(across[kCell * stride]);
    cell_[static_cast<std::size_t>(filled_)] =
        static_cast<std::uint16_t>(cell_row * tag.cells().cells + cell_column);
    add(filled_++, i, pixels[i], static_cast<float>(light.blur_correlation),
        tag.coefficients(cell_row, cell_column));
    if (filled_ == kBlock) {
      finish(light, doubt_cells, out);
    }
  }
}

void ViewModel::linearize(const GreyImage& image, const CameraModel& camera, const RayTable& rays,
                          const BlurredTag& tag, const CameraFromTag& pose, const Photometry& light,
                          double doubt_cells, std::vector<float>& cell_weights,
                          ViewEquations& out) {
  out = {};
  if (!place(camera, tag, pose)) {
    return;
  }
  const std::size_t cells = tag.cells().white.size();
  counted_.assign(cells, 0.0F);
  kept_.assign(cells, 0.0F);
  const auto pieces = static_cast<std::size_t>(pieces_across());
  scores_.assign(pieces * pieces * kColumns, 0.0F);
  if (cell_weights.size() == cells) {
    believed_.assign(cell_weights.begin(), cell_weights.end());
  } else {
    believed_.assign(cells, 1.0F);
  }
  for (int y = y0_; y < y1_; ++y) {
    collect(image, tag, y, spread(rays, y, light), light, doubt_cells, out);
  }
  finish(light, doubt_cells, out);
  judge_cells(cell_weights);
}

}  // namespace orthonav::nav

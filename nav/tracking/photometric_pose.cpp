#include "nav/tracking/photometric_pose.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <Eigen/Dense>
#include <utility>

#include "base/vectorized.h"
#include "nav/geometry/matrix_as.h"

// From grey values to a pose: a tag prepared for its blur; the model of one tag in one image, row
// by row; what a block of pixels adds to its equations; its light, which is eliminated; and the
// motion of the tool that all views together ask for.

namespace orthonav::nav {
namespace {

/// From the two neighbours in a row that are nearest to the middle of the image and have
/// directions.
double focal_px_of(const CameraModel& camera) {
  const std::span<const Vec2> rays = camera.lookup();
  const int w = camera.width_px();
  double nearest = 1e18;
  double focal = 1.0;
  for (int y = 0; y < camera.height_px(); ++y) {
    for (int x = 1; x < w; ++x) {
      const double off = std::hypot(x - 0.5 * w, y - 0.5 * camera.height_px());
      if (off >= nearest) {
        continue;
      }
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      const double step = (rays[i] - rays[i - 1]).norm();
      if (!(step > 0.0)) {
        continue;
      }
      nearest = off;
      focal = 1.0 / step;
    }
  }
  return focal;
}

}  // namespace

RayTable::RayTable(const CameraModel& camera)
    : width_px(camera.width_px()), height_px(camera.height_px()) {
  x.reserve(camera.lookup().size());
  y.reserve(camera.lookup().size());
  for (const Vec2 ray : camera.lookup()) {
    x.push_back(static_cast<float>(ray.x));
    y.push_back(static_cast<float>(ray.y));
  }
  focal_px = focal_px_of(camera);
}

BlurredTag::BlurredTag(TagTemplate tag, double size_m)
    : tag_(std::move(tag)), cell_m_(tag_.cell_m(size_m)) {
  const int n = tag_.cells;
  coefficients_.assign(static_cast<std::size_t>(12 * n * n), 0.0F);
  const auto at = [&](int row, int column) {
    return tag_.at(std::clamp(row, 0, n - 1), std::clamp(column, 0, n - 1));
  };
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      float* c = coefficients_.data() + 12 * static_cast<std::size_t>(row * n + column);
      const float here = at(row, column);
      const float left = at(row, column - 1);
      const float right = at(row, column + 1);
      const float above = at(row - 1, column);
      const float below = at(row + 1, column);
      c[0] = here;
      c[1] = left - here;
      c[2] = right - here;
      c[3] = above - here;
      c[4] = below - here;
      c[5] = at(row - 1, column - 1) - left - above + here;
      c[6] = at(row + 1, column - 1) - left - below + here;
      c[7] = at(row - 1, column + 1) - right - above + here;
      c[8] = at(row + 1, column + 1) - right - below + here;
    }
  }
}

namespace {

/// The blur ends at this many SDs, so that a cell's grey depends on its neighbours only: 3e-5 of it
/// would lie beyond.
constexpr float kReachSd = 4.0F;

/// e to the x for x in [-8, 0], with a relative error of 3e-6: a polynomial of 2 to the fractional
/// part, the whole part put into the exponent. The library's function would not be vectorized.
inline float exponential(float x) {
  const float y = x * 1.44269504F;
  const int whole = static_cast<int>(y - 0.5F);
  const float f = y - static_cast<float>(whole);
  const float power =
      1.0F +
      f * (0.693147182F +
           f * (0.240226507F + f * (0.0555041087F + f * (0.00961812911F + f * 0.00133335581F))));
  return power * std::bit_cast<float>((whole + 127) << 23);
}

/// The fraction of a blur's footprint that lies beyond an edge at distance `f`, and its
/// derivatives. The profile is a Gaussian with excess kurtosis (the Gram-Charlier series to the
/// fourth moment), its tail after Abramowitz & Stegun 1964, 7.1.26.
struct Beyond {
  float fraction;
  float slope;
  float by_blur;
  float by_kurtosis;
  float gaussian;
};
inline Beyond beyond(float f, float inverse_sd, float excess_kurtosis) {
  const float t = std::min(f * inverse_sd, kReachSd);
  const float reached = t < kReachSd ? 1.0F : 0.0F;
  const float s = t * t;
  const float e = reached * exponential(-0.5F * s);
  const float gaussian = 0.398942280F * e;
  const float u = 1.0F / (1.0F + 0.3275911F * 0.707106781F * t);
  const float tail =
      u * (0.254829592F +
           u * (-0.284496736F + u * (1.421413741F + u * (-1.453152027F + u * 1.061405429F))));
  const float by_kurtosis = (1.0F / 24.0F) * gaussian * t * (s - 3.0F);
  const float density =
      gaussian * (1.0F + excess_kurtosis * (1.0F / 24.0F) * (3.0F + s * (s - 6.0F)));
  return {0.5F * tail * e + excess_kurtosis * by_kurtosis, density * inverse_sd, density * t,
          by_kurtosis, gaussian};
}

constexpr std::uint8_t kSaturated = 254;
/// Fractions of a cell's pixels that agree with it: below the first the cell is partly hidden,
/// above the second it is visible.
constexpr float kHiddenFraction = 0.45F;
constexpr float kFreeFraction = 0.8F;

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

/// Computes the camera's centre, the map from its rays to the tag's cells, and the part of the
/// image to look at. False if the tag is seen from behind or lies behind the camera or beside the
/// image.
bool ViewModel::place(const CameraModel& camera, const BlurredTag& tag, const CameraFromTag& pose) {
  const Vec3 t = pose.translation_m / tag.cell_m();
  const Vec3 eye = -(pose.rotation.transposed() * t);
  if (!(eye.z > 0.5) || !(t.z > 0.5)) {
    return false;
  }
  eye_cells_ = eye;
  auto ray_from_plane = matrix_as<Eigen::Matrix3d>(pose.rotation);
  ray_from_plane.col(2) = vector_as<Eigen::Vector3d>(t);
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(plane_from_ray_.data()) =
      ray_from_plane.inverse().cast<float>();
  depth_ = static_cast<float>(t.z);
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
  // An occluder covers a connected area: a cell with many outliers is doubted as a whole.
  cell_weights.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const float fraction = counted_[i] > 0.0F ? kept_[i] / counted_[i] : 1.0F;
    const float t =
        std::clamp((fraction - kHiddenFraction) / (kFreeFraction - kHiddenFraction), 0.0F, 1.0F);
    cell_weights[i] = t * t * (3.0F - 2.0F * t);
  }
}

// The contribution of a block of pixels: loops of a fixed length over separate arrays, so that they
// are vectorized.
namespace {

/// Tukey's biweight at 4.7 SD: 95 % efficient on clean noise.
constexpr float kOutlierSd = 4.7F;
/// The least slope (per cell, of the blurred template) at which a pixel is informative about the
/// pose.
constexpr float kEdgeSlope = 0.1F;
/// Below this squared slope a pixel has no influence.
constexpr float kLeastSlope2 = 1e-4F;
// Inlined also into what is compiled for AVX2.
[[gnu::always_inline]] inline float dot(const float* __restrict a, const float* __restrict b) {
  std::array<float, 8> lanes{};
  for (int i = 0; i < 64; i += 8) {
    for (std::size_t l = 0; l < 8; ++l) {
      lanes[l] += a[i + static_cast<int>(l)] * b[i + static_cast<int>(l)];
    }
  }
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
         ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

/// The model of one pixel, and its factors that the derivatives need.
struct PixelModel {
  float shade;
  float odd;     ///< 1 in black, -1 in white
  float middle;  ///< 0 in black and in white
  float answer;  ///< the sensor's response
  float base;    ///< the grey before shading
  float full;    ///< the contrast, shaded
  float g;       ///< derivative of the grey by the template
};

/// Values common to the pixels of a view: its light, and the eye in the tag's cells.
struct BlockModel {
  float black;
  float contrast;
  float slope_x;
  float slope_y;
  float bend;
  float bow;
  float ends;
  float eye_x;
  float eye_y;
  float inverse_eye;

  BlockModel(const Photometry& light, Vec3 eye_cells, float half)
      : black(static_cast<float>(light.black)),
        contrast(static_cast<float>(light.contrast)),
        slope_x(static_cast<float>(light.slope[0]) / half),
        slope_y(static_cast<float>(light.slope[1]) / half),
        bend(static_cast<float>(light.response[0])),
        bow(static_cast<float>(light.response[1])),
        ends(static_cast<float>(light.response[2])),
        eye_x(static_cast<float>(eye_cells.x)),
        eye_y(static_cast<float>(eye_cells.y)),
        inverse_eye(static_cast<float>(1.0 / eye_cells.z)) {}

  [[nodiscard]] PixelModel at(float x, float y, float white) const {
    PixelModel m;
    m.shade = 1.0F + slope_x * x - slope_y * y;
    m.odd = 1.0F - 2.0F * white;
    m.middle = white * (1.0F - white);
    m.answer = white + m.middle * (bend + m.odd * (bow + ends * m.odd));
    const float steep = 1.0F + bend * m.odd + bow * (1.0F - 6.0F * m.middle) +
                        ends * m.odd * (1.0F - 8.0F * m.middle);
    m.base = black + contrast * m.answer;
    m.full = contrast * m.shade;
    m.g = m.full * steep;
    return m;
  }
  /// Derivative of the template by the tag's distance.
  [[nodiscard]] float by_depth(float x, float y, float tx, float ty) const {
    return inverse_eye * ((eye_x - x) * tx + (eye_y - y) * ty);
  }
};

}  // namespace

/// The model at every pixel, the residual, and the columns of the Jacobian (photometric_view.h).
ORTHONAV_WIDE void ViewModel::compare(const Photometry& light) {
  const auto column = [this](int c) { return block_.data() + c * kBlock; };
  const float* __restrict grey = column(kGrey);
  const float* __restrict x = column(kBx);
  const float* __restrict y = column(kBy);
  const float* __restrict white = column(kT);
  const float* __restrict tx = column(kTx);
  const float* __restrict ty = column(kTy);
  const float* __restrict tsx = column(kTsx);
  const float* __restrict tsy = column(kTsy);
  const float* __restrict ttx = column(kTtx);
  const float* __restrict tty = column(kTty);
  const float* __restrict tc = column(kTc);
  float* __restrict j = column(kFirst);
  const BlockModel model(light, eye_cells_, half_);
  const float inverse_half = 1.0F / half_;
  for (int k = 0; k < kBlock; ++k) {
    const PixelModel m = model.at(x[k], y[k], white[k]);
    const float s = model.by_depth(x[k], y[k], tx[k], ty[k]);
    j[0 * kBlock + k] = -m.g * tx[k];
    j[1 * kBlock + k] = -m.g * ty[k];
    j[2 * kBlock + k] = m.g * s;
    j[3 * kBlock + k] = m.g * s * y[k];
    j[4 * kBlock + k] = -m.g * s * x[k];
    j[5 * kBlock + k] = m.g * (tx[k] * y[k] - ty[k] * x[k]);
    j[6 * kBlock + k] = m.shade;
    j[7 * kBlock + k] = m.shade * m.answer;
    j[8 * kBlock + k] = m.base * x[k] * inverse_half;
    j[9 * kBlock + k] = -m.base * y[k] * inverse_half;
    j[10 * kBlock + k] = m.g * tsx[k];
    j[11 * kBlock + k] = m.g * tsy[k];
    j[12 * kBlock + k] = m.g * ttx[k];
    j[13 * kBlock + k] = m.g * tty[k];
    j[14 * kBlock + k] = m.g * tc[k];
    j[15 * kBlock + k] = m.full * m.middle;
    j[16 * kBlock + k] = m.full * m.middle * m.odd;
    j[17 * kBlock + k] = m.full * m.middle * m.odd * m.odd;
    j[18 * kBlock + k] = grey[k] - m.base * m.shade;
  }
}

/// Robust weights, allowing for noise and doubt.
void ViewModel::weigh(const Photometry& light, double doubt_cells) {
  const auto column = [this](int c) { return block_.data() + c * kBlock; };
  const float* __restrict white = column(kT);
  const float* __restrict tx = column(kTx);
  const float* __restrict ty = column(kTy);
  const float* __restrict residual = column(kFirst + static_cast<int>(kColumns));
  float* __restrict noise = column(kVariance);
  float* __restrict slope2 = column(kSlope2);
  float* __restrict kept = column(kKept);
  float* __restrict weight = column(kWeight);
  std::array<float, kBlock> belief;
  for (std::size_t k = 0; k < kBlock; ++k) {
    belief[k] = believed_[cell_[k]];
  }
  const auto dark = static_cast<float>(light.variance[0]);
  const auto more = static_cast<float>(light.variance[1] - light.variance[0]);
  const auto doubt =
      static_cast<float>(std::pow(light.contrast * doubt_cells, 2) + light.edge_variance);
  const float limit = 1.0F / (kOutlierSd * kOutlierSd);
  for (int k = 0; k < kBlock; ++k) {
    const float variance = dark + more * white[k];
    noise[k] = variance;
    slope2[k] = tx[k] * tx[k] + ty[k] * ty[k];
    const float allowed = variance + doubt * slope2[k];
    const float t = std::max(1.0F - limit * residual[k] * residual[k] / allowed, 0.0F);
    kept[k] = t * t;
    weight[k] = belief[static_cast<std::size_t>(k)] * kept[k] / variance;
  }
}

ORTHONAV_WIDE void ViewModel::sum_up(ViewEquations& out) const {
  const float* weight = block_.data() + kWeight * kBlock;
  const float* j = block_.data() + kFirst * kBlock;
  std::array<float, kBlock> weighted;
  std::size_t place = 0;
  for (std::size_t a = 0; a <= kColumns; ++a) {
    const float* ja = j + a * kBlock;
    for (std::size_t k = 0; k < kBlock; ++k) {
      weighted[k] = weight[k] * ja[k];
    }
    for (std::size_t c = a; c <= kColumns; ++c) {
      out.sums[place++] += static_cast<double>(dot(weighted.data(), j + c * kBlock));
    }
  }
}

void ViewModel::count(int pixels, ViewEquations& out) {
  const auto column = [this](int c) { return block_.data() + c * kBlock; };
  const float* residual = column(kFirst + static_cast<int>(kColumns));
  for (int k = 0; k < pixels; ++k) {
    const std::size_t cell = cell_[static_cast<std::size_t>(k)];
    const float here = column(kKept)[k];
    counted_[cell] += 1.0F;
    kept_[cell] += here;
    const auto kept = static_cast<double>(believed_[cell] * here);
    const auto squared = static_cast<double>(residual[k] * residual[k]);
    out.pixels += 1.0;
    out.kept += kept;
    const auto white = static_cast<double>(column(kT)[k]);
    const auto slope2 = static_cast<double>(column(kSlope2)[k]);
    out.edge_squares += kept * slope2 * (squared - static_cast<double>(column(kVariance)[k]));
    out.edge_fractions += kept * slope2 * slope2;
    const double steep = slope2 / (kEdgeSlope * kEdgeSlope);
    const double flat = kept / (1.0 + steep * steep);
    out.squares[0] += flat * (1.0 - white) * squared;
    out.squares[1] += flat * white * squared;
    out.fractions[0] += flat * (1.0 - white) * (1.0 - white);
    out.fractions[1] += flat * (1.0 - white) * white;
    out.fractions[2] += flat * white * white;
  }
}

/// Pieces are centred on the corners of the cells, so that both sides of an edge are in one piece.
void ViewModel::score(int pixels) {
  const auto column = [this](int c) { return block_.data() + c * kBlock; };
  const float* residual = column(kFirst + static_cast<int>(kColumns));
  for (int k = 0; k < pixels; ++k) {
    if (column(kSlope2)[k] < kLeastSlope2) {
      continue;
    }
    const auto across = static_cast<int>((column(kBx)[k] + half_ + 0.5F) / kPieceCells);
    const auto down = static_cast<int>((half_ - column(kBy)[k] + 0.5F) / kPieceCells);
    float* out =
        scores_.data() + static_cast<std::size_t>(down * pieces_across() + across) * kColumns;
    const float pull = column(kWeight)[k] * residual[k];
    const float* j = column(kFirst) + k;
    for (std::size_t i = 0; i < kColumns; ++i) {
      out[i] += pull * j[i * kBlock];
    }
  }
}

void ViewModel::finish(const Photometry& light, double doubt_cells, ViewEquations& out) {
  const int n = filled_;
  filled_ = 0;
  if (n == 0) {
    return;
  }
  // Leftovers of an earlier block get no weight, and may be of a tag with more cells.
  std::fill(cell_.begin() + n, cell_.end(), std::uint16_t{0});
  compare(light);
  weigh(light, doubt_cells);
  float* weight = block_.data() + kWeight * kBlock;
  std::fill(weight + n, weight + kBlock, 0.0F);
  sum_up(out);
  count(n, out);
  score(n);
}

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr int kLight = static_cast<int>(kLightColumns);
using LightMatrix = Eigen::Matrix<double, kLight, kLight>;
using LightVector = Eigen::Matrix<double, kLight, 1>;

constexpr double kBlurFloorPx = 0.25;
constexpr double kBlurCeilingCells = 0.6;
/// Largest change at once of a logarithm of blur, or of a fraction of grey.
constexpr double kLargestLightStep = 0.5;
constexpr double kVarianceFloor = 0.3;
/// With fewer black or white pixels, their noise is not updated.
constexpr double kFewestFractions = 20.0;
/// Neither black nor white gets less than this fraction of the mean noise.
constexpr double kLeastOfMean = 0.25;
/// The fraction of clean noise's variance that remains under the robust weights: E[w r²] / (E[w]
/// σ²) of Tukey's biweight at 4.7 SD.
constexpr double kRobustVariance = 0.829;
/// The scatter of clean noise after robust weighting, where without weights it would be 1: 0.72
/// from the biweight's moments (E[psi^2] E[w] / E[psi']^2), the rest as measured.
constexpr double kCleanScatter = 0.82;

double bounded(double v, double limit) { return std::clamp(v, -limit, limit); }

/// A view's normal equations by pose and light, with weak priors on the light, which keep a view
/// without white cells or without edges solvable.
struct Split {
  Matrix6 pose;
  LightMatrix light;
  Eigen::Matrix<double, 6, kLight> cross;
  Vector6 pose_right;
  LightVector light_right;

  Split(const ViewEquations& e, const Photometry& known) {
    const auto at = [&](int r, int c) {
      return e.sum(static_cast<std::size_t>(std::min(r, c)),
                   static_cast<std::size_t>(std::max(r, c)));
    };
    constexpr int kRight = static_cast<int>(kColumns);
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        pose(r, c) = at(r, c);
      }
      for (int c = 0; c < kLight; ++c) {
        cross(r, c) = at(r, 6 + c);
      }
      pose_right(r) = at(r, kRight);
    }
    for (int r = 0; r < kLight; ++r) {
      for (int c = 0; c < kLight; ++c) {
        light(r, c) = at(6 + r, 6 + c);
      }
      light_right(r) = at(6 + r, kRight);
    }
    const auto prior = [&](int i, double sd, double about_zero) {
      light(i, i) += 1.0 / (sd * sd);
      light_right(i) += -about_zero / (sd * sd);
    };
    prior(0, 500.0, 0.0);
    prior(1, 500.0, 0.0);
    prior(2, 0.3, known.slope[0]);
    prior(3, 0.3, known.slope[1]);
    prior(4, 0.5, 0.0);
    prior(5, 0.5, 0.0);
    prior(6, 1.0, known.excess_kurtosis[0]);
    prior(7, 1.0, known.excess_kurtosis[1]);
    prior(8, 0.3, known.blur_correlation);
    for (int i = 0; i < 3; ++i) {
      prior(9 + i, 0.5, known.response[static_cast<std::size_t>(i)]);
    }
  }
};

/// The pose's equations without the light, and how the light changes with a small motion of the
/// tag.
struct Eliminated {
  Split split;
  Eigen::LLT<LightMatrix> light;
  Eigen::Matrix<double, kLight, 6> gain;
  Matrix6 normal;

  Eliminated(const ViewEquations& e, const Photometry& known) : split(e, known) {
    light.compute(split.light);
    gain = light.solve(split.cross.transpose());
    normal = split.pose - split.cross * gain;
  }
};

ReducedView reduced(const ViewEquations& equations, const Photometry& known) {
  const Eliminated e(equations, known);
  const double trust = 1.0 / std::max(known.sandwich_factor, 1.0);
  ReducedView view;
  Eigen::Map<Matrix6>(view.normal.data()) = trust * e.normal;
  Eigen::Map<Vector6>(view.right.data()) =
      trust * (e.split.pose_right - e.split.cross * e.light.solve(e.split.light_right));
  return view;
}

/// How much more strongly the pieces of the tag's edges pull at the pose than noise alone would: 1
/// if the model is right. `scores` are the pulls, as in `ViewModel::scores`. (White's sandwich,
/// Econometrica 48, 1980, with a piece of an edge as a cluster, reduced to one number.)
double sandwich_factor(const ViewEquations& equations, const Photometry& known,
                       std::span<const float> scores) {
  const Eliminated e(equations, known);
  const Eigen::LLT<Matrix6> pose(e.normal);
  if (pose.info() != Eigen::Success) {
    return 1.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i + kColumns <= scores.size(); i += kColumns) {
    const Eigen::Map<const Eigen::Matrix<float, 6, 1>> of_pose(scores.data() + i);
    const Eigen::Map<const Eigen::Matrix<float, kLight, 1>> of_light(scores.data() + i +
                                                                     kPoseColumns);
    const Vector6 pull = of_pose.cast<double>() - e.gain.transpose() * of_light.cast<double>();
    sum += pose.matrixL().solve(pull).squaredNorm();
  }
  return sum / (6.0 * kCleanScatter);
}

/// Changes the light by the step that belongs to a motion of the tag, within physical limits of
/// light and lenses.
void update_light(const ViewEquations& equations, const Vector6& of_tag, double px_a_cell,
                  Photometry& light) {
  const Split s(equations, light);
  const LightVector step = s.light.llt().solve(s.light_right - s.cross.transpose() * of_tag);
  light.black += bounded(step[0], 100.0);
  light.contrast = std::clamp(light.contrast + bounded(step[1], 150.0), 5.0, 400.0);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    light.slope[i] = std::clamp(light.slope[i] + step[2 + k], -0.8, 0.8);
    light.blur_cells[i] =
        std::clamp(light.blur_cells[i] * std::exp(bounded(step[4 + k], kLargestLightStep)),
                   kBlurFloorPx / px_a_cell, kBlurCeilingCells);
    light.excess_kurtosis[i] =
        std::clamp(light.excess_kurtosis[i] + bounded(step[6 + k], 1.0), -1.2, 3.0);
  }
  light.blur_correlation = std::clamp(light.blur_correlation + bounded(step[8], 0.5), -0.8, 0.8);
  // Stays well away from where the response would no longer rise everywhere.
  for (std::size_t i = 0; i < light.response.size(); ++i) {
    light.response[i] = std::clamp(
        light.response[i] + bounded(step[9 + static_cast<Eigen::Index>(i)], 0.3), -0.9, 0.9);
  }
}

/// Updates noise and scatter about the model: `fraction` of the remembered value comes from these
/// residuals.
void learn_noise(const ViewEquations& e, double fraction, Photometry& light) {
  // Inverses are averaged, since an occasional pair has a large value.
  if (e.sandwich_factor > 0.0) {
    light.sandwich_factor =
        1.0 / ((1.0 - fraction) / light.sandwich_factor + fraction / e.sandwich_factor);
  }
  if (e.edge_fractions > 0.0) {
    light.edge_variance = (1.0 - fraction) * light.edge_variance +
                          fraction * std::max(e.edge_squares / e.edge_fractions, 0.0);
  }
  const auto [black, both, white] = e.fractions;
  const double determinant = black * white - both * both;
  if (black < kFewestFractions || white < kFewestFractions || !(determinant > 0.0)) {
    return;
  }
  const double mean = (e.squares[0] + e.squares[1]) / (black + 2.0 * both + white);
  const std::array<double, 2> solved{(white * e.squares[0] - both * e.squares[1]) / determinant,
                                     (black * e.squares[1] - both * e.squares[0]) / determinant};
  for (std::size_t side = 0; side < 2; ++side) {
    const double found = std::max(solved[side], kLeastOfMean * mean) / kRobustVariance;
    light.variance[side] =
        std::max(kVarianceFloor, (1.0 - fraction) * light.variance[side] + fraction * found);
  }
}

constexpr int kFitMaxIterations = 10;
/// A smaller correction ends the search: a small part of the pose's noise.
constexpr double kFitLastStep_px = 0.02;
/// A view is not used if less of the tag than this agrees with its template.
constexpr double kMinKeptFraction = 0.45;
constexpr double kMinContrast_grey = 12.0;
constexpr double kLargestStepCells = 0.5;
constexpr double kNoiseFraction = 0.3;  ///< weight of the newest pair in the remembered noise
constexpr int kNewLightIterations = 5;
constexpr double kFewestPixels = 30.0;
/// The fraction of a step's length that remains for the steps after it.
constexpr double kLeftOfStep = 0.3;
/// Remaining doubt after convergence, due to noise.
constexpr double kSettledPx = 0.05;

/// The derivative of a small motion of the tag (in its frame, in cells) by a small motion of the
/// tool (in its own frame, in metres).
Matrix6 tag_by_tool(const Transform<Marker, Tag>& marker_from_tag, double cell_m) {
  Matrix6 out = Matrix6::Zero();
  const auto r = matrix_as<Eigen::Matrix3d>(marker_from_tag.rotation().transposed());
  const auto cross = skew_as<Eigen::Matrix3d>(marker_from_tag.translation());
  out.topLeftCorner<3, 3>() = r / cell_m;
  out.topRightCorner<3, 3>() = -r * cross / cell_m;
  out.bottomRightCorner<3, 3>() = r;
  return out;
}

/// Least squares of the tool's motion over the views.
struct MotionEquations {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();

  /// A view's equations, its light eliminated.
  void add(const TagView& view, const ViewEquations& of_view) {
    const Matrix6 motion = tag_by_tool(view.marker_from_tag, view.tag->cell_m());
    const ReducedView own = reduced(of_view, view.light);
    const Eigen::Map<const Matrix6> own_normal(own.normal.data());
    const Eigen::Map<const Vector6> own_right(own.right.data());
    normal += motion.transpose() * own_normal * motion;
    right += motion.transpose() * own_right;
  }
  /// False if the views do not determine the motion.
  bool solve(Vector6& motion, PoseCovariance& covariance) const {
    const Eigen::LDLT<Matrix6> solver(normal);
    motion = solver.solve(right);
    if (solver.info() != Eigen::Success || !motion.allFinite() || !solver.isPositive()) {
      return false;
    }
    covariance = symmetrized(Matrix6(solver.solve(Matrix6::Identity())));
    return true;
  }
};

/// The derivative of a tag's apparent motion (in its frame, in cells) by the errors of the
/// calibration, in the order of `CalibrationEquations`. `baseline_m`: from the right camera to the
/// left one; null for the left camera, which is taken as reported.
Matrix6 tag_by_calibration(const CameraFromTag& pose, const Vec3* baseline_m, double cell_m) {
  Matrix6 out = Matrix6::Zero();
  const Mat3 back = pose.rotation.transposed();
  const Vec3 place_m = pose.translation_m;
  const auto moves = [&](std::size_t unknown, Vec3 translation_m) {
    const Vec3 translation = back * translation_m / cell_m;
    out.col(static_cast<int>(unknown)).head<3>() << translation.x, translation.y, translation.z;
  };
  if (baseline_m != nullptr) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 unit_rotation{};
      unit_rotation[axis] = 1.0;
      moves(static_cast<std::size_t>(axis), unit_rotation.cross(place_m));
      const Vec3 rotation = back * unit_rotation;
      out.col(axis).tail<3>() << rotation.x, rotation.y, rotation.z;
    }
    // A magnified tag appears nearer along the optical axis by the same fraction.
    moves(kFocalUnknown, {0.0, 0.0, -place_m.z});
    moves(kBaselineUnknown, *baseline_m);
  }
  // A larger tag appears nearer by the same fraction.
  moves(kTagSizeUnknown, -place_m);
  return out;
}

}  // namespace

PhotometricSolver::PhotometricSolver(const StereoCalibration& calibration)
    : calibration_(calibration),
      left_rays_(std::make_shared<RayTable>(calibration_.left)),
      right_rays_(std::make_shared<RayTable>(calibration_.right)) {}

CameraFromTag PhotometricSolver::camera_from_tag(const TagView& view,
                                                 const Transform<Rig, Marker>& pose) const {
  const Transform<Rig, Tag> rig_from_tag = pose * view.marker_from_tag;
  if (view.right) {
    const auto seen = calibration_.right_from_rig * rig_from_tag;
    return {seen.rotation(), seen.translation()};
  }
  const auto seen = calibration_.left_from_rig * rig_from_tag;
  return {seen.rotation(), seen.translation()};
}

double PhotometricSolver::pixels_a_metre(const TagView& view,
                                         const Transform<Rig, Marker>& pose) const {
  return focal_px(view.right) / std::max(camera_from_tag(view, pose).translation_m.z, 1e-3);
}

std::optional<PhotometricSolver::Step> PhotometricSolver::step(const StereoFrame& frame,
                                                               double doubt_m,
                                                               std::span<TagView> views,
                                                               PhotometricFit& fit) {
  const Transform<Rig, Marker> pose = fit.rig_from_marker;
  MotionEquations equations;
  Step out;
  double cell_m = 1.0;  // of the smallest tag
  fit.views = 0;
  fit.left = fit.right = false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    TagView& view = views[i];
    if (!view.used) {
      continue;
    }
    const BlurredTag& tag = *view.tag;
    ViewEquations& e = equations_[i];
    model_.linearize(view.right ? frame.right : frame.left,
                     view.right ? calibration_.right : calibration_.left,
                     view.right ? *right_rays_ : *left_rays_, tag, camera_from_tag(view, pose),
                     view.light, doubt_m / tag.cell_m(), view.cell_weights, e);
    e.sandwich_factor = sandwich_factor(e, view.light, model_.scores());
    view.kept_fraction = e.pixels > 0.0 ? e.kept / e.pixels : 0.0;
    view.used = e.pixels >= kFewestPixels && view.kept_fraction >= kMinKeptFraction &&
                view.light.contrast >= kMinContrast_grey;
    if (!view.used) {
      continue;
    }
    equations.add(view, e);
    ++fit.views;
    (view.right ? fit.right : fit.left) = true;
    out.pixels_a_metre = std::max(out.pixels_a_metre, pixels_a_metre(view, pose));
    cell_m = std::min(cell_m, tag.cell_m());
  }
  Vector6 motion;
  if (fit.views == 0 || !equations.solve(motion, fit.covariance)) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    TagView& view = views[i];
    if (view.used) {
      const double own_m = view.tag->cell_m();
      update_light(equations_[i], tag_by_tool(view.marker_from_tag, own_m) * motion,
                   own_m * pixels_a_metre(view, pose), view.light);
    }
  }
  // Displacement of the farthest cells, by translation and by rotation.
  out.size_m = std::max(motion.head<3>().norm(), motion.tail<3>().norm() * 4.0 * cell_m);
  const double limit_m = kLargestStepCells * cell_m;
  if (out.size_m > limit_m) {
    motion *= limit_m / out.size_m;
    out.size_m = limit_m;
  }
  // In the tool's own frame.
  const Mat3 turn = rotation_from_vector({motion[3], motion[4], motion[5]});
  fit.rig_from_marker = {
      orthonormalized(pose.rotation() * turn),
      pose.translation() + pose.rotation() * Vec3{motion[0], motion[1], motion[2]}};
  return out;
}

std::optional<PhotometricFit> PhotometricSolver::solve(const StereoFrame& frame,
                                                       const Transform<Rig, Marker>& start,
                                                       double doubt_m, std::span<TagView> views) {
  PhotometricFit fit;
  fit.rig_from_marker = start;
  equations_.resize(views.size());
  double doubt = doubt_m;
  for (TagView& view : views) {
    view.cell_weights.clear();
  }
  while (fit.iterations < kFitMaxIterations) {
    const auto taken = step(frame, doubt, views, fit);
    if (!taken) {
      return std::nullopt;
    }
    ++fit.iterations;
    doubt =
        std::max(std::min(kLeftOfStep * taken->size_m, doubt), kSettledPx / taken->pixels_a_metre);
    // A new light is learnt during the fit: its initial error is not noise.
    bool all_known = true;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (views[i].used && !views[i].light.known) {
        all_known = false;
        learn_noise(equations_[i], 1.0, views[i].light);
      }
    }
    const int least = all_known ? 2 : kNewLightIterations;
    if (taken->size_m * taken->pixels_a_metre < kFitLastStep_px && fit.iterations >= least) {
      break;
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].used) {
      continue;
    }
    if (views[i].light.known) {
      learn_noise(equations_[i], kNoiseFraction, views[i].light);
    }
    views[i].light.known = true;
  }
  return fit;
}

std::optional<CalibrationEquations> PhotometricSolver::calibration_equations(
    const PhotometricFit& fit, std::span<const TagView> views) const {
  if (!fit.left || !fit.right || equations_.size() != views.size()) {
    return std::nullopt;
  }
  CalibrationEquations out;
  for (std::size_t l = 0; l < views.size(); ++l) {
    std::size_t r = 0;
    while (r < views.size() && !(views[r].right && views[r].used && views[r].tag == views[l].tag)) {
      ++r;
    }
    if (!views[l].right && views[l].used && r < views.size()) {
      add_tag(fit.rig_from_marker, views[l], view_equations(l, views[l]), views[r],
              view_equations(r, views[r]), out);
    }
  }
  return out.tags > 0 ? std::optional(out) : std::nullopt;
}

ReducedView PhotometricSolver::view_equations(std::size_t index, const TagView& view) const {
  return reduced(equations_.at(index), view.light);
}

ReducedView PhotometricSolver::shifted(const TagView& view, const ReducedView& at_best,
                                       const Transform<Rig, Marker>& best,
                                       const Transform<Rig, Marker>& pose) {
  const Transform<Marker, Marker> apart = pose.inverse() * best;
  const Vec3 turn = vector_from_rotation(apart.rotation());
  Vector6 motion;
  motion << apart.translation().x, apart.translation().y, apart.translation().z, turn.x, turn.y,
      turn.z;
  ReducedView out = at_best;
  Eigen::Map<Vector6>(out.right.data()) +=
      Eigen::Map<const Matrix6>(at_best.normal.data()) *
      (tag_by_tool(view.marker_from_tag, view.tag->cell_m()) * motion);
  return out;
}

/// The tag has its own pose: how it is mounted says nothing about the cameras.
void PhotometricSolver::add_tag(const Transform<Rig, Marker>& pose, const TagView& left,
                                const ReducedView& of_left, const TagView& right,
                                const ReducedView& of_right, CalibrationEquations& out) const {
  const Vec3 baseline_m =
      (calibration_.right_from_rig * calibration_.left_from_rig.inverse()).translation();
  Eigen::Map<Matrix6> information(out.information.data());
  Eigen::Map<Vector6> gradient(out.right.data());
  MotionEquations both;
  Matrix6 cross = Matrix6::Zero();
  double alone = 0.0;  // by which the error falls with a pose for each camera
  for (const bool is_right : {false, true}) {
    const TagView& view = is_right ? right : left;
    const ReducedView& own = is_right ? of_right : of_left;
    const Eigen::Map<const Matrix6> own_normal(own.normal.data());
    const Eigen::Map<const Vector6> own_right(own.right.data());
    const double cell_m = view.tag->cell_m();
    const Matrix6 motion = tag_by_tool(view.marker_from_tag, cell_m);
    const Matrix6 by_calibration =
        tag_by_calibration(camera_from_tag(view, pose), is_right ? &baseline_m : nullptr, cell_m);
    both.normal += motion.transpose() * own_normal * motion;
    both.right += motion.transpose() * own_right;
    cross += motion.transpose() * own_normal * by_calibration;
    information += by_calibration.transpose() * own_normal * by_calibration;
    gradient += by_calibration.transpose() * own_right;
    alone += own_right.dot(own_normal.ldlt().solve(own_right));
  }
  const Eigen::LDLT<Matrix6> solver(both.normal);
  const Vector6 step = solver.solve(both.right);
  information -= cross.transpose() * solver.solve(cross);
  gradient -= cross.transpose() * step;
  out.contradiction += alone - both.right.dot(step);
  ++out.tags;
}

}  // namespace orthonav::nav

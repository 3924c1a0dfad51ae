#include "nav/tracking/photometric_view.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// The blur's profile is (1 - t²)³ over ±3 SD: within 1 % of a Gaussian's, a polynomial, and zero
/// beyond, so that a cell's grey depends on its neighbours alone.
constexpr float kReachSd = 3.0F;
constexpr float kDensity = 35.0F / 32.0F;
/// Tukey's biweight at 4.7 SD: 95 % efficient on clean noise.
constexpr float kOutlierSd = 4.7F;
constexpr std::uint8_t kSaturated = 254;
/// Of areas without edges every so many columns and rows suffice: they tell the light only.
constexpr int kFlatStep = 2;
/// A slope (per cell, of the blurred template) from which on a pixel tells something of the pose.
constexpr float kEdgeSlope = 0.1F;
/// Where a corner lies outside the image, its place is known roughly.
constexpr double kRoughPx = 24.0;

/// Columns of what one row of pixels needs.
enum RowColumn {
  kX,
  kY,
  kColumn,
  kLx,
  kHx,
  kDx,
  kDhx,
  kEx,
  kEhx,
  kRow,
  kLy,
  kHy,
  kDy,
  kDhy,
  kEy,
  kEhy,
  kRowColumns
};
/// And of a block of pixels that are compared.
enum BlockColumn {
  kGrey,
  kBx,
  kBy,
  kT,
  kTx,
  kTy,
  kTsx,
  kTsy,
  kWeight,
  kFirst,
  kBlockColumns = kFirst + kColumns + 1
};

/// How much of the footprint lies beyond an edge at distance `f`, and its derivatives by the
/// distance and by the logarithm of the blur.
struct Beyond {
  float share;
  float slope;
  float by_blur;
};
inline Beyond beyond(float f, float inverse_reach) {
  const float t = std::min(f * inverse_reach, 1.0F);
  const float s = t * t;
  const float r = 1.0F - s;
  const float density = kDensity * r * r * r;
  const float share = 0.5F - kDensity * t * (1.0F - s * (1.0F - s * (0.6F - s * (1.0F / 7.0F))));
  return {std::max(share, 0.0F), density * inverse_reach, density * t};
}

/// Along one axis: index of the cell, and what lies beyond its low and its high edge.
void along(const float* __restrict place, const float* __restrict scale, int n, float half,
           float inverse_reach, float* __restrict out, std::ptrdiff_t stride) {
  float* __restrict index = out;
  float* __restrict low = out + stride;
  float* __restrict high = out + 2 * stride;
  float* __restrict d_low = out + 3 * stride;
  float* __restrict d_high = out + 4 * stride;
  float* __restrict e_low = out + 5 * stride;
  float* __restrict e_high = out + 6 * stride;
  for (int i = 0; i < n; ++i) {
    // In this order a place that is not a number becomes the low end.
    const float c = std::min(std::max(0.0F, place[i] + half), 2.0F * half - 1e-4F);
    const float cell = static_cast<float>(static_cast<int>(c));
    const float f = c - cell;
    const float inverse = inverse_reach * scale[i];
    const Beyond lower = beyond(f, inverse);
    const Beyond upper = beyond(1.0F - f, inverse);
    index[i] = cell;
    low[i] = lower.share;
    high[i] = upper.share;
    d_low[i] = -lower.slope;
    d_high[i] = upper.slope;
    e_low[i] = lower.by_blur;
    e_high[i] = upper.by_blur;
  }
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

float dot(const float* __restrict a, const float* __restrict b) {
  std::array<float, 8> lanes{};
  for (int i = 0; i < 64; i += 8)
    for (std::size_t l = 0; l < 8; ++l)
      lanes[l] += a[i + static_cast<int>(l)] * b[i + static_cast<int>(l)];
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
         ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
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
}

BlurredTag::BlurredTag(TagTemplate tag, double size_m)
    : tag_(std::move(tag)), cell_m_(tag_.cell_m(size_m)) {
  const int n = tag_.cells;
  coefficients_.assign(static_cast<std::size_t>(12 * n * n), 0.0F);
  const auto at = [&](int row, int column) {
    return tag_.at(std::clamp(row, 0, n - 1), std::clamp(column, 0, n - 1));
  };
  for (int row = 0; row < n; ++row)
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

ViewModel::ViewModel() : block_(static_cast<std::size_t>(kBlockColumns) * kBlock, 0.0F) {}

bool ViewModel::place(const CameraModel& camera, const BlurredTag& tag, const CameraFromTag& pose) {
  const double cell = tag.cell_m();
  const Vec3 t = pose.translation_m / cell;
  const Vec3 eye = -(pose.rotation.transposed() * t);
  if (!(eye.z > 0.5) || !(t.z > 0.5)) return false;  // from behind, or behind the camera
  eye_cells_ = eye;
  const Mat3 inverse =
      inverse_of(Mat3::from_columns(pose.rotation.column(0), pose.rotation.column(1), t));
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      plane_from_ray_[static_cast<std::size_t>(3 * r + c)] =
          static_cast<float>(inverse[r][static_cast<std::size_t>(c)]);
  depth_ = static_cast<float>(t.z);
  half_ = 0.5F * static_cast<float>(tag.cells().cells);
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0}) {
      const Vec3 p = pose.rotation * Vec3{sx * half_, sy * half_, 0.0} + t;
      if (!(p.z > 0.5)) return false;
      const Vec2 u{p.x / p.z, p.y / p.z};
      const auto seen = camera.project(u);
      const Vec2 pixel = seen ? *seen : rough_pixel(camera, u);
      const double room = seen ? 0.0 : kRoughPx;
      low = {std::min(low.x, pixel.x - room), std::min(low.y, pixel.y - room)};
      high = {std::max(high.x, pixel.x + room), std::max(high.y, pixel.y + room)};
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

void ViewModel::spread(const RayTable& rays, int y, const Photometry& light) {
  const int n = x1_ - x0_;
  const std::ptrdiff_t stride = n;
  if (row_.size() < static_cast<std::size_t>((kRowColumns + 1) * n))
    row_.resize(static_cast<std::size_t>((kRowColumns + 1) * std::max(n, rays.width_px)));
  const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(rays.width_px) +
                            static_cast<std::size_t>(x0_);
  const float* __restrict ray_x = rays.x.data() + start;
  const float* __restrict ray_y = rays.y.data() + start;
  float* __restrict across = row_.data() + kX * stride;
  float* __restrict up = row_.data() + kY * stride;
  float* __restrict scale = row_.data() + kRowColumns * stride;
  const std::array<float, 9> m = plane_from_ray_;
  for (int i = 0; i < n; ++i) {
    const float w = m[6] * ray_x[i] + m[7] * ray_y[i] + m[8];
    const float depth = 1.0F / w;
    across[i] = (m[0] * ray_x[i] + m[1] * ray_y[i] + m[2]) * depth;
    up[i] = (m[3] * ray_x[i] + m[4] * ray_y[i] + m[5]) * depth;
    scale[i] = depth_ * w;  // the blur covers more cells where the tag is farther
  }
  // Rows count downwards.
  float* __restrict down = row_.data() + kRow * stride;
  for (int i = 0; i < n; ++i) down[i] = -up[i];
  along(across, scale, n, half_, static_cast<float>(1.0 / (kReachSd * light.blur_cells[0])),
        row_.data() + kColumn * stride, stride);
  along(row_.data() + kRow * stride, scale, n, half_,
        static_cast<float>(1.0 / (kReachSd * light.blur_cells[1])), row_.data() + kRow * stride,
        stride);
}

void ViewModel::add(int k, int x, std::uint8_t grey, const float* c) {
  const std::ptrdiff_t stride = x1_ - x0_;
  const auto row = [&](int column) { return row_[static_cast<std::size_t>(column * stride + x)]; };
  float* out = block_.data() + k;
  const float lx = row(kLx);
  const float hx = row(kHx);
  const float ly = row(kLy);
  const float hy = row(kHy);
  const float left = c[1] + ly * c[5] + hy * c[6];
  const float right = c[2] + ly * c[7] + hy * c[8];
  const float above = c[3] + lx * c[5] + hx * c[7];
  const float below = c[4] + lx * c[6] + hx * c[8];
  out[kGrey * kBlock] = grey;
  out[kBx * kBlock] = row(kX);
  out[kBy * kBlock] = row(kY);
  out[kT * kBlock] = c[0] + lx * left + hx * right + ly * c[3] + hy * c[4];
  out[kTx * kBlock] = row(kDx) * left + row(kDhx) * right;
  out[kTy * kBlock] = -(row(kDy) * above + row(kDhy) * below);
  out[kTsx * kBlock] = row(kEx) * left + row(kEhx) * right;
  out[kTsy * kBlock] = row(kEy) * above + row(kEhy) * below;
}

void ViewModel::finish(const Photometry& light, double doubt_cells, ViewEquations& out) {
  const int n = filled_;
  filled_ = 0;
  if (n == 0) return;
  float* const b = block_.data();
  const auto column = [&](int c) { return b + c * kBlock; };
  const float* __restrict grey = column(kGrey);
  const float* __restrict x = column(kBx);
  const float* __restrict y = column(kBy);
  const float* __restrict white = column(kT);
  const float* __restrict tx = column(kTx);
  const float* __restrict ty = column(kTy);
  const float* __restrict tsx = column(kTsx);
  const float* __restrict tsy = column(kTsy);
  float* __restrict weight = column(kWeight);
  float* __restrict j = column(kFirst);
  const float black = static_cast<float>(light.black);
  const float contrast = static_cast<float>(light.contrast);
  const float slope_x = static_cast<float>(light.slope[0]) / half_;
  const float slope_y = static_cast<float>(light.slope[1]) / half_;
  const float dark = static_cast<float>(light.variance[0]);
  const float more = static_cast<float>(light.variance[1] - light.variance[0]);
  const float doubt = static_cast<float>(doubt_cells * doubt_cells);
  const float limit = 1.0F / (kOutlierSd * kOutlierSd);
  const float inverse_half = 1.0F / half_;
  const float eye_x = static_cast<float>(eye_cells_.x);
  const float eye_y = static_cast<float>(eye_cells_.y);
  const float inverse_eye = static_cast<float>(1.0 / eye_cells_.z);
  std::array<float, kBlock> tukey;
  std::array<float, kBlock> steep;
  for (int k = 0; k < kBlock; ++k) {
    const float shade = 1.0F + slope_x * x[k] - slope_y * y[k];
    const float base = black + contrast * white[k];
    const float g = contrast * shade;
    const float r = grey[k] - base * shade;
    const float variance = dark + more * white[k];
    const float slope = tx[k] * tx[k] + ty[k] * ty[k];
    const float allowed = variance + g * g * doubt * slope;
    const float t = std::max(1.0F - limit * r * r / allowed, 0.0F);
    const float kept = k < n ? t * t : 0.0F;
    tukey[static_cast<std::size_t>(k)] = kept;
    steep[static_cast<std::size_t>(k)] = slope;
    weight[k] = kept / variance;
    const float s = inverse_eye * ((eye_x - x[k]) * tx[k] + (eye_y - y[k]) * ty[k]);
    j[0 * kBlock + k] = -g * tx[k];
    j[1 * kBlock + k] = -g * ty[k];
    j[2 * kBlock + k] = g * s;
    j[3 * kBlock + k] = g * s * y[k];
    j[4 * kBlock + k] = -g * s * x[k];
    j[5 * kBlock + k] = g * (tx[k] * y[k] - ty[k] * x[k]);
    j[6 * kBlock + k] = shade;
    j[7 * kBlock + k] = shade * white[k];
    j[8 * kBlock + k] = base * x[k] * inverse_half;
    j[9 * kBlock + k] = -base * y[k] * inverse_half;
    j[10 * kBlock + k] = g * tsx[k];
    j[11 * kBlock + k] = g * tsy[k];
    j[12 * kBlock + k] = r;
  }
  std::array<float, kBlock> weighted;
  std::size_t place = 0;
  for (std::size_t a = 0; a <= kColumns; ++a) {
    const float* ja = j + static_cast<std::ptrdiff_t>(a) * kBlock;
    for (std::size_t k = 0; k < kBlock; ++k) weighted[k] = weight[k] * ja[k];
    for (std::size_t c = a; c <= kColumns; ++c)
      out.sums[place++] +=
          static_cast<double>(dot(weighted.data(), j + static_cast<std::ptrdiff_t>(c) * kBlock));
  }
  const float* residual = j + static_cast<std::ptrdiff_t>(kColumns) * kBlock;
  for (int k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double kept = static_cast<double>(tukey[i]);
    const bool edge = steep[i] > kEdgeSlope * kEdgeSlope;
    out.pixels += 1.0;
    out.kept += kept;
    out.edge_pixels += edge ? 1.0 : 0.0;
    out.edge_kept += edge ? kept : 0.0;
    const std::size_t side = white[k] > 0.5F ? 1 : 0;
    out.squares[side] += kept * static_cast<double>(residual[k] * residual[k]);
    out.counts[side] += kept;
  }
}

void ViewModel::collect(const GreyImage& image, const BlurredTag& tag, int y,
                        const Photometry& light, double doubt_cells, ViewEquations& out) {
  const std::ptrdiff_t stride = x1_ - x0_;
  const float* r = row_.data();
  const auto last = static_cast<float>(tag.cells().cells - 1);
  const std::uint8_t* pixels =
      image.pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
      static_cast<std::size_t>(x0_);
  for (int i = 0; i < x1_ - x0_; ++i) {
    const float x = r[kX * stride + i];
    const float up = r[kY * stride + i];
    if (!(std::abs(x) < half_ && std::abs(up) < half_) || pixels[i] >= kSaturated) continue;
    const float column = r[kColumn * stride + i];
    const float row = r[kRow * stride + i];
    const float lx = r[kLx * stride + i];
    const float hx = r[kHx * stride + i];
    const float ly = r[kLy * stride + i];
    const float hy = r[kHy * stride + i];
    // What lies outside the template is not known.
    if ((column == 0.0F && lx > 0.0F) || (column == last && hx > 0.0F) ||
        (row == 0.0F && ly > 0.0F) || (row == last && hy > 0.0F))
      continue;
    if (lx + hx + ly + hy == 0.0F && ((i + x0_) % kFlatStep != 0 || y % kFlatStep != 0)) continue;
    add(filled_++, i, pixels[i], tag.coefficients(static_cast<int>(row), static_cast<int>(column)));
    if (filled_ == kBlock) finish(light, doubt_cells, out);
  }
}

void ViewModel::linearize(const GreyImage& image, const CameraModel& camera, const RayTable& rays,
                          const BlurredTag& tag, const CameraFromTag& pose, const Photometry& light,
                          double doubt_cells, ViewEquations& out) {
  out = {};
  if (!place(camera, tag, pose)) return;
  for (int y = y0_; y < y1_; ++y) {
    spread(rays, y, light);
    collect(image, tag, y, light, doubt_cells, out);
  }
  finish(light, doubt_cells, out);
}

}  // namespace orthonav::nav

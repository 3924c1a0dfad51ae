#include "nav/tracking/photometric_view.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace orthonav::nav {
namespace {

/// Beyond so many SD the blur ends, so that a cell's grey depends on its neighbours alone: 3e-5 of
/// it would lie there.
constexpr float kReachSd = 4.0F;
/// Tukey's biweight at 4.7 SD: 95 % efficient on clean noise.
constexpr float kOutlierSd = 4.7F;
constexpr std::uint8_t kSaturated = 254;
/// Of its pixels so many agree with a cell that is hidden in part, and with one that is free.
constexpr float kHiddenShare = 0.45F;
constexpr float kFreeShare = 0.8F;
/// Of areas without edges every so many columns and rows suffice: they tell the light only.
constexpr int kFlatStep = 2;
/// A slope (per cell, of the blurred template) from which on a pixel tells something of the pose.
constexpr float kEdgeSlope = 0.1F;
/// Where a corner lies outside the image, its place is known roughly.
constexpr double kRoughPx = 24.0;

/// Along one axis: the cell, and of its low and its high edge what of the blur's footprint lies
/// beyond, the derivatives of that by the place, by the logarithm of the blur and by its tails, and
/// the density at the edge.
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
/// What one row of pixels needs: places across and up, the blur's scale, and both axes.
enum RowColumn {
  kX,
  kY,
  kScale,
  kAcross,
  kDown = kAcross + kAxisColumns,
  kRowColumns = kDown + kAxisColumns
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
  kTtx,
  kTty,
  kTc,
  kWeight,
  kFirst,
  kBlockColumns = kFirst + kColumns + 1
};

/// e to the x for x in [-8, 0], to 3e-6 of it: a polynomial of 2 to the fraction, the whole part
/// put into the exponent. The library's would not become vector instructions.
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

/// How much of a blur's footprint lies beyond an edge at distance `f`, and its derivatives. The
/// profile is a Gaussian with an excess of kurtosis (Gram-Charlier's series to the fourth moment),
/// its tail after Abramowitz & Stegun 1964, 7.1.26.
struct Beyond {
  float share;
  float slope;
  float by_blur;
  float by_tails;
  float gaussian;
};
inline Beyond beyond(float f, float inverse_sd, float tails) {
  const float t = std::min(f * inverse_sd, kReachSd);
  const float reached = t < kReachSd ? 1.0F : 0.0F;
  const float s = t * t;
  const float e = reached * exponential(-0.5F * s);
  const float gaussian = 0.398942280F * e;
  const float u = 1.0F / (1.0F + 0.3275911F * 0.707106781F * t);
  const float tail =
      u * (0.254829592F +
           u * (-0.284496736F + u * (1.421413741F + u * (-1.453152027F + u * 1.061405429F))));
  const float by_tails = (1.0F / 24.0F) * gaussian * t * (s - 3.0F);
  const float density = gaussian * (1.0F + tails * (1.0F / 24.0F) * (3.0F + s * (s - 6.0F)));
  return {0.5F * tail * e + tails * by_tails, density * inverse_sd, density * t, by_tails,
          gaussian};
}

/// Fills the columns of one axis.
void along(const float* __restrict place, const float* __restrict scale, int n, float half,
           float inverse_blur, float tails, float* __restrict out, std::ptrdiff_t stride) {
  float* __restrict column[kAxisColumns];
  for (int c = 0; c < kAxisColumns; ++c) column[c] = out + c * stride;
  for (int i = 0; i < n; ++i) {
    // In this order a place that is not a number becomes the low end.
    const float c = std::min(std::max(0.0F, place[i] + half), 2.0F * half - 1e-4F);
    const float cell = static_cast<float>(static_cast<int>(c));
    const float f = c - cell;
    const float inverse = inverse_blur * scale[i];
    const Beyond low = beyond(f, inverse, tails);
    const Beyond high = beyond(1.0F - f, inverse, tails);
    column[kCell][i] = cell;
    column[kLow][i] = low.share;
    column[kHigh][i] = high.share;
    column[kLowSlope][i] = -low.slope;
    column[kHighSlope][i] = high.slope;
    column[kLowBlur][i] = low.by_blur;
    column[kHighBlur][i] = high.by_blur;
    column[kLowTails][i] = low.by_tails;
    column[kHighTails][i] = high.by_tails;
    column[kLowDensity][i] = low.gaussian;
    column[kHighDensity][i] = high.gaussian;
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
  float* __restrict down = row_.data() + kRowColumns * stride;
  float* __restrict scale = row_.data() + kScale * stride;
  const std::array<float, 9> m = plane_from_ray_;
  for (int i = 0; i < n; ++i) {
    const float w = m[6] * ray_x[i] + m[7] * ray_y[i] + m[8];
    const float depth = 1.0F / w;
    across[i] = (m[0] * ray_x[i] + m[1] * ray_y[i] + m[2]) * depth;
    up[i] = (m[3] * ray_x[i] + m[4] * ray_y[i] + m[5]) * depth;
    down[i] = -up[i];
    scale[i] = depth_ * w;  // the blur covers more cells where the tag is farther
  }
  along(across, scale, n, half_, static_cast<float>(1.0 / light.blur_cells[0]),
        static_cast<float>(light.tails[0]), row_.data() + kAcross * stride, stride);
  along(down, scale, n, half_, static_cast<float>(1.0 / light.blur_cells[1]),
        static_cast<float>(light.tails[1]), row_.data() + kDown * stride, stride);
}

// Bilinear in what lies beyond the edges, plus what the blur's correlation moves at corners (the
// first term of Mehler's series).
void ViewModel::add(int k, int i, std::uint8_t grey, float skew, const float* c) {
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
  out[kT * kBlock] = c[0] + lx * left + hx * right + ly * c[3] + hy * c[4] + skew * corners;
  out[kTx * kBlock] = of(x, kLowSlope) * left + of(x, kHighSlope) * right;
  out[kTy * kBlock] = -(of(y, kLowSlope) * above + of(y, kHighSlope) * below);
  out[kTsx * kBlock] = of(x, kLowBlur) * left + of(x, kHighBlur) * right;
  out[kTsy * kBlock] = of(y, kLowBlur) * above + of(y, kHighBlur) * below;
  out[kTtx * kBlock] = of(x, kLowTails) * left + of(x, kHighTails) * right;
  out[kTty * kBlock] = of(y, kLowTails) * above + of(y, kHighTails) * below;
  out[kTc * kBlock] = corners;
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
  const float* __restrict ttx = column(kTtx);
  const float* __restrict tty = column(kTty);
  const float* __restrict tc = column(kTc);
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
  std::array<float, kBlock> belief;
  for (std::size_t k = 0; k < kBlock; ++k) belief[k] = believed_[cell_[k]];
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
    weight[k] = belief[static_cast<std::size_t>(k)] * kept / variance;
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
    j[12 * kBlock + k] = g * ttx[k];
    j[13 * kBlock + k] = g * tty[k];
    j[14 * kBlock + k] = g * tc[k];
    j[15 * kBlock + k] = r;
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
    counted_[cell_[i]] += 1.0F;
    kept_[cell_[i]] += tukey[i];
    const double kept = static_cast<double>(belief[i] * tukey[i]);
    const bool edge = steep[i] > kEdgeSlope * kEdgeSlope;
    out.pixels += 1.0;
    out.kept += kept;
    out.edge_pixels += edge ? 1.0 : 0.0;
    out.edge_kept += edge ? kept : 0.0;
    if (edge) out.edge_squares += static_cast<double>(weight[k] * residual[k] * residual[k]);
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
    const float* across = r + kAcross * stride + i;
    const float* down = r + kDown * stride + i;
    const float column = across[kCell * stride];
    const float row = down[kCell * stride];
    // The densities are zero where the footprint does not reach an edge.
    const float left = across[kLowDensity * stride];
    const float right = across[kHighDensity * stride];
    const float above = down[kLowDensity * stride];
    const float below = down[kHighDensity * stride];
    // What lies outside the template is not known.
    if ((column == 0.0F && left > 0.0F) || (column == last && right > 0.0F) ||
        (row == 0.0F && above > 0.0F) || (row == last && below > 0.0F))
      continue;
    if (left + right + above + below == 0.0F && ((i + x0_) % kFlatStep != 0 || y % kFlatStep != 0))
      continue;
    const int cell_row = static_cast<int>(row);
    const int cell_column = static_cast<int>(column);
    cell_[static_cast<std::size_t>(filled_)] =
        static_cast<std::uint16_t>(cell_row * tag.cells().cells + cell_column);
    add(filled_++, i, pixels[i], static_cast<float>(light.skew),
        tag.coefficients(cell_row, cell_column));
    if (filled_ == kBlock) finish(light, doubt_cells, out);
  }
}

/// What hides a tag hides it in one piece: a cell with many outliers is doubted as a whole.
void ViewModel::judge_cells(std::vector<float>& cell_weights) const {
  cell_weights.resize(counted_.size());
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const float share = counted_[i] > 0.0F ? kept_[i] / counted_[i] : 1.0F;
    const float t = std::clamp((share - kHiddenShare) / (kFreeShare - kHiddenShare), 0.0F, 1.0F);
    cell_weights[i] = t * t * (3.0F - 2.0F * t);
  }
}

void ViewModel::linearize(const GreyImage& image, const CameraModel& camera, const RayTable& rays,
                          const BlurredTag& tag, const CameraFromTag& pose, const Photometry& light,
                          double doubt_cells, std::vector<float>& cell_weights,
                          ViewEquations& out) {
  out = {};
  if (!place(camera, tag, pose)) return;
  const std::size_t cells = tag.cells().white.size();
  counted_.assign(cells, 0.0F);
  kept_.assign(cells, 0.0F);
  if (cell_weights.size() == cells)
    believed_.assign(cell_weights.begin(), cell_weights.end());
  else
    believed_.assign(cells, 1.0F);
  for (int y = y0_; y < y1_; ++y) {
    spread(rays, y, light);
    collect(image, tag, y, light, doubt_cells, out);
  }
  finish(light, doubt_cells, out);
  judge_cells(cell_weights);
}

}  // namespace orthonav::nav

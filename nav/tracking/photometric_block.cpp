#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectorized.h"
#include "nav/tracking/photometric_view.h"

// The contribution of a block of pixels to a view's equations and to the judgement of the tag's
// cells. Loops of a fixed length over separate arrays, so that they are vectorized.
namespace orthonav::nav {
namespace {

/// Tukey's biweight at 4.7 SD: 95 % efficient on clean noise.
constexpr float kOutlierSd = 4.7F;
/// The least slope (per cell, of the blurred template) at which a pixel is informative about the
/// pose.
constexpr float kEdgeSlope = 0.1F;
/// Below this squared slope a pixel has no influence.
constexpr float kLeastSlope2 = 1e-4F;
/// Fractions of a cell's pixels that agree with it: below the first the cell is partly hidden,
/// above the second it is visible.
constexpr float kHiddenFraction = 0.45F;
constexpr float kFreeFraction = 0.8F;

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

/// An occluder covers a connected area: a cell with many outliers is doubted as a whole.
void ViewModel::judge_cells(std::vector<float>& cell_weights) const {
  cell_weights.resize(counted_.size());
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const float fraction = counted_[i] > 0.0F ? kept_[i] / counted_[i] : 1.0F;
    const float t =
        std::clamp((fraction - kHiddenFraction) / (kFreeFraction - kHiddenFraction), 0.0F, 1.0F);
    cell_weights[i] = t * t * (3.0F - 2.0F * t);
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

}  // namespace orthonav::nav

#include "hal/sim/cameras/room_renderer_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/random.h"
#include "base/vectorized.h"

namespace orthonav::sim {
namespace {

using Span = CoverageWindow::Span;

constexpr double kMaxBlurPx = 8.0;

}  // namespace

std::vector<float> discrete_gaussian(double sigma_px) {
  const double t = std::min(sigma_px, kMaxBlurPx) * std::min(sigma_px, kMaxBlurPx);
  std::vector<double> weights{1.0};
  if (t > 0.0) {
    weights.clear();
    for (int n = 0; n < 64; ++n) {
      weights.push_back(std::exp(-t) * std::cyl_bessel_i(n, t));
      if (weights.back() < 1e-5 * weights.front()) {
        break;
      }
    }
  }
  double sum = weights.front();
  for (std::size_t n = 1; n < weights.size(); ++n) {
    sum += 2.0 * weights[n];
  }
  std::vector<float> out;
  for (const double w : weights) {
    out.push_back(static_cast<float>(w / sum));
  }
  return out;
}

void HalfImage::reset(int half_width, int half_height) {
  width = half_width;
  height = half_height;
  grey.resize(static_cast<std::size_t>(half_width) * static_cast<std::size_t>(half_height));
}

Sensor::Sensor(const ErrorModel& m)
    : shot_variance_per_grey_(static_cast<float>(std::max(m.shot_noise, 0.0))),
      read_variance_(static_cast<float>(m.read_noise_grey * m.read_noise_grey)),
      vignetting_(static_cast<float>(std::clamp(m.vignetting, 0.0, 1.0))),
      kernel_(discrete_gaussian(std::max(m.blur_sigma_px, 0.0))) {
  radius_ = static_cast<int>(kernel_.size()) - 1;
  // Quantiles at the middle of equal parts, scaled to a variance of one.
  double squares = 0.0;
  for (std::size_t i = 0; i < kDraws; ++i) {
    const double q = normal_quantile((static_cast<double>(i) + 0.5) / kDraws);
    squares += q * q;
    normal_[i] = static_cast<float>(q);
  }
  const float scale = static_cast<float>(1.0 / std::sqrt(squares / kDraws));
  for (float& v : normal_) {
    v *= scale;
  }
}

void Sensor::resize(int width, int height) {
  if (width == width_ && height == height_) {
    return;
  }
  width_ = width;
  height_ = height;
  const auto w = static_cast<std::size_t>(width);
  ring_.assign(w * kernel_.size() * 2, 0.0F);
  line_.assign(w + 2 * kernel_.size() + 2, 0.0F);
  across_.assign(w, 0.0F);
  noise_.assign(w + 4, 0.0F);
  loss_x_.resize(w);
  const float corner = 0.25F * static_cast<float>(width * width + height * height);
  for (int x = 0; x < width; ++x) {
    const float dx = static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(width);
    loss_x_[static_cast<std::size_t>(x)] = vignetting_ * dx * dx / corner;
  }
}

float* Sensor::ring_row(int y) {
  const int rows = 2 * radius_ + 1;
  return ring_.data() + static_cast<std::ptrdiff_t>(y % rows) * width_;
}

ORTHONAV_WIDE void Sensor::compose_row(const HalfImage& background, const Foreground& foreground,
                                       int y) {
  const int j = std::min((y + 1) / 2, background.height - 1);
  const int i = std::max((y + 1) / 2 - 1, 0);
  const float lower = y % 2 == 0 ? 0.75F : 0.25F;  // weight of row j
  const float* top = background.row(i);
  const float* bottom = background.row(j);
  float* half = line_.data();
  for (int x = 0; x < background.width; ++x) {
    half[x] = top[x] + lower * (bottom[x] - top[x]);
  }
  float* out = ring_row(y);
  const int pairs = width_ / 2;
  out[0] = half[0];
  for (int x = 0; x + 1 < pairs; ++x) {
    out[2 * x + 1] = 0.75F * half[x] + 0.25F * half[x + 1];
    out[2 * x + 2] = 0.25F * half[x] + 0.75F * half[x + 1];
  }
  for (int x = 2 * pairs - 1; x < width_; ++x) {
    out[x] = half[background.width - 1];
  }
  const Span span = foreground.spans[static_cast<std::size_t>(y)];
  const float* light = foreground.light.data() + foreground.row(y);
  const float* opacity = foreground.opacity.data() + foreground.row(y);
  for (int x = span.low; x < span.high; ++x) {
    out[x] += light[x] - opacity[x] * out[x];
  }
}

ORTHONAV_WIDE void Sensor::blur_along(int y, Span span) {
  if (radius_ == 0 || span.low >= span.high) {
    return;
  }
  float* const row = ring_row(y);
  // The row with its ends repeated, from span.low - radius_.
  for (int x = span.low - radius_; x < span.high + radius_; ++x) {
    line_[static_cast<std::size_t>(x - span.low + radius_)] = row[std::clamp(x, 0, width_ - 1)];
  }
  const float* __restrict in = line_.data() + radius_;
  const int n = span.high - span.low;
  float* __restrict out = row + span.low;
  const float centre = kernel_[0];
  for (int x = 0; x < n; ++x) {
    out[x] = centre * in[x];
  }
  for (int k = 1; k <= radius_; ++k) {
    const float w = kernel_[static_cast<std::size_t>(k)];
    for (int x = 0; x < n; ++x) {
      out[x] += w * (in[x - k] + in[x + k]);
    }
  }
}

ORTHONAV_WIDE const float* Sensor::blur_across(int y, Span span) {
  const float* centre = ring_row(y);
  if (radius_ == 0 || span.low >= span.high) {
    return centre;
  }
  std::memcpy(across_.data(), centre, sizeof(float) * static_cast<std::size_t>(width_));
  float* __restrict out = across_.data();
  for (int x = span.low; x < span.high; ++x) {
    out[x] *= kernel_.front();
  }
  for (int k = 1; k <= radius_; ++k) {
    const float* __restrict above = ring_row(std::max(y - k, 0));
    const float* __restrict below = ring_row(std::min(y + k, height_ - 1));
    const float w = kernel_[static_cast<std::size_t>(k)];
    for (int x = span.low; x < span.high; ++x) {
      out[x] += w * (above[x] + below[x]);
    }
  }
  return across_.data();
}

Span Sensor::widened(const Foreground& foreground, int low_row, int high_row) const {
  Span all{width_, 0};
  for (int y = std::max(low_row, 0); y <= std::min(high_row, height_ - 1); ++y) {
    const Span span = foreground.spans[static_cast<std::size_t>(y)];
    if (span.low >= span.high) {
      continue;
    }
    all.low = std::min(all.low, std::max(span.low - radius_, 0));
    all.high = std::max(all.high, std::min(span.high + radius_, width_));
  }
  return all.low < all.high ? all : Span{};
}

void Sensor::draw_noise(int y, std::uint64_t noise_seed) {
  // Counter-based (splitmix64's mix of a counter), so that no number has to wait for the one
  // before.
  std::uint64_t counter = noise_seed;
  counter = splitmix64(counter) + static_cast<std::uint64_t>(y) * 0xD1342543DE82EF95ULL;
  const float* const normal = normal_.data();
  float* const noise = noise_.data();
  for (int x = 0; x < width_; x += 4) {
    counter += 0x9E3779B97F4A7C15ULL;
    std::uint64_t bits = counter;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
    bits ^= bits >> 31;
    noise[x] = normal[bits & (kDraws - 1)];
    noise[x + 1] = normal[(bits >> 16) & (kDraws - 1)];
    noise[x + 2] = normal[(bits >> 32) & (kDraws - 1)];
    noise[x + 3] = normal[(bits >> 48) & (kDraws - 1)];
  }
}

ORTHONAV_WIDE void Sensor::finish_row(const float* light_in, int y, std::uint64_t noise_seed,
                                      std::uint8_t* out_bytes) {
  const float dy = static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(height_);
  const float corner = 0.25F * static_cast<float>(width_ * width_ + height_ * height_);
  const float kept = 1.0F - vignetting_ * dy * dy / corner;
  const float lamp = lamp_;
  const float shot = shot_variance_per_grey_;
  const float read = read_variance_;
  const int width = width_;
  const float* __restrict light = light_in;
  const float* __restrict loss = loss_x_.data();
  const float* __restrict noise = noise_.data();
  std::uint8_t* __restrict out = out_bytes;
  const bool noisy = shot > 0.0F || read > 0.0F;
  if (noisy) {
    draw_noise(y, noise_seed);
  }
  for (int x = 0; x < width; ++x) {
    const float mean = std::max(lamp * light[x] * (kept - loss[x]), 0.0F);
    const float v = mean + std::sqrt(shot * mean + read) * noise[x] + 0.5F;
    out[x] = static_cast<std::uint8_t>(static_cast<int>(std::min(std::max(v, 0.0F), 255.0F)));
  }
}

void Sensor::expose(const HalfImage& background, const Foreground& foreground,
                    std::uint64_t noise_seed, float lamp, GreyImage& image) {
  lamp_ = lamp;
  resize(foreground.width_px, foreground.height_px);
  image.width_px = width_;
  image.height_px = height_;
  image.pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  int ready = 0;  // rows composed and blurred horizontally so far
  for (int y = 0; y < height_; ++y) {
    for (; ready <= std::min(y + radius_, height_ - 1); ++ready) {
      compose_row(background, foreground, ready);
      blur_along(ready, widened(foreground, ready - radius_, ready + radius_));
    }
    const float* light = blur_across(y, widened(foreground, y - radius_, y + radius_));
    finish_row(light, y, noise_seed, image.pixels.data() + static_cast<std::ptrdiff_t>(y) * width_);
  }
}

}  // namespace orthonav::sim

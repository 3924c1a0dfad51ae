#include "hal/sim/room_renderer_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orthonav::sim {
namespace {

using Span = CoverageWindow::Span;

/// Coverage below this is rounding.
constexpr float kNothing = 1e-4F;
/// Pixels that are merged at a time; bodies seldom overlap in one.
constexpr int kBlockPx = 32;
/// A body may reach so far into the background before it is hidden: 1 mm at 0.5 m.
constexpr float kDepthSlack = 0.004F;

}  // namespace

void Foreground::reset(int width, int height, int channel_count) {
  if (width == width_px && height == height_px && channel_count == channels) {
    for (int y = 0; y < height; ++y) {
      Span& span = spans[static_cast<std::size_t>(y)];
      const auto from = static_cast<std::ptrdiff_t>(row(y)) + span.low;
      const auto to = static_cast<std::ptrdiff_t>(row(y)) + span.high;
      std::fill(opacity.begin() + from, opacity.begin() + to, 0.0F);
      for (int c = 0; c < channels; ++c) {
        const auto shift = static_cast<std::ptrdiff_t>(plane()) * c;
        std::fill(light.begin() + shift + from, light.begin() + shift + to, 0.0F);
      }
      span = {};
    }
    return;
  }
  width_px = width;
  height_px = height;
  channels = channel_count;
  opacity.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  light.assign(opacity.size() * static_cast<std::size_t>(channels), 0.0F);
  spans.assign(static_cast<std::size_t>(height), {});
}

void Layers::add_moment(const Solids& solids, const Lens& lens, float weight, Foreground& sum,
                        const float* hidden_by) {
  for (const Plate& plate : solids.plates) draw(plate, lens);
  for (const Capsule& capsule : solids.capsules) draw(capsule, solids.lamp_in_camera, lens);
  merge(weight, sum, hidden_by);
  wipe();
}

Layers::Layer* Layers::open_layer(Vec2 low, Vec2 high, const Lens& lens) {
  const double w = lens.width_px();
  const double h = lens.height_px();
  if (!(low.x < w && low.y < h && high.x > 0.0 && high.y > 0.0)) return nullptr;
  Layer layer;
  layer.x0 = static_cast<int>(std::max(std::floor(low.x), 0.0));
  layer.y0 = static_cast<int>(std::max(std::floor(low.y), 0.0));
  layer.width = static_cast<int>(std::min(std::ceil(high.x), w)) - layer.x0;
  layer.height = static_cast<int>(std::min(std::ceil(high.y), h)) - layer.y0;
  if (layer.width <= 0 || layer.height <= 0) return nullptr;
  const std::size_t size = static_cast<std::size_t>(CoverageWindow::stride(layer.width)) *
                           static_cast<std::size_t>(layer.height);
  layer.alpha = arena_used_;
  layer.light = arena_used_ + size;
  layer.spans = spans_used_;
  arena_used_ += 2 * size;
  spans_used_ += static_cast<std::size_t>(layer.height);
  if (arena_.size() < arena_used_) arena_.resize(arena_used_ + arena_used_ / 2, 0.0F);
  if (spans_.size() < spans_used_) spans_.resize(spans_used_ + spans_used_ / 2);
  layers_.push_back(layer);
  return &layers_.back();
}

void Layers::integrate(const Layer& layer, std::size_t window) {
  const int stride = CoverageWindow::stride(layer.width);
  for (int row = 0; row < layer.height; ++row) {
    Span& span = spans_[layer.spans + static_cast<std::size_t>(row)];
    span.high = std::min(span.high, layer.width);
    float* cells = arena_.data() + window + static_cast<std::ptrdiff_t>(row) * stride;
    float sum = 0.0F;
    for (int x = span.low; x < span.high; ++x) {
      sum += cells[x];
      cells[x] = sum;
    }
  }
}

void Layers::merge(float weight, Foreground& sum, const float* hidden_by) {
  for (int y = 0; y < sum.height_px; ++y) {
    int low = sum.width_px;
    int high = 0;
    for (const Layer& layer : layers_) {
      if (y < layer.y0 || y >= layer.y0 + layer.height) continue;
      const Span span = spans_[layer.spans + static_cast<std::size_t>(y - layer.y0)];
      if (span.low >= span.high) continue;
      low = std::min(low, layer.x0 + span.low);
      high = std::max(high, layer.x0 + span.high);
    }
    if (low >= high) continue;
    Span& dirty = sum.spans[static_cast<std::size_t>(y)];
    dirty = dirty.low == dirty.high ? Span{low, high}
                                    : Span{std::min(dirty.low, low), std::max(dirty.high, high)};
    for (int from = low; from < high; from += kBlockPx) {
      const int to = std::min(from + kBlockPx, high);
      active_.clear();
      for (const Layer& layer : layers_) {
        if (y < layer.y0 || y >= layer.y0 + layer.height) continue;
        const Span span = spans_[layer.spans + static_cast<std::size_t>(y - layer.y0)];
        if (layer.x0 + span.low < to && layer.x0 + span.high > from) active_.push_back(&layer);
      }
      if (active_.size() == 1)
        merge_one(*active_.front(), y, from, to, weight, sum, hidden_by);
      else if (!active_.empty())
        merge_many(y, from, to, weight, sum, hidden_by);
    }
  }
}

void Layers::merge_one(const Layer& layer, int y, int from, int to, float weight, Foreground& sum,
                       const float* hidden_by) const {
  const Span span = spans_[layer.spans + static_cast<std::size_t>(y - layer.y0)];
  from = std::max(from, layer.x0 + span.low);
  to = std::min(to, layer.x0 + span.high);
  const std::ptrdiff_t row =
      static_cast<std::ptrdiff_t>(y - layer.y0) * CoverageWindow::stride(layer.width) - layer.x0;
  const float* alpha = arena_.data() + static_cast<std::ptrdiff_t>(layer.alpha) + row;
  const float* light = arena_.data() + static_cast<std::ptrdiff_t>(layer.light) + row;
  float* opacity = sum.opacity.data() + sum.row(y);
  if (hidden_by == nullptr && sum.channels == 1) {
    float* out = sum.light.data() + sum.row(y);
    for (int x = from; x < to; ++x) {
      opacity[x] += weight * alpha[x];
      out[x] += weight * light[x];
    }
    return;
  }
  const float* hide = hidden_by == nullptr ? nullptr : hidden_by + sum.row(y);
  for (int x = from; x < to; ++x) {
    if (hide != nullptr && layer.nearness(x, y) + kDepthSlack < hide[x]) continue;
    opacity[x] += weight * alpha[x];
    for (int c = 0; c < sum.channels; ++c)
      sum.light[static_cast<std::size_t>(c) * sum.plane() + sum.row(y) +
                static_cast<std::size_t>(x)] +=
          weight * light[x] * layer.tint[static_cast<std::size_t>(c)];
  }
}

void Layers::merge_many(int y, int from, int to, float weight, Foreground& sum,
                        const float* hidden_by) const {
  constexpr std::size_t kMost = 16;
  std::array<Fragment, kMost> fragments;
  const auto in_front = [](const Fragment& a, const Fragment& b) {
    if (a.layer->tool == b.layer->tool && a.layer->rank != b.layer->rank)
      return a.layer->rank > b.layer->rank;
    return a.nearness > b.nearness;
  };
  for (int x = from; x < to; ++x) {
    std::size_t count = 0;
    const float hide =
        hidden_by == nullptr ? -1e9F : hidden_by[sum.row(y) + static_cast<std::size_t>(x)];
    for (const Layer* layer : active_) {
      const Span span = spans_[layer->spans + static_cast<std::size_t>(y - layer->y0)];
      const int column = x - layer->x0;
      if (column < span.low || column >= span.high || count == kMost) continue;
      const std::size_t cell = static_cast<std::size_t>(y - layer->y0) *
                                   static_cast<std::size_t>(CoverageWindow::stride(layer->width)) +
                               static_cast<std::size_t>(column);
      const float alpha = arena_[layer->alpha + cell];
      if (alpha < kNothing) continue;
      const Fragment fragment{alpha, arena_[layer->light + cell], layer->nearness(x, y), layer};
      if (fragment.nearness + kDepthSlack < hide) continue;
      std::size_t place = count++;
      for (; place > 0 && in_front(fragment, fragments[place - 1]); --place)
        fragments[place] = fragments[place - 1];
      fragments[place] = fragment;
    }
    float through = weight;
    const std::size_t pixel = sum.row(y) + static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < count; ++i) {
      const Fragment& f = fragments[i];
      for (std::size_t c = 0; c < static_cast<std::size_t>(sum.channels); ++c)
        sum.light[c * sum.plane() + pixel] +=
            through * f.light * (sum.channels == 1 ? 1.0F : f.layer->tint[c]);
      sum.opacity[pixel] += through * f.alpha;
      through *= std::max(1.0F - f.alpha, 0.0F);
    }
  }
}

void Layers::wipe() {
  for (const Layer& layer : layers_)
    for (int row = 0; row < layer.height; ++row) {
      Span& span = spans_[layer.spans + static_cast<std::size_t>(row)];
      // The difference past the last pixel of a row is there too, hence two more.
      const auto begin = static_cast<std::ptrdiff_t>(row) * CoverageWindow::stride(layer.width);
      const auto size = static_cast<std::ptrdiff_t>(
          std::min(span.high - span.low + 2, CoverageWindow::stride(layer.width) - span.low));
      for (const std::size_t window : {layer.alpha, layer.light}) {
        const auto at = arena_.begin() + static_cast<std::ptrdiff_t>(window) + begin + span.low;
        std::fill(at, at + size, 0.0F);
      }
      span = {};
    }
  layers_.clear();
  arena_used_ = 0;
  spans_used_ = 0;
}

}  // namespace orthonav::sim

#include "hal/sim/cameras/room_renderer_layers.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

using Span = CoverageWindow::Span;

}  // namespace

void Foreground::reset(int width, int height, int channel_count) {
  if (width == width_px && height == height_px && channel_count == channels) {
    for (int y = 0; y < height; ++y) {
      Span& span = spans[static_cast<std::size_t>(y)];
      const auto from = static_cast<std::ptrdiff_t>(row(y)) + span.low;
      const auto to = static_cast<std::ptrdiff_t>(row(y)) + span.high;
      std::fill(opacity.begin() + from, opacity.begin() + to, 0.0F);
      for (int c = 0; c < channels; ++c) {
        const auto offset = static_cast<std::ptrdiff_t>(plane()) * c;
        std::fill(light.begin() + offset + from, light.begin() + offset + to, 0.0F);
      }
      span = {};
    }
    return;
  }
  width_px = width;
  height_px = height;
  channels = channel_count;
  // One vector more, for the end of the last row.
  opacity.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + 16, 0.0F);
  light.assign(opacity.size() * static_cast<std::size_t>(channels), 0.0F);
  spans.assign(static_cast<std::size_t>(height), {});
}

// Enough for bodies that fill an image of 640×480 twice over; a frame that needs more grows it.
Layers::Layers() : arena_(std::size_t{2} * 2 * 640 * 480, 0.0F), spans_(16 * 1024) {
  layers_.reserve(128);
  in_row_.reserve(128);
  active_.reserve(128);
  corners_px_.reserve(512);
}

void Layers::add_moment(const Solids& solids, const Lens& lens, float weight, Foreground& sum,
                        const float* hidden_by) {
  for (const Plate& plate : solids.plates) {
    draw(plate, lens);
  }
  for (const Capsule& capsule : solids.capsules) {
    draw(capsule, solids.lamp_in_camera, lens);
  }
  merge(weight, sum, hidden_by);
  wipe();
}

Layers::Layer* Layers::open_layer(Vec2 low, Vec2 high, const Lens& lens) {
  const double w = lens.width_px();
  const double h = lens.height_px();
  if (!(low.x < w && low.y < h && high.x > 0.0 && high.y > 0.0)) {
    return nullptr;
  }
  Layer layer;
  layer.x0 = static_cast<int>(std::max(std::floor(low.x), 0.0)) & ~3;  // in whole vectors
  layer.y0 = static_cast<int>(std::max(std::floor(low.y), 0.0));
  layer.width = (static_cast<int>(std::min(std::ceil(high.x), w)) - layer.x0 + 3) & ~3;
  layer.height = static_cast<int>(std::min(std::ceil(high.y), h)) - layer.y0;
  if (layer.width <= 0 || layer.height <= 0) {
    return nullptr;
  }
  const std::size_t size = static_cast<std::size_t>(CoverageWindow::stride(layer.width)) *
                           static_cast<std::size_t>(layer.height);
  layer.alpha = arena_used_;
  layer.light = arena_used_ + size;
  layer.spans = spans_used_;
  arena_used_ += 2 * size;
  spans_used_ += static_cast<std::size_t>(layer.height);
  if (arena_.size() < arena_used_) {
    arena_.resize(arena_used_ + arena_used_ / 2, 0.0F);
  }
  if (spans_.size() < spans_used_) {
    spans_.resize(spans_used_ + spans_used_ / 2);
  }
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
    cells[layer.width] = 0.0F;  // the difference past the edge
    cells[layer.width + 1] = 0.0F;
  }
}

void Layers::wipe() {
  for (const Layer& layer : layers_) {
    for (int row = 0; row < layer.height; ++row) {
      Span& span = spans_[layer.spans + static_cast<std::size_t>(row)];
      const auto begin = static_cast<std::ptrdiff_t>(row) * CoverageWindow::stride(layer.width);
      const auto size = static_cast<std::ptrdiff_t>(
          std::min(span.high - span.low + 2, CoverageWindow::stride(layer.width) - span.low));
      for (const std::size_t window : {layer.alpha, layer.light}) {
        const auto at = arena_.begin() + static_cast<std::ptrdiff_t>(window) + begin + span.low;
        std::fill(at, at + size, 0.0F);
      }
      span = {};
    }
  }
  layers_.clear();
  arena_used_ = 0;
  spans_used_ = 0;
}

}  // namespace orthonav::sim

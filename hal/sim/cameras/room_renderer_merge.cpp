#include <algorithm>
#include <array>

#include "hal/sim/cameras/room_renderer_layers.h"

// How the layers of one moment become the foreground: nearest first, in blocks of a row.
namespace orthonav::sim {
namespace {

using Span = CoverageWindow::Span;

/// Coverage below this is rounding.
constexpr float kNothing = 1e-4F;
/// A body may reach this far into the background before it is hidden: 1 mm at 0.5 m.
constexpr float kDepthSlack = 0.004F;

}  // namespace

bool Layers::in_front(const Layer& a, const Layer& b, int x, int y) {
  // Within a tool the plate covers its own rods, or they it: depths are too close to call.
  if (a.tool == b.tool && a.rank != b.rank) {
    return a.rank > b.rank;
  }
  return a.nearness(x, y) > b.nearness(x, y);
}

void Layers::merge(float weight, Foreground& sum, const float* hidden_by) {
  for (int y = 0; y < sum.height_px; ++y) {
    int low = sum.width_px;
    int high = 0;
    in_row_.clear();
    for (const Layer& layer : layers_) {
      if (y < layer.y0 || y >= layer.y0 + layer.height) {
        continue;
      }
      const Span span = spans_[layer.spans + static_cast<std::size_t>(y - layer.y0)];
      if (span.low >= span.high) {
        continue;
      }
      const std::ptrdiff_t row =
          static_cast<std::ptrdiff_t>(y - layer.y0) * CoverageWindow::stride(layer.width) -
          layer.x0;
      const int end = std::min(layer.x0 + span.high, sum.width_px);
      if (layer.x0 + span.low >= end) {
        continue;
      }
      in_row_.push_back({&layer, layer.x0 + span.low, end,
                         arena_.data() + static_cast<std::ptrdiff_t>(layer.alpha) + row,
                         arena_.data() + static_cast<std::ptrdiff_t>(layer.light) + row});
      low = std::min(low, layer.x0 + span.low);
      high = std::max(high, end);
    }
    if (low >= high) {
      continue;
    }
    Span& dirty = sum.spans[static_cast<std::size_t>(y)];
    dirty = dirty.low == dirty.high ? Span{low, high}
                                    : Span{std::min(dirty.low, low), std::max(dirty.high, high)};
    for (int from = low - low % kBlockPx; from < high; from += kBlockPx) {
      merge_block(y, from, std::min(from + kBlockPx, high), weight, sum, hidden_by);
    }
  }
}

/// Orders the layers of a block, nearest first, by their depths at its left end.
void Layers::order_block(int y, int from, int to) {
  active_.clear();
  for (const RowLayer& row : in_row_) {
    if (row.low >= to || row.high <= from) {
      continue;
    }
    std::size_t place = active_.size();
    active_.push_back(&row);
    for (; place > 0 && in_front(*row.layer, *active_[place - 1]->layer, from, y); --place) {
      active_[place] = active_[place - 1];
    }
    active_[place] = &row;
  }
}

/// Whether the order of a block is the same at its right end: then it holds throughout, since
/// depths are linear. In grey the order within the hand does not matter, since its parts look alike
/// where they intersect.
bool Layers::order_holds(int last, int y, bool grey) const {
  for (std::size_t i = 1; i < active_.size(); ++i) {
    const Layer& before = *active_[i - 1]->layer;
    const Layer& layer = *active_[i]->layer;
    const bool alike = grey && layer.tool < 0 && before.tool < 0;
    if (!alike && in_front(layer, before, last, y)) {
      return false;
    }
  }
  return true;
}

void Layers::merge_block(int y, int from, int to, float weight, Foreground& sum,
                         const float* hidden_by) {
  order_block(y, from, to);
  const bool grey = sum.channels == 1;
  if (!order_holds(to - 1, y, grey)) {
    for (int x = from; x < to; ++x) {
      merge_pixel(x, y, weight, sum, hidden_by);
    }
    return;
  }
  std::array<float, kBlockPx> through;
  through.fill(0.0F);
  std::fill_n(through.begin(), to - from, weight);
  for (const RowLayer* row : active_) {
    const int low = std::max(from, row->low);
    const int high = std::min(to, row->high);
    if (hidden_by == nullptr && grey) {
      lay_block_under(*row, y, from, low, high, through.data(), sum);
    } else {
      lay_under(*row, y, from, low, high, through.data(), sum, hidden_by);
    }
    float left = 0.0F;  // nothing behind an opaque surface needs to be added
    for (const float t : through) {
      left = std::max(left, t);
    }
    if (left < kNothing * weight) {
      break;
    }
  }
}

void Layers::merge_pixel(int x, int y, float weight, Foreground& sum, const float* hidden_by) {
  constexpr std::size_t kMost = 16;
  std::array<const RowLayer*, kMost> order;
  std::size_t count = 0;
  for (const RowLayer* row : active_) {
    if (x < row->low || x >= row->high || row->alpha[x] < kNothing || count == kMost) {
      continue;
    }
    std::size_t place = count++;
    for (; place > 0 && in_front(*row->layer, *order[place - 1]->layer, x, y); --place) {
      order[place] = order[place - 1];
    }
    order[place] = row;
  }
  float through = weight;
  for (std::size_t i = 0; i < count; ++i) {
    lay_under(*order[i], y, x, x, x + 1, &through, sum, hidden_by);
  }
}

// Layers begin at multiples of four and are zero outside their spans, blocks begin at multiples of
// sixteen: whole vectors can be added without checking the ends.
void Layers::lay_block_under(const RowLayer& row, int y, int block, int from, int to, float* left,
                             Foreground& sum) {
  const int first = from - from % 4;
  const int vectors = (to - first + 3) / 4;
  const float* __restrict alpha = row.alpha + first;
  const float* __restrict light = row.light + first;
  float* __restrict through = left + (first - block);
  float* __restrict opacity = sum.opacity.data() + sum.row(y) + first;
  float* __restrict out = sum.light.data() + sum.row(y) + first;
  for (int v = 0; v < vectors; ++v) {
    for (int i = 4 * v; i < 4 * v + 4; ++i) {
      opacity[i] += through[i] * alpha[i];
      out[i] += through[i] * light[i];
      through[i] -= through[i] * alpha[i];
    }
  }
}

void Layers::lay_under(const RowLayer& row, int y, int block, int from, int to, float* left,
                       Foreground& sum, const float* hidden_by) {
  const std::size_t at = sum.row(y);
  const float* alpha = row.alpha;
  const float* light = row.light;
  float* through = left - block;
  float* opacity = sum.opacity.data() + at;
  for (int x = from; x < to; ++x) {
    if (hidden_by != nullptr && row.layer->nearness(x, y) + kDepthSlack < hidden_by[at + x]) {
      continue;
    }
    opacity[x] += through[x] * alpha[x];
    for (std::size_t c = 0; c < static_cast<std::size_t>(sum.channels); ++c) {
      sum.light[c * sum.plane() + at + static_cast<std::size_t>(x)] +=
          through[x] * light[x] * row.layer->tint[c];
    }
    through[x] -= through[x] * alpha[x];
  }
}

}  // namespace orthonav::sim

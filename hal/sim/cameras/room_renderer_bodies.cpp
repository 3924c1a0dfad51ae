#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectorized.h"
#include "hal/sim/cameras/room_renderer_layers.h"
#include "hal/sim/room/tag_flaws.h"

// How single bodies are drawn into their layers.
namespace orthonav::sim {
namespace {

using Span = CoverageWindow::Span;

/// The plate's rim is drawn in this many straight pieces per side; its shape is not measured.
constexpr int kRimPieces = 4;
constexpr int kArcPieces = 14;
constexpr float kBackAlbedo = 0.35F;

struct Box {
  Vec2 low{1e30, 1e30};
  Vec2 high{-1e30, -1e30};
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// Inverse depth as a linear function of the pixel through three points.
std::array<float, 3> plane_through(std::array<Vec2, 3> p, std::array<double, 3> nearness) {
  const Vec2 u = p[1] - p[0];
  const Vec2 v = p[2] - p[0];
  const double det = u.x * v.y - u.y * v.x;
  const double du = nearness[1] - nearness[0];
  const double dv = nearness[2] - nearness[0];
  const bool flat = std::abs(det) < 1e-9;  // seen edge-on
  const double gx = flat ? 0.0 : (du * v.y - dv * u.y) / det;
  const double gy = flat ? 0.0 : (dv * u.x - du * v.x) / det;
  return {static_cast<float>(nearness[0] - gx * p[0].x - gy * p[0].y), static_cast<float>(gx),
          static_cast<float>(gy)};
}

}  // namespace

void Layers::draw(const Plate& plate, const Lens& lens) {
  Box box;
  corners_px_.clear();
  constexpr std::array<Vec2, 5> kTurns = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
  for (std::size_t side = 0; side < 4; ++side) {
    for (int i = 0; i < kRimPieces; ++i) {
      const double s = static_cast<double>(i) / kRimPieces;
      const Vec2 at = plate.half_m * (kTurns[side] + s * (kTurns[side + 1] - kTurns[side]));
      corners_px_.push_back(
          lens.rough_pixel((plate.camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}}).v));
      box.add(corners_px_.back());
    }
  }
  Layer* layer = open_layer(box.low, box.high, lens);
  if (layer == nullptr) {
    return;
  }
  const bool front = plate.camera_from_marker.inverse().translation().z > 0.0;
  layer->tool = plate.tool;
  layer->rank = front ? 1 : -1;
  const double h = plate.half_m;
  const auto nearness_of = [&](double x, double y) {
    return 1.0 / (plate.camera_from_marker * Point<Marker>{{x, y, 0.0}}).v.z;
  };
  const auto plane =
      plane_through({corners_px_[0], corners_px_[kRimPieces], corners_px_[3 * kRimPieces]},
                    {nearness_of(-h, -h), nearness_of(h, -h), nearness_of(-h, h)});
  layer->nearness0 = plane[0];
  layer->nearness_x = plane[1];
  layer->nearness_y = plane[2];
  const float albedo = front ? kWhiteAlbedo : kBackAlbedo;
  const double sign = fill_outline(
      *layer,
      static_cast<double>(kFullGrey * (plate.light * albedo + (front ? plate.glare : 0.0F))));
  if (front && plate.pattern != nullptr) {
    draw_face(plate, lens, *layer, sign);
  }
  integrate(*layer, layer->alpha);
  integrate(*layer, layer->light);
}

double Layers::fill_outline(const Layer& layer, double grey) {
  const std::size_t count = corners_px_.size();
  double area = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = corners_px_[i];
    const Vec2 b = corners_px_[(i + 1) % count];
    area += a.x * b.y - a.y * b.x;
  }
  const double sign = area < 0.0 ? 1.0 : -1.0;
  Span* spans = spans_.data() + layer.spans;
  CoverageWindow alpha(arena_.data() + layer.alpha, spans, layer.width, layer.height);
  CoverageWindow light(arena_.data() + layer.light, spans, layer.width, layer.height);
  const Vec2 origin{static_cast<double>(layer.x0), static_cast<double>(layer.y0)};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = corners_px_[i] - origin;
    const Vec2 b = corners_px_[(i + 1) % count] - origin;
    alpha.add_segment(a, b, sign);
    light.add_segment(a, b, sign * grey);
  }
  return sign;
}

/// The corners of black cells in the layer's pixels, row by row; the others are not needed, and
/// projecting them is the expensive part.
void Layers::project_face(const Plate& plate, const Lens& lens, const Layer& layer) {
  const TagPattern& pattern = *plate.pattern;
  const int n = pattern.cells;
  corners_px_.assign(static_cast<std::size_t>((n + 1) * (n + 1)), {});
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const int black =
          int{pattern.is_black(row, column)} + int{pattern.is_black(row - 1, column)} +
          int{pattern.is_black(row, column - 1)} + int{pattern.is_black(row - 1, column - 1)};
      if (black == 0 || black == 4) {
        continue;
      }
      Vec3 at{(column - 0.5 * n) * plate.cell_m, (0.5 * n - row) * plate.cell_m, 0.0};
      at.z = height_m(*plate.flaws, plate.size_m, {at.x, at.y});
      const Vec2 pixel = lens.pixel((plate.camera_from_marker * Point<Marker>{at}).v);
      corners_px_[static_cast<std::size_t>(row * (n + 1) + column)] = {
          pixel.x - static_cast<double>(layer.x0), pixel.y - static_cast<double>(layer.y0)};
    }
  }
}

void Layers::draw_face(const Plate& plate, const Lens& lens, Layer& layer, double sign) {
  project_face(plate, lens, layer);
  const TagPattern& pattern = *plate.pattern;
  const int n = pattern.cells;
  const auto corner_px = [&](int row, int column) {
    return corners_px_[static_cast<std::size_t>(row * (n + 1) + column)];
  };
  const double step = static_cast<double>(kFullGrey * plate.light * (kBlackAlbedo - kWhiteAlbedo));
  CoverageWindow light(arena_.data() + layer.light, spans_.data() + layer.spans, layer.width,
                       layer.height);
  // Counter-clockwise in Marker like the rim: right along a black cell's lower edge, up its right.
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column < n; ++column) {
      const int edge = static_cast<int>(pattern.is_black(row - 1, column)) -
                       static_cast<int>(pattern.is_black(row, column));
      if (edge != 0) {
        light.add_segment(corner_px(row, column), corner_px(row, column + 1), sign * step * edge);
      }
    }
  }
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const int edge = static_cast<int>(pattern.is_black(row, column - 1)) -
                       static_cast<int>(pattern.is_black(row, column));
      if (edge != 0) {
        light.add_segment(corner_px(row + 1, column), corner_px(row, column), sign * step * edge);
      }
    }
  }
}

void Layers::draw(const Capsule& capsule, Vec3 lamp_in_camera, const Lens& lens) {
  const Vec2 a = lens.rough_pixel(capsule.a);
  const Vec2 b = lens.rough_pixel(capsule.b);
  const double ra = lens.focal_px() * capsule.radius_a_m / capsule.a.z;
  const double rb = lens.focal_px() * capsule.radius_b_m / capsule.b.z;
  Box box;
  for (const double s : {-1.0, 1.0}) {
    box.add({a.x + s * ra, a.y + s * ra});
    box.add({b.x + s * rb, b.y + s * rb});
  }
  Layer* layer = open_layer(box.low, box.high, lens);
  if (layer == nullptr) {
    return;
  }
  // The outline: an arc round each end between the two tangents.
  const Vec2 axis = b - a;
  const double length = axis.norm();
  const double lean = length > std::abs(ra - rb) ? std::acos((ra - rb) / length)
                                                 : (ra > rb ? 0.0 : 3.14159265358979323846);
  const double heading = std::atan2(axis.y, axis.x);
  corners_px_.clear();
  const Vec2 origin{static_cast<double>(layer->x0), static_cast<double>(layer->y0)};
  const auto arc = [&](Vec2 centre, double radius, double from, double to) {
    for (int i = 0; i <= kArcPieces; ++i) {
      const double angle = from + (to - from) * i / kArcPieces;
      corners_px_.push_back(centre - origin + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
  };
  arc(a, ra, heading + lean, heading + 2.0 * 3.14159265358979323846 - lean);
  arc(b, rb, heading - lean, heading + lean);
  CoverageWindow alpha(arena_.data() + layer->alpha, spans_.data() + layer->spans, layer->width,
                       layer->height);
  for (std::size_t i = 0; i < corners_px_.size(); ++i) {
    alpha.add_segment(corners_px_[i], corners_px_[(i + 1) % corners_px_.size()], -1.0);
  }
  integrate(*layer, layer->alpha);
  shade(capsule, lamp_in_camera, a, b, ra, rb, *layer);
}

/// Depth of the front of the body, a radius nearer than its axis from `a` to `b` in the image.
void Layers::set_depth(const Capsule& capsule, Vec2 a, Vec2 b, Layer& layer) {
  const Vec2 axis = b - a;
  const double near_a = 1.0 / std::max(capsule.a.z - capsule.radius_a_m, 0.01);
  const double near_b = 1.0 / std::max(capsule.b.z - capsule.radius_b_m, 0.01);
  const Vec2 gradient = (near_b - near_a) / std::max(axis.dot(axis), 1e-6) * axis;
  layer.nearness_x = static_cast<float>(gradient.x);
  layer.nearness_y = static_cast<float>(gradient.y);
  layer.nearness0 = static_cast<float>(near_a - gradient.dot(a));
}

ORTHONAV_WIDE void Layers::shade(const Capsule& capsule, Vec3 lamp_in_camera, Vec2 a, Vec2 b,
                                 double radius_a, double radius_b, Layer& layer) {
  set_depth(capsule, a, b, layer);
  const Vec2 axis = b - a;
  const double squared = std::max(axis.dot(axis), 1e-6);
  layer.tint = capsule.tint;
  layer.tool = capsule.tool;
  layer.rank = capsule.rank;
  const float ax = static_cast<float>(axis.x / squared);
  const float ay = static_cast<float>(axis.y / squared);
  const float r0 = static_cast<float>(radius_a);
  const float dr = static_cast<float>(radius_b - radius_a);
  const Vec2 across{-axis.y / std::sqrt(squared), axis.x / std::sqrt(squared)};
  const float cx = static_cast<float>(across.x);
  const float cy = static_cast<float>(across.y);
  const float lamp = static_cast<float>(across.dot({lamp_in_camera.x, lamp_in_camera.y}));
  const float grey = kFullGrey * capsule.albedo;
  const float gloss = capsule.gloss;
  const int stride = CoverageWindow::stride(layer.width);
  for (int row = 0; row < layer.height; ++row) {
    const Span span = spans_[layer.spans + static_cast<std::size_t>(row)];
    const auto offset = static_cast<std::ptrdiff_t>(row) * stride;
    const float* __restrict alpha = arena_.data() + layer.alpha + offset;
    float* __restrict light = arena_.data() + layer.light + offset;
    const float py = static_cast<float>(layer.y0 + row + 0.5 - a.y);
    const float px0 = static_cast<float>(layer.x0 + 0.5 - a.x);
    for (int x = span.low; x < span.high; ++x) {
      const float px = px0 + static_cast<float>(x);
      const float t = std::min(std::max(px * ax + py * ay, 0.0F), 1.0F);
      const float radius = std::max(r0 + t * dr, 0.3F);
      const float q = std::min(std::max((px * cx + py * cy) / radius, -1.0F), 1.0F);
      const float aside = q - 0.45F * lamp;
      const float shine = std::max(1.0F - 5.0F * aside * aside, 0.0F);
      light[x] =
          alpha[x] * grey * (1.0F - 0.58F * q * q + 0.25F * q * lamp + gloss * shine * shine);
    }
  }
}

}  // namespace orthonav::sim

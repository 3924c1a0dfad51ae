#include "engine/report/depth_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vertex_normals.h"

namespace orthonav::engine {
namespace {

constexpr int kSamplesASide = 2;
constexpr double kMaxPixels = 1200.0;
/// Two surfaces this close together are the same one, drawn twice.
constexpr double kSame_m = 1e-6;

/// 0 to 1: a lamp above the viewer's left shoulder, plus ambient light.
double light_on(Vec3 normal, const Viewpoint& view) {
  const Vec3 lamp = (view.toward + 0.45 * view.up - 0.35 * view.right).normalized();
  const double from_lamp = std::max(0.0, normal.dot(lamp));
  const double facing = std::max(0.0, normal.dot(view.toward));
  return 0.30 + 0.45 * from_lamp + 0.25 * facing;
}

std::uint8_t lit(std::uint8_t colour, double light) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(colour * light, 0.0, 255.0)));
}

Rgb colour_of(double value, const SurfacePaint& paint) {
  if (paint.steps.empty()) {
    return value < paint.limit ? paint.near : paint.far;
  }
  if (std::isnan(value)) {
    return paint.far;
  }
  const double count = static_cast<double>(paint.steps.size());
  const double step = std::clamp(count * value / paint.limit, 0.0, count - 1.0);
  return paint.steps[static_cast<std::size_t>(step)];
}

}  // namespace

DepthPicture::DepthPicture(const Viewpoint& view, const PageArea& area, double pixels_per_mm)
    : view_(view), area_(area) {
  const Vec2 size = area.size_mm();
  const double most = std::max(size.x, size.y);
  samples_per_mm_ = kSamplesASide * std::min(pixels_per_mm, kMaxPixels / most);
  const auto samples = [&](double mm) {
    return kSamplesASide *
           std::max(1, static_cast<int>(std::lround(mm * samples_per_mm_ / kSamplesASide)));
  };
  width_ = samples(size.x);
  height_ = samples(size.y);
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  nearness_m_.assign(count, -std::numeric_limits<float>::infinity());
  rgba_.assign(4 * count, 0);
}

void DepthPicture::draw(const nav::TriangleMesh& mesh, const SurfacePaint& paint) {
  const std::vector<Vec3> normals = vertex_normals(mesh.vertices_m, mesh.triangles);
  std::vector<Corner> corners(mesh.vertices_m.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 place = mesh.vertices_m[i];
    const Vec2 at = samples_per_mm_ * (view_.on_page_mm(place) - area_.low_mm);
    corners[i] = {at.x, at.y, place.dot(view_.toward), light_on(normals[i], view_),
                  paint.values.empty() ? paint.limit : paint.values[i]};
  }
  for (const auto& t : mesh.triangles) {
    fill({corners[t[0]], corners[t[1]], corners[t[2]]}, paint);
  }
}

void DepthPicture::fill(const std::array<Corner, 3>& c, const SurfacePaint& paint) {
  const double twice_area =
      (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
  if (!(std::abs(twice_area) > 0.0)) {
    return;
  }
  const auto first = [](double v) { return std::max(0, static_cast<int>(std::floor(v - 0.5))); };
  const auto last = [](double v, int size) {
    return std::min(size - 1, static_cast<int>(std::ceil(v - 0.5)));
  };
  const int x0 = first(std::min({c[0].x, c[1].x, c[2].x}));
  const int x1 = last(std::max({c[0].x, c[1].x, c[2].x}), width_);
  const int y0 = first(std::min({c[0].y, c[1].y, c[2].y}));
  const int y1 = last(std::max({c[0].y, c[1].y, c[2].y}), height_);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5;
      const double py = y + 0.5;
      const auto fraction = [&](const Corner& a, const Corner& b) {
        return ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / twice_area;
      };
      const double w0 = fraction(c[1], c[2]);
      const double w1 = fraction(c[2], c[0]);
      const double w2 = 1.0 - w0 - w1;
      if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) {
        continue;
      }
      const auto mixed = [&](double Corner::*part) {
        return w0 * c[0].*part + w1 * c[1].*part + w2 * c[2].*part;
      };
      put(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x),
          {px, py, mixed(&Corner::nearness_m), mixed(&Corner::light), mixed(&Corner::value)},
          paint);
    }
  }
}

void DepthPicture::put(std::size_t sample, const Corner& at, const SurfacePaint& paint) {
  if (at.nearness_m < static_cast<double>(nearness_m_[sample]) - kSame_m) {
    return;
  }
  nearness_m_[sample] = static_cast<float>(at.nearness_m);
  const Rgb colour = colour_of(at.value, paint);
  rgba_[4 * sample] = lit(colour.red, at.light);
  rgba_[4 * sample + 1] = lit(colour.green, at.light);
  rgba_[4 * sample + 2] = lit(colour.blue, at.light);
  rgba_[4 * sample + 3] = 255;
}

bool DepthPicture::hides(Vec3 place_m, double by_m) const {
  const Vec2 at = samples_per_mm_ * (view_.on_page_mm(place_m) - area_.low_mm);
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < width_ && at.y < height_)) {
    return false;
  }
  const std::size_t sample = static_cast<std::size_t>(at.y) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(at.x);
  return static_cast<double>(nearness_m_[sample]) > place_m.dot(view_.toward) + by_m;
}

RgbaImage DepthPicture::image() const {
  RgbaImage out{width_ / kSamplesASide, height_ / kSamplesASide, {}};
  out.pixels.reserve(rgba_.size() / (kSamplesASide * kSamplesASide));
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      std::array<int, 4> sum{};
      for (int dy = 0; dy < kSamplesASide; ++dy) {
        for (int dx = 0; dx < kSamplesASide; ++dx) {
          const auto row = static_cast<std::size_t>(kSamplesASide * y + dy);
          const auto at = 4 * (row * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(kSamplesASide * x + dx));
          // Empty samples are black; only alpha may count them.
          for (std::size_t k = 0; k < 4; ++k) {
            sum[k] += rgba_[at + k];
          }
        }
      }
      const int covered = sum[3] / 255;
      for (std::size_t k = 0; k < 3; ++k) {
        out.pixels.push_back(static_cast<std::uint8_t>(covered > 0 ? sum[k] / covered : 0));
      }
      out.pixels.push_back(static_cast<std::uint8_t>(sum[3] / (kSamplesASide * kSamplesASide)));
    }
  }
  return out;
}

}  // namespace orthonav::engine

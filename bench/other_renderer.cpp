#include "bench/other_renderer.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <algorithm>
#include <cmath>

#include "bench/other_view.h"

namespace orthonav::bench {
namespace {

constexpr int kFine = 8;  ///< rays along a pixel's side
/// A Gaussian blur ends this many SDs from its middle.
constexpr double kGaussianReach = 4.5;

std::vector<DrawnTag> drawn(std::span<const PrintedTag> tags) {
  apriltag_family_t* family = tag36h11_create();
  std::vector<DrawnTag> out;
  for (const PrintedTag& print : tags) {
    DrawnTag tag{print, {}};
    // The highest bit comes first; cells are counted from the border's outer edge.
    const std::uint64_t code = family->codes[print.id];
    for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
      tag.white[8 * family->bit_y[bit] + family->bit_x[bit]] =
          ((code >> (family->nbits - 1 - bit)) & 1U) != 0;
    }
    out.push_back(tag);
  }
  tag36h11_destroy(family);
  return out;
}

/// The part of a blur's footprint that falls on the square, an eighth of a pixel wide, that lies
/// `x`, `y` eighths away.
double footprint(const Optics& optics, int x, int y) {
  constexpr int kParts = 9;
  double sum = 0.0;
  for (int j = 0; j < kParts; ++j) {
    for (int i = 0; i < kParts; ++i) {
      const double u = (x + (i + 0.5) / kParts - 0.5) / kFine / optics.blur_px;
      const double v = (y + (j + 0.5) / kParts - 0.5) / kFine / optics.blur_px;
      const double r2 = u * u + v * v;
      sum += optics.blur == Blur::kDisk ? (r2 <= 1.0 ? 1.0 : 0.0) : std::exp(-0.5 * r2);
    }
  }
  return sum;
}

std::vector<float> pixel_kernel(const Optics& optics, int reach) {
  const int side = kFine + 2 * reach;
  std::vector<double> sum(static_cast<std::size_t>(side * side), 0.0);
  double total = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const double weight = optics.blur == Blur::kNone ? 1.0 : footprint(optics, x, y);
      for (int j = 0; j < kFine; ++j) {
        for (int i = 0; i < kFine; ++i) {
          sum[static_cast<std::size_t>((y + reach + j) * side + x + reach + i)] += weight;
        }
      }
      total += weight * kFine * kFine;
    }
  }
  std::vector<float> kernel;
  for (const double s : sum) {
    kernel.push_back(static_cast<float>(s / total));
  }
  return kernel;
}

int reach_of(const Optics& optics) {
  if (optics.blur == Blur::kNone) {
    return 0;
  }
  const double px = optics.blur_px * (optics.blur == Blur::kGaussian ? kGaussianReach : 1.0);
  return static_cast<int>(std::ceil(px * kFine + 0.5));
}

}  // namespace

OtherRenderer::OtherRenderer(std::span<const PrintedTag> tags, const Optics& optics,
                             const Lighting& lighting, std::uint64_t seed)
    : tags_(drawn(tags)),
      optics_(optics),
      lighting_(lighting),
      clutter_(seed),
      reach_(reach_of(optics)),
      kernel_(pixel_kernel(optics, reach_)) {}

OtherRenderer::Box OtherRenderer::box_of(std::span<const Moment> moments, const Lens& lens,
                                         const Transform<LeftCamera, Rig>& camera_from_rig,
                                         std::size_t tag) const {
  const PrintedTag& print = tags_[tag].print;
  const double half = print.size_m * (0.5 + print.margin_cells / 8.0);
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  for (const Moment& moment : moments) {
    for (const Vec2 corner : {Vec2{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
      const Vec3 p = (camera_from_rig * moment.world_from_rig.inverse() *
                      moment.world_from_marker[tag] * Point<Marker>{{corner.x, corner.y, 0.0}})
                         .v;
      const Vec2 px = lens.pixel({p.x / p.z, p.y / p.z});
      low = {std::min(low.x, px.x), std::min(low.y, px.y)};
      high = {std::max(high.x, px.x), std::max(high.y, px.y)};
    }
  }
  const int log_likelihood_ratio = (reach_ + kFine - 1) / kFine;
  const auto within = [&](double v, int size) {
    return std::clamp(static_cast<int>(std::floor(v)), log_likelihood_ratio,
                      size - log_likelihood_ratio);
  };
  return {within(low.x - log_likelihood_ratio - 1, lens.width_px),
          within(low.y - log_likelihood_ratio - 1, lens.height_px),
          within(high.x + log_likelihood_ratio + 2, lens.width_px),
          within(high.y + log_likelihood_ratio + 2, lens.height_px)};
}

void OtherRenderer::draw_box(std::span<const Moment> moments, const RayGrid& rays,
                             const Transform<LeftCamera, Rig>& camera_from_rig,
                             std::span<const DrawnTag> tags, const Box& box, LightImage& image) {
  if (box.left >= box.right || box.top >= box.bottom) {
    return;
  }
  const int log_likelihood_ratio = (reach_ + kFine - 1) / kFine;
  const int x0 = box.left - log_likelihood_ratio;
  const int y0 = box.top - log_likelihood_ratio;
  const int columns = box.right + log_likelihood_ratio - x0;
  const int rows = box.bottom + log_likelihood_ratio - y0;
  const int width = columns * kFine;
  fine_.assign(static_cast<std::size_t>(width * rows * kFine), 0.0F);
  for (const Moment& moment : moments) {
    const OtherView view(moment, camera_from_rig, tags, lighting_, clutter_);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const Vec2 a = rays.node(x0 + x, y0 + y);
        const Vec2 b = rays.node(x0 + x + 1, y0 + y);
        const Vec2 c = rays.node(x0 + x, y0 + y + 1);
        const Vec2 d = rays.node(x0 + x + 1, y0 + y + 1);
        for (int j = 0; j < kFine; ++j) {
          for (int i = 0; i < kFine; ++i) {
            // Rows and columns are sheared, so that an edge along them meets 64 rays in turn and
            // not 8 at once.
            const double s = (i + (j + 0.5) / kFine) / kFine;
            const double t = (j + (i + 0.5) / kFine) / kFine;
            const Vec2 ray = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
            fine_[static_cast<std::size_t>((y * kFine + j) * width + x * kFine + i)] +=
                view.light(ray);
          }
        }
      }
    }
  }
  const int side = kFine + 2 * reach_;
  const float fraction = 1.0F / static_cast<float>(moments.size());
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      const float* from =
          fine_.data() + ((y - y0) * kFine - reach_) * width + (x - x0) * kFine - reach_;
      float sum = 0.0F;
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          sum += from[j * width + i] * kernel_[static_cast<std::size_t>(j * side + i)];
        }
      }
      image.light[static_cast<std::size_t>(y * image.width_px + x)] = fraction * sum;
    }
  }
}

void OtherRenderer::vignette(const Lens& lens, LightImage& image) const {
  if (optics_.vignetting <= 0.0) {
    return;
  }
  const double corner2 = 0.25 * (lens.width_px * lens.width_px + lens.height_px * lens.height_px);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const Vec2 off =
          Vec2{x + 0.5, y + 0.5} - 0.5 * Vec2{1.0 * lens.width_px, 1.0 * lens.height_px};
      image.light[static_cast<std::size_t>(y * image.width_px + x)] *=
          static_cast<float>(1.0 - optics_.vignetting * off.dot(off) / corner2);
    }
  }
}

void OtherRenderer::render(std::span<const Moment> moments, const RayGrid& rays,
                           const Transform<LeftCamera, Rig>& camera_from_rig, LightImage& image) {
  const Lens& lens = rays.lens();
  image = {lens.width_px, lens.height_px, {}};
  image.light.resize(static_cast<std::size_t>(lens.width_px * lens.height_px));
  const OtherView middle(moments[moments.size() / 2], camera_from_rig, tags_, lighting_, clutter_);
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) {
      image.light[static_cast<std::size_t>(y * lens.width_px + x)] =
          middle.light(rays.middle(x, y));
    }
  }
  for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
    draw_box(moments, rays, camera_from_rig, tags_, box_of(moments, lens, camera_from_rig, tag),
             image);
  }
  vignette(lens, image);
}

void OtherRenderer::render_tag(std::span<const Moment> moments, const RayGrid& rays,
                               const Transform<LeftCamera, Rig>& camera_from_rig, std::size_t tag,
                               LightImage& image) {
  const Lens& lens = rays.lens();
  image = {lens.width_px, lens.height_px, {}};
  image.light.resize(static_cast<std::size_t>(lens.width_px * lens.height_px));
  const Box box = box_of(moments, lens, camera_from_rig, tag);
  std::vector<DrawnTag> alone{tags_[tag]};
  alone[0].print.margin_cells = 100.0;
  std::vector<Moment> its(moments.begin(), moments.end());
  for (Moment& moment : its) {
    moment.world_from_marker = {moment.world_from_marker[tag]};
  }
  draw_box(its, rays, camera_from_rig, alone, box, image);
  vignette(lens, image);
}

double OtherRenderer::visible_fraction(const Moment& moment, const Lens& lens,
                                       const Transform<LeftCamera, Rig>& camera_from_rig,
                                       std::size_t tag) const {
  constexpr int kPoints = 24;
  const OtherView view(moment, camera_from_rig, tags_, lighting_, clutter_);
  const auto camera_from_marker =
      camera_from_rig * moment.world_from_rig.inverse() * moment.world_from_marker[tag];
  int seen = 0;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 at =
          tags_[tag].print.size_m * Vec3{(i + 0.5) / kPoints - 0.5, (j + 0.5) / kPoints - 0.5, 0.0};
      const Vec3 p = (camera_from_marker * Point<Marker>{at}).v;
      const Vec2 ray{p.x / p.z, p.y / p.z};
      const Vec2 px = lens.pixel(ray);
      const bool inside = p.z > 0.0 && px.x > 2.0 && px.y > 2.0 && px.x < lens.width_px - 2.0 &&
                          px.y < lens.height_px - 2.0;
      if (inside && view.cosine(tag, at) > 0.0 && !view.is_behind_finger(ray)) {
        ++seen;
      }
    }
  }
  return static_cast<double>(seen) / (kPoints * kPoints);
}

}  // namespace orthonav::bench

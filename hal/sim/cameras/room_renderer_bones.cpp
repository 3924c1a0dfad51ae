#include "hal/sim/cameras/room_renderer_bones.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace orthonav::sim {
namespace {

/// Bone this far under the tissue is never visible.
constexpr double kBuriedM = 0.004;
constexpr Vec3 kLampInSpine{0.30, 0.90, 0.30};
/// As the nearness of a vertex that no triangle has needed so far.
constexpr float kNotProjected = -1.0F;

std::uint64_t cell_key(Vec3 p, double cell_m) {
  const auto part = [&](double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / cell_m)) & 0x1FFFFF);
  };
  return part(p.x) | part(p.y) << 21 | part(p.z) << 42;
}

struct Cluster {
  Vec3 sum{};
  Vec3 normal{};
  double count = 0.0;
};

/// Vertices in Spine, merged by cell if asked for, with normals weighted by area.
struct Thinned {
  std::vector<Cluster> clusters;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Thinned thinned(const RoomLevel& level, double cell_m) {
  Thinned out;
  std::unordered_map<std::uint64_t, std::uint32_t> cells;
  std::vector<std::uint32_t> cluster_of;
  std::vector<Vec3> points;
  for (const Vec3 v : level.vertices_m) {
    const Vec3 p = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
    points.push_back(p);
    std::uint32_t index = static_cast<std::uint32_t>(out.clusters.size());
    if (cell_m > 0.0) {
      index = cells.try_emplace(cell_key(p, cell_m), index).first->second;
    }
    if (index == out.clusters.size()) {
      out.clusters.emplace_back();
    }
    out.clusters[index].sum += p;
    out.clusters[index].count += 1.0;
    cluster_of.push_back(index);
  }
  for (const auto& t : level.triangles) {
    if (t[0] >= points.size() || t[1] >= points.size() || t[2] >= points.size()) {
      continue;
    }
    const Vec3 normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
    const std::array<std::uint32_t, 3> c{cluster_of[t[0]], cluster_of[t[1]], cluster_of[t[2]]};
    for (const std::uint32_t i : c) {
      out.clusters[i].normal += normal;
    }
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
      out.triangles.push_back(c);
    }
  }
  return out;
}

/// Pixels [x0, x1) by [y0, y1).
struct PixelRange {
  int x0 = 0;
  int x1 = 0;
  int y0 = 0;
  int y1 = 0;
};

/// The pixels whose centres lie between a triangle's corners, along either axis; may be empty.
template <class Vertex>
PixelRange pixels_of(const Vertex& a, const Vertex& b, const Vertex& c, float width, float height) {
  const float low_x = std::max(std::min({a.x, b.x, c.x}), 0.0F);
  const float high_x = std::min(std::max({a.x, b.x, c.x}), width);
  const float low_y = std::max(std::min({a.y, b.y, c.y}), 0.0F);
  const float high_y = std::min(std::max({a.y, b.y, c.y}), height);
  if (!(low_x < high_x && low_y < high_y)) {
    return {};
  }
  return {static_cast<int>(std::ceil(low_x - 0.5F)), static_cast<int>(std::ceil(high_x - 0.5F)),
          static_cast<int>(std::ceil(low_y - 0.5F)), static_cast<int>(std::ceil(high_y - 0.5F))};
}

float light_on(Vec3 normal, double height_m) {
  const double length = normal.norm();
  const Vec3 n = length > 0.0 ? normal / length : Vec3{0, 1, 0};
  const double lamp = std::max(0.0, n.dot(kLampInSpine.normalized()));
  const double sky = 0.5 + 0.5 * n.y;
  // Deep in the wound, less of the sky is visible.
  const double open = std::clamp(0.55 + height_m / 0.06, 0.45, 1.0);
  return static_cast<float>((0.72 * lamp + 0.28 * sky) * open);
}

}  // namespace

ShownBones::ShownBones(const RoomDescription& room, const Ground& ground, double cell_m) {
  for (const RoomLevel& level : room.levels) {
    const Thinned thin = thinned(level, cell_m);
    constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
    std::vector<std::uint32_t> index(thin.clusters.size(), kUnused);
    const auto height_of = [&](const Cluster& c) {
      return c.sum.y / c.count -
             static_cast<double>(ground.tissue_height(static_cast<float>(c.sum.z / c.count)));
    };
    for (const auto& t : thin.triangles) {
      bool shows = false;
      for (const std::uint32_t i : t) {
        shows = shows || height_of(thin.clusters[i]) > -kBuriedM;
      }
      if (!shows) {
        continue;
      }
      std::array<std::uint32_t, 3> out{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Cluster& c = thin.clusters[t[k]];
        if (index[t[k]] == kUnused) {
          index[t[k]] = static_cast<std::uint32_t>(x.size());
          const Vec3 p = c.sum / c.count;
          x.push_back(static_cast<float>(p.x));
          y.push_back(static_cast<float>(p.y));
          z.push_back(static_cast<float>(p.z));
          height.push_back(static_cast<float>(height_of(c)));
          lit.push_back(light_on(c.normal, height_of(c)));
        }
        out[k] = index[t[k]];
      }
      triangles.push_back(out);
    }
  }
}

void BoneImage::reset(int width_px, int height_px) {
  if (width_px != width_ || height_px != height_px_) {
    width_ = width_px;
    height_px_ = height_px;
    const std::size_t size =
        static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    nearness_.assign(size, 0.0F);
    lit_.assign(size, 0.0F);
    height_.assign(size, 0.0F);
  } else if (low_row_ < high_row_) {
    std::fill(nearness_.begin() + static_cast<std::ptrdiff_t>(low_row_) * width_,
              nearness_.begin() + static_cast<std::ptrdiff_t>(high_row_) * width_, 0.0F);
  }
  low_row_ = height_px;
  high_row_ = 0;
}

template <class AnyLens>
void BoneImage::draw(const ShownBones& bones, const Ground& ground,
                     const Transform<LeftCamera, Spine>& camera_from_spine, const AnyLens& lens,
                     double scale) {
  vertices_.resize(std::max(vertices_.size(), bones.x.size()));
  const Vec3 eye = camera_from_spine.inverse().translation();
  const float ex = static_cast<float>(eye.x);
  const float ey = static_cast<float>(eye.y);
  const float ez = static_cast<float>(eye.z);
  for (std::size_t i = 0; i < bones.x.size(); ++i) {
    const float px = bones.x[i];
    const float py = bones.y[i];
    const float pz = bones.z[i];
    // The line of sight must pass the skin inside the wound.
    const float skin = ground.skin_height(pz);
    const float s = py < skin && ey > py ? (skin - py) / (ey - py) : 0.0F;
    vertices_[i].seen = 1.0F - ground.rim_at(px + s * (ex - px), pz + s * (ez - pz));
    vertices_[i].nearness = kNotProjected;
  }
  const auto project = [&](std::size_t i) {
    const Vec3 p = (camera_from_spine *
                    Point<Spine>{{static_cast<double>(bones.x[i]), static_cast<double>(bones.y[i]),
                                  static_cast<double>(bones.z[i])}})
                       .v;
    Vertex& v = vertices_[i];
    v.nearness = 0.0F;
    if (!(p.z > 0.06)) {
      return;
    }
    const Vec2 pixel = lens.rough_pixel(p) * scale;
    v.x = static_cast<float>(pixel.x);
    v.y = static_cast<float>(pixel.y);
    v.nearness = static_cast<float>(1.0 / p.z);
    v.lit = bones.lit[i];
    v.height = bones.height[i];
  };
  for (const auto& t : bones.triangles) {
    if (vertices_[t[0]].seen < 0.0F && vertices_[t[1]].seen < 0.0F && vertices_[t[2]].seen < 0.0F) {
      continue;
    }
    for (const std::uint32_t i : t) {
      if (vertices_[i].nearness == kNotProjected) {
        project(i);
      }
    }
    draw(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
  }
}

void BoneImage::draw(const Vertex& a, const Vertex& b, const Vertex& c) {
  if (a.nearness == 0.0F || b.nearness == 0.0F || c.nearness == 0.0F) {
    return;
  }
  // Seen from outside, a triangle runs clockwise in the image, since y points down.
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(area < 0.0F)) {
    return;
  }
  const PixelRange in =
      pixels_of(a, b, c, static_cast<float>(width_), static_cast<float>(height_px_));
  if (in.x0 >= in.x1 || in.y0 >= in.y1) {
    return;
  }
  low_row_ = std::min(low_row_, in.y0);
  high_row_ = std::max(high_row_, in.y1);
  const float inverse = 1.0F / area;
  for (int row = in.y0; row < in.y1; ++row) {
    for (int column = in.x0; column < in.x1; ++column) {
      const float px = static_cast<float>(column) + 0.5F;
      const float py = static_cast<float>(row) + 0.5F;
      const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) * inverse;
      const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) * inverse;
      const float wa = 1.0F - wb - wc;
      if (wa < 0.0F || wb < 0.0F || wc < 0.0F) {
        continue;
      }
      const float near = wa * a.nearness + wb * b.nearness + wc * c.nearness;
      const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(column);
      const float height = wa * a.height + wb * b.height + wc * c.height;
      if (near <= nearness_[i] || height < 0.0F || wa * a.seen + wb * b.seen + wc * c.seen < 0.0F) {
        continue;
      }
      nearness_[i] = near;
      lit_[i] = wa * a.lit + wb * b.lit + wc * c.lit;
      height_[i] = height;
    }
  }
}

template void BoneImage::draw(const ShownBones&, const Ground&, const Transform<LeftCamera, Spine>&,
                              const CameraLens&, double);
template void BoneImage::draw(const ShownBones&, const Ground&, const Transform<LeftCamera, Spine>&,
                              const PinholeLens&, double);
template void BoneImage::draw(const ShownBones&, const Ground&, const Transform<LeftCamera, Spine>&,
                              const DepthLens&, double);

}  // namespace orthonav::sim

#include "hal/sim/cameras/room_renderer_ground.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace orthonav::sim {
namespace {

constexpr float kSkinAboveTip = 0.003F;
// Retracted past the facets, so that the skin does not hide entry points from a standing surgeon.
constexpr float kWoundHalfWidth = 0.056F;
constexpr float kWoundPastTips = 0.034F;
constexpr float kFloorBelow = 0.95F;
constexpr float kTableHalfWidth = 0.45F;
constexpr float kTableHalfLength = 0.95F;

float smooth_step(float from, float to, float v) {
  const float s = std::clamp((v - from) / (to - from), 0.0F, 1.0F);
  return s * s * (3.0F - 2.0F * s);
}

/// Least squares of y = a + b t + c t², with as many terms as the points allow.
std::array<double, 3> parabola(const std::vector<Vec2>& points) {
  std::array<std::array<double, 4>, 3> m{};
  const std::size_t terms = std::min<std::size_t>(points.size(), 3);
  for (const Vec2 p : points) {
    const std::array<double, 3> basis{1.0, p.x, p.x * p.x};
    for (std::size_t r = 0; r < terms; ++r) {
      for (std::size_t c = 0; c < terms; ++c) {
        m[r][c] += basis[r] * basis[c];
      }
      m[r][3] += basis[r] * p.y;
    }
  }
  std::array<double, 3> solution{};
  for (std::size_t i = 0; i < terms; ++i) {
    if (std::abs(m[i][i]) < 1e-18) {
      continue;
    }
    for (std::size_t r = i + 1; r < terms; ++r) {
      const double factor = m[r][i] / m[i][i];
      for (std::size_t c = i; c < 4; ++c) {
        m[r][c] -= factor * m[i][c];
      }
    }
  }
  for (std::size_t i = terms; i-- > 0;) {
    double sum = m[i][3];
    for (std::size_t c = i + 1; c < terms; ++c) {
      sum -= m[i][c] * solution[c];
    }
    solution[i] = std::abs(m[i][i]) < 1e-18 ? 0.0 : sum / m[i][i];
  }
  return solution;
}

struct Tip {
  Vec3 in_spine{0.0, -1e9, 0.0};
  bool operated = false;
};

bool is_operated(const RoomDescription& room, const RoomLevel& level) {
  return room.operated.empty() ||
         std::find(room.operated.begin(), room.operated.end(), level.label) != room.operated.end();
}

/// From the lowest to the highest tip along the back.
struct Stretch {
  double low = 1e9;
  double high = -1e9;

  void add(double z) {
    low = std::min(low, z);
    high = std::max(high, z);
  }
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// The height of the tips along the back, from its middle on.
std::array<double, 3> profile_of(const std::vector<Tip>& tips, double middle) {
  std::vector<Vec2> profile;
  for (const Tip& tip : tips) {
    profile.push_back({tip.in_spine.z - middle, tip.in_spine.y});
  }
  return parabola(profile);
}

/// The most posterior point of every level, in Spine.
std::vector<Tip> tips_of(const RoomDescription& room) {
  std::vector<Tip> tips;
  for (const RoomLevel& level : room.levels) {
    if (level.vertices_m.empty()) {
      continue;
    }
    Tip tip;
    tip.operated = is_operated(room, level);
    for (const Vec3 v : level.vertices_m) {
      const Vec3 p = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
      if (p.y > tip.in_spine.y) {
        tip.in_spine = p;
      }
    }
    tips.push_back(tip);
  }
  return tips;
}

}  // namespace

Blotches::Blotches() : values_(static_cast<std::size_t>(kPatch) * kPatch, 0.0F) {
  Random random(20190131);
  float total = 0.0F;
  for (int cells = 4; cells <= 64; cells *= 2) {
    std::vector<float> lattice;
    for (int i = 0; i < cells * cells; ++i) {
      lattice.push_back(static_cast<float>(random.uniform()));
    }
    const float fraction = 2.0F / std::sqrt(static_cast<float>(cells));
    total += fraction;
    for (int y = 0; y < kPatch; ++y) {
      for (int x = 0; x < kPatch; ++x) {
        const float u = static_cast<float>(x * cells) / kPatch;
        const float v = static_cast<float>(y * cells) / kPatch;
        const int i = static_cast<int>(u);
        const int j = static_cast<int>(v);
        const float s = smooth_step(0.0F, 1.0F, u - static_cast<float>(i));
        const float t = smooth_step(0.0F, 1.0F, v - static_cast<float>(j));
        const auto value = [&](int column, int row) {
          return lattice[static_cast<std::size_t>((row % cells) * cells + column % cells)];
        };
        values_[static_cast<std::size_t>(y * kPatch + x)] +=
            fraction * ((1 - t) * ((1 - s) * value(i, j) + s * value(i + 1, j)) +
                        t * ((1 - s) * value(i, j + 1) + s * value(i + 1, j + 1)));
      }
    }
  }
  for (float& v : values_) {
    v = std::clamp(0.5F + 1.6F * (v / total - 0.5F), 0.0F, 1.0F);
  }
}

Ground::Ground(const RoomDescription& room) {
  const std::vector<Tip> tips = tips_of(room);
  if (tips.empty()) {
    return;
  }
  Stretch back;
  Stretch wound;
  double x_sum = 0.0;
  for (const Tip& tip : tips) {
    back.add(tip.in_spine.z);
    x_sum += tip.in_spine.x;
    if (tip.operated) {
      wound_ = true;
      wound.add(tip.in_spine.z);
    }
  }
  const auto [a, b, c] = profile_of(tips, back.middle());
  z0_ = static_cast<float>(back.middle());
  a_ = static_cast<float>(a) + kSkinAboveTip;
  b_ = static_cast<float>(b);
  c_ = static_cast<float>(c);
  low_ = static_cast<float>(back.low) - 0.02F;
  high_ = static_cast<float>(back.high) + 0.02F;
  wound_x_ = static_cast<float>(x_sum / static_cast<double>(tips.size()));
  // A spinous process points down the back: the bone lies mostly above its tip.
  wound_z_ = z0_ + 0.006F;
  if (!wound_) {
    return;
  }
  wound_z_ = static_cast<float>(wound.middle()) + 0.006F;
  half_width_ = kWoundHalfWidth;
  half_length_ = static_cast<float>(0.5 * (wound.high - wound.low)) + kWoundPastTips;
}

/// Where the ray reaches this depth below the skin.
void Ground::reach(const std::array<float, 3>& o, const std::array<float, 3>& d, float below_skin,
                   Hit& hit) const {
  // Two steps suffice: the skin's height changes slowly along the back.
  float t = (a_ - below_skin - o[1]) / d[1];
  float z = o[2] + t * d[2];
  for (int i = 0; i < 2; ++i) {
    t = (skin_height(z) - below_skin - o[1]) / d[1];
    z = o[2] + t * d[2];
  }
  hit.distance = t;
  hit.x = o[0] + t * d[0];
  hit.y = o[1] + t * d[1];
  hit.z = z;
}

Ground::Hit Ground::hit(const std::array<float, 3>& o, const std::array<float, 3>& d) const {
  Hit hit;
  hit.lamp = d[1];
  if (!(d[1] < -1e-3F)) {
    return hit;
  }
  reach(o, d, 0.0F, hit);
  if (hit.distance <= 0.0F) {
    return hit;
  }
  hit.rim = rim_at(hit.x, hit.z);
  hit.skin_rim = hit.rim;
  if (wound_ && hit.rim < 1.0F) {
    reach(o, d, kDepth, hit);
    hit.rim = rim_at(hit.x, hit.z);
    hit.kind = hit.rim < 1.0F ? Kind::kTissue : Kind::kWall;
    return hit;
  }
  if (std::abs(hit.x - wound_x_) > kTableHalfWidth ||
      std::abs(hit.z - wound_z_) > kTableHalfLength) {
    hit.distance = (a_ - kFloorBelow - o[1]) / d[1];
    hit.x = o[0] + hit.distance * d[0];
    hit.y = o[1] + hit.distance * d[1];
    hit.z = o[2] + hit.distance * d[2];
    hit.kind = Kind::kFloor;
    return hit;
  }
  const bool window = wound_ && std::abs(hit.x - wound_x_) < half_width_ + 0.030F &&
                      std::abs(hit.z - wound_z_) < half_length_ + 0.030F;
  hit.kind = window ? Kind::kSkin : Kind::kDrape;
  return hit;
}

float Ground::grey(const Hit& hit) const {
  switch (hit.kind) {
    case Kind::kNothing:
      return 70.0F;
    case Kind::kFloor:
      return 62.0F + 14.0F * (blotches_.at(0.3F * hit.x, 0.3F * hit.z) - 0.5F);
    case Kind::kDrape: {
      const float side = std::abs(hit.x - wound_x_) / kTableHalfWidth;
      return 96.0F - 22.0F * side * side +
             42.0F * (blotches_.at(2.5F * hit.x, 1.7F * hit.z) - 0.5F);
    }
    case Kind::kSkin:
      return 118.0F + 16.0F * (blotches_.at(6.0F * hit.x, 6.0F * hit.z) - 0.5F);
    case Kind::kWall:
      return 62.0F + 25.0F * (blotches_.at(9.0F * hit.x, 9.0F * hit.z) - 0.5F);
    case Kind::kTissue:
      return 82.0F - 26.0F * smooth_step(0.4F, 1.0F, hit.rim) +
             44.0F * (blotches_.at(7.0F * hit.x, 7.0F * hit.z) - 0.5F);
  }
  return 0.0F;
}

}  // namespace orthonav::sim

#include "tests/support/voxelised_body.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace orthonav::test {
namespace {

constexpr double kCortex_hu = 950.0;
constexpr double kCancellous_hu = 230.0;
constexpr double kSoft_hu = 30.0;

/// Smooth noise of SD 1 on a lattice of 3 mm.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    Random random(seed);
    for (float& v : lattice_) {
      v = static_cast<float>(random.normal());
    }
  }
  [[nodiscard]] double at(Vec3 p_m) const {
    std::array<int, 3> whole{};
    Vec3 part;
    for (int a = 0; a < 3; ++a) {
      const double q = p_m[a] / 0.003;
      whole[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(q));
      part[a] = q - std::floor(q);
    }
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
      double weight = 1.0;
      std::size_t index = 0;
      for (int a = 0; a < 3; ++a) {
        const int up = (c >> a) & 1;
        weight *= up ? part[a] : 1.0 - part[a];
        index = index * kSide +
                static_cast<std::size_t>((whole[static_cast<std::size_t>(a)] + up) & (kSide - 1));
      }
      sum += weight * static_cast<double>(lattice_[index]);
    }
    return 1.7 * sum;
  }

 private:
  static constexpr int kSide = 32;
  std::array<float, kSide * kSide * kSide> lattice_{};
};

using Triangle = std::array<Vec3, 3>;

/// The depths at which a column crosses the triangles, ascending.
struct Columns {
  int first_i = 0, first_j = 0, count_i = 0, count_j = 0;
  std::vector<std::vector<double>> crossings_m;
};

void add_triangle(const FineBody& body, const Triangle& t, Columns& columns) {
  // A column never runs exactly through a vertex: it is set off by a hair.
  constexpr double kHair_m = 1.2345e-9;
  const auto low = [&](int a) { return std::min({t[0][a], t[1][a], t[2][a]}); };
  const auto high = [&](int a) { return std::max({t[0][a], t[1][a], t[2][a]}); };
  const auto cell = [&](double v, int a) { return (v - body.origin_m[a]) / body.step_m; };
  const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (area == 0.0) {
    return;
  }
  for (int j = static_cast<int>(std::ceil(cell(low(1), 1))) - 1; j <= cell(high(1), 1) + 1; ++j) {
    for (int i = static_cast<int>(std::ceil(cell(low(0), 0))) - 1; i <= cell(high(0), 0) + 1; ++i) {
      const double x = body.origin_m.x + i * body.step_m + kHair_m;
      const double y = body.origin_m.y + j * body.step_m + 2.7 * kHair_m;
      const double u = ((x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y)) / area;
      const double v = ((t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y)) / area;
      if (u < 0.0 || v < 0.0 || u + v > 1.0) {
        continue;
      }
      const int ci = i - columns.first_i;
      const int cj = j - columns.first_j;
      if (ci >= 0 && cj >= 0 && ci < columns.count_i && cj < columns.count_j) {
        columns.crossings_m[static_cast<std::size_t>(cj * columns.count_i + ci)].push_back(
            t[0].z + u * (t[1].z - t[0].z) + v * (t[2].z - t[0].z));
      }
    }
  }
}

/// A bone in its own box of the grid.
struct Filled {
  std::array<int, 3> first{};
  std::array<int, 3> size{};
  std::vector<float> share;
  std::vector<std::uint8_t> depth;  ///< chamfer distance in thirds of a step, capped
  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
};

void chamfer(Filled& bone, std::uint8_t cap) {
  bone.depth.assign(bone.share.size(), 0);
  for (std::size_t n = 0; n < bone.share.size(); ++n) {
    bone.depth[n] = bone.share[n] > 0.5F ? cap : std::uint8_t{0};
  }
  const auto pass = [&](int sign) {
    for (int kk = 0; kk < bone.size[2]; ++kk) {
      for (int jj = 0; jj < bone.size[1]; ++jj) {
        for (int ii = 0; ii < bone.size[0]; ++ii) {
          const int i = sign > 0 ? ii : bone.size[0] - 1 - ii;
          const int j = sign > 0 ? jj : bone.size[1] - 1 - jj;
          const int k = sign > 0 ? kk : bone.size[2] - 1 - kk;
          std::uint8_t& here = bone.depth[bone.at(i, j, k)];
          if (here == 0) {
            continue;
          }
          for (int n = 0; n < 13; ++n) {
            const int code = n;  // the 13 neighbours that come before
            const int di = code % 3 - 1;
            const int dj = code / 3 % 3 - 1;
            const int dk = code / 9 - 1;
            const int x = i + sign * di;
            const int y = j + sign * dj;
            const int z = k + sign * dk;
            if (x < 0 || y < 0 || z < 0 || x >= bone.size[0] || y >= bone.size[1] ||
                z >= bone.size[2]) {
              continue;
            }
            const int cost = 2 + std::abs(di) + std::abs(dj) + std::abs(dk);
            here =
                static_cast<std::uint8_t>(std::min<int>(here, bone.depth[bone.at(x, y, z)] + cost));
          }
        }
      }
    }
  };
  pass(1);
  pass(-1);
}

Filled filled(const FineBody& body, const BodyBone& bone) {
  std::vector<Vec3> placed;
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};
  for (const Vec3& v : bone.mesh.vertices_m) {
    placed.push_back(bone.scanner_from_model(v));
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], placed.back()[a]);
      high[a] = std::max(high[a], placed.back()[a]);
    }
  }
  Filled out;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    out.first[n] = static_cast<int>(std::floor((low[a] - body.origin_m[a]) / body.step_m)) - 2;
    out.size[n] =
        static_cast<int>(std::ceil((high[a] - body.origin_m[a]) / body.step_m)) + 3 - out.first[n];
  }
  Columns columns{out.first[0], out.first[1], out.size[0], out.size[1], {}};
  columns.crossings_m.resize(static_cast<std::size_t>(out.size[0] * out.size[1]));
  for (const auto& t : bone.mesh.triangles) {
    add_triangle(body, {placed[t[0]], placed[t[1]], placed[t[2]]}, columns);
  }
  out.share.assign(static_cast<std::size_t>(out.size[0]) * static_cast<std::size_t>(out.size[1]) *
                       static_cast<std::size_t>(out.size[2]),
                   0.0F);
  for (int j = 0; j < out.size[1]; ++j) {
    for (int i = 0; i < out.size[0]; ++i) {
      auto& z = columns.crossings_m[static_cast<std::size_t>(j * out.size[0] + i)];
      std::sort(z.begin(), z.end());
      for (std::size_t n = 0; n + 1 < z.size() && z.size() % 2 == 0; n += 2) {
        const double from = (z[n] - body.origin_m.z) / body.step_m - out.first[2];
        const double to = (z[n + 1] - body.origin_m.z) / body.step_m - out.first[2];
        for (int k = static_cast<int>(std::floor(from)); k <= std::ceil(to); ++k) {
          const double overlap = std::min(to, k + 0.5) - std::max(from, k - 0.5);
          if (overlap > 0.0) {
            out.share[out.at(i, j, k)] += static_cast<float>(overlap);
          }
        }
      }
    }
  }
  return out;
}

void put_bone(const BodyBone& bone, const BodySettings& settings, FineBody& body) {
  Filled in = filled(body, bone);
  const double cells = settings.cortex_m / body.step_m;
  chamfer(in, 120);
  const Texture texture(settings.seed + 77);
  for (int k = 0; k < in.size[2]; ++k) {
    for (int j = 0; j < in.size[1]; ++j) {
      for (int i = 0; i < in.size[0]; ++i) {
        const std::size_t n = in.at(i, j, k);
        const int x = in.first[0] + i;
        const int y = in.first[1] + j;
        const int z = in.first[2] + k;
        if (in.share[n] <= 0.0F || x < 0 || y < 0 || z < 0 || x >= body.size[0] ||
            y >= body.size[1] || z >= body.size[2]) {
          continue;
        }
        const Vec3 place = body.origin_m + body.step_m * Vec3{double(x), double(y), double(z)};
        const double hu =
            in.depth[n] / 3.0 <= cells ? kCortex_hu : kCancellous_hu + 60.0 * texture.at(place);
        float& here = body.hu[body.at(x, y, z)];
        here += in.share[n] * (static_cast<float>(hu) - here);
      }
    }
  }
}

double outside_m(const MetalPiece& piece, Vec3 p) {
  const Vec3 way = piece.to_m - piece.from_m;
  const double length = way.norm();
  if (length == 0.0) {
    return (p - piece.from_m).norm() - piece.radius_m;
  }
  const double s = (p - piece.from_m).dot(way) / length;
  const double across = ((p - piece.from_m) - (s / length) * way).norm();
  return std::max({across - piece.radius_m, -s, s - length});
}

double share_of(const MetalPiece& piece, Vec3 middle, double step) {
  const double outside = outside_m(piece, middle);
  if (std::abs(outside) > 0.87 * step) {
    return outside < 0.0 ? 1.0 : 0.0;
  }
  constexpr int kParts = 3;
  int inside = 0;
  for (int n = 0; n < kParts * kParts * kParts; ++n) {
    const Vec3 part{n % kParts + 0.5, n / kParts % kParts + 0.5, n / kParts / kParts + 0.5};
    inside += outside_m(piece, middle + step * (part / kParts - Vec3{0.5, 0.5, 0.5})) < 0.0 ? 1 : 0;
  }
  return double(inside) / (kParts * kParts * kParts);
}

void put_metal(const MetalPiece& piece, FineBody& body, std::vector<float>& shares) {
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const double low = std::min(piece.from_m[a], piece.to_m[a]) - piece.radius_m;
    const double high = std::max(piece.from_m[a], piece.to_m[a]) + piece.radius_m;
    first[n] = std::max(0, static_cast<int>((low - body.origin_m[a]) / body.step_m) - 1);
    last[n] =
        std::min(body.size[n] - 1, static_cast<int>((high - body.origin_m[a]) / body.step_m) + 2);
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const Vec3 p = body.origin_m + body.step_m * Vec3{double(i), double(j), double(k)};
        const double share = share_of(piece, p, body.step_m);
        if (share > 0.0) {
          const std::size_t cell = body.at(i, j, k);
          body.hu[cell] +=
              static_cast<float>(share) * (static_cast<float>(piece.hu) - body.hu[cell]);
          shares[cell] = std::max(shares[cell], static_cast<float>(share));
        }
      }
    }
  }
}

}  // namespace

FineBody fine_body(const std::vector<BodyBone>& bones, const std::vector<MetalPiece>& metal,
                   const BodySettings& settings) {
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};
  for (const BodyBone& bone : bones) {
    for (const Vec3& v : bone.mesh.vertices_m) {
      const Vec3 p = bone.scanner_from_model(v);
      for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], p[a] - settings.margin_m);
        high[a] = std::max(high[a], p[a] + settings.margin_m);
      }
    }
  }
  FineBody body;
  body.step_m = settings.step_m;
  body.origin_m = low;
  for (int a = 0; a < 3; ++a) {
    body.size[static_cast<std::size_t>(a)] =
        static_cast<int>((high[a] - low[a]) / settings.step_m) + 1;
  }
  const std::size_t cells = static_cast<std::size_t>(body.size[0]) *
                            static_cast<std::size_t>(body.size[1]) *
                            static_cast<std::size_t>(body.size[2]);
  body.hu.resize(cells);
  const Texture texture(settings.seed);
  std::size_t n = 0;
  for (int k = 0; k < body.size[2]; ++k) {
    for (int j = 0; j < body.size[1]; ++j) {
      for (int i = 0; i < body.size[0]; ++i, ++n) {
        const Vec3 p = body.origin_m + body.step_m * Vec3{double(i), double(j), double(k)};
        body.hu[n] = static_cast<float>(kSoft_hu + 30.0 * texture.at(p));
      }
    }
  }
  for (const BodyBone& bone : bones) {
    put_bone(bone, settings, body);
  }
  std::vector<float> shares(cells, 0.0F);
  for (const MetalPiece& piece : metal) {
    put_metal(piece, body, shares);
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (shares[cell] > 0.0F) {
      body.metal.push_back({cell, shares[cell]});
    }
  }
  return body;
}

}  // namespace orthonav::test

#include "tests/support/voxelised_bone.h"

#include <algorithm>
#include <cmath>

#include "tests/support/tissue_texture.h"

namespace orthonav::test {
namespace {

constexpr double kCortex_hu = 950.0;
constexpr double kCancellous_hu = 230.0;

using Triangle = std::array<Vec3, 3>;

/// The heights at which each column of cells crosses a surface.
struct Columns {
  int first_i = 0, first_j = 0, count_i = 0, count_j = 0;
  std::vector<std::vector<double>> crossings_m;
};

void add_triangle(const FineBody& body, const Triangle& t, Columns& columns) {
  // A column never runs exactly through a vertex: it is offset slightly.
  constexpr double kOffGrid_m = 1.2345e-9;
  const auto low = [&](int a) { return std::min({t[0][a], t[1][a], t[2][a]}); };
  const auto high = [&](int a) { return std::max({t[0][a], t[1][a], t[2][a]}); };
  const auto cell = [&](double v, int a) { return (v - body.origin_m[a]) / body.step_m; };
  const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (area == 0.0) {
    return;
  }
  for (int j = static_cast<int>(std::ceil(cell(low(1), 1))) - 1; j <= cell(high(1), 1) + 1; ++j) {
    for (int i = static_cast<int>(std::ceil(cell(low(0), 0))) - 1; i <= cell(high(0), 0) + 1; ++i) {
      const double x = body.origin_m.x + i * body.step_m + kOffGrid_m;
      const double y = body.origin_m.y + j * body.step_m + 2.7 * kOffGrid_m;
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
struct Filled : Cells {
  std::array<int, 3> first{};  ///< cell of the grid
  std::vector<float> fraction;
  std::vector<std::uint8_t> depth;  ///< chamfer distance in thirds of a step, capped
};

/// Lowers a depth to what the 13 neighbours before it (or, with `sign` -1, after it) allow.
void lower(Filled& bone, int i, int j, int k, int sign) {
  std::uint8_t& here = bone.depth[bone.at(i, j, k)];
  for (int n = 0; n < 13 && here > 0; ++n) {
    const int di = n % 3 - 1;
    const int dj = n / 3 % 3 - 1;
    const int dk = n / 9 - 1;
    const int x = i + sign * di;
    const int y = j + sign * dj;
    const int z = k + sign * dk;
    if (bone.holds(x, y, z)) {
      const int cost = 2 + std::abs(di) + std::abs(dj) + std::abs(dk);
      here = static_cast<std::uint8_t>(std::min<int>(here, bone.depth[bone.at(x, y, z)] + cost));
    }
  }
}

void chamfer(Filled& bone) {
  constexpr std::uint8_t kCap = 120;
  bone.depth.resize(bone.fraction.size());
  std::transform(bone.fraction.begin(), bone.fraction.end(), bone.depth.begin(),
                 [](float fraction) { return fraction > 0.5F ? kCap : std::uint8_t{0}; });
  for (const int sign : {1, -1}) {
    const auto ordered = [&](int n, std::size_t a) { return sign > 0 ? n : bone.size[a] - 1 - n; };
    for (int k = 0; k < bone.size[2]; ++k) {
      for (int j = 0; j < bone.size[1]; ++j) {
        for (int i = 0; i < bone.size[0]; ++i) {
          lower(bone, ordered(i, 0), ordered(j, 1), ordered(k, 2), sign);
        }
      }
    }
  }
}

/// The box about a bone, with two free cells all around.
Filled box_about(const FineBody& body, const std::vector<Vec3>& vertices_m) {
  Filled out;
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] =
        std::minmax_element(vertices_m.begin(), vertices_m.end(),
                            [a](const Vec3& p, const Vec3& q) { return p[a] < q[a]; });
    const auto n = static_cast<std::size_t>(a);
    const auto cell = [&](Vec3 v) { return (v[a] - body.origin_m[a]) / body.step_m; };
    out.first[n] = static_cast<int>(std::floor(cell(*low))) - 2;
    out.size[n] = static_cast<int>(std::ceil(cell(*high))) + 3 - out.first[n];
  }
  out.fraction.assign(out.count(), 0.0F);
  return out;
}

/// Fills a column between each crossing into the bone and the next one out of it. `crossings` are
/// ascending, in cells of the box.
void fill_column(const std::vector<double>& crossings, int i, int j, Filled& out) {
  for (std::size_t n = 0; n + 1 < crossings.size() && crossings.size() % 2 == 0; n += 2) {
    const double from = crossings[n];
    const double to = crossings[n + 1];
    for (int k = static_cast<int>(std::floor(from)); k <= std::ceil(to); ++k) {
      const double overlap = std::min(to, k + 0.5) - std::max(from, k - 0.5);
      if (overlap > 0.0) {
        out.fraction[out.at(i, j, k)] += static_cast<float>(overlap);
      }
    }
  }
}

Filled filled(const FineBody& body, const BodyBone& bone) {
  std::vector<Vec3> placed;
  for (const Vec3& v : bone.mesh.vertices_m) {
    placed.push_back(bone.scanner_from_model(v));
  }
  Filled out = box_about(body, placed);
  Columns columns{out.first[0], out.first[1], out.size[0], out.size[1], {}};
  columns.crossings_m.resize(static_cast<std::size_t>(out.size[0] * out.size[1]));
  for (const auto& t : bone.mesh.triangles) {
    add_triangle(body, {placed[t[0]], placed[t[1]], placed[t[2]]}, columns);
  }
  for (int j = 0; j < out.size[1]; ++j) {
    for (int i = 0; i < out.size[0]; ++i) {
      auto& crossings = columns.crossings_m[static_cast<std::size_t>(j * out.size[0] + i)];
      for (double& z : crossings) {
        z = (z - body.origin_m.z) / body.step_m - out.first[2];
      }
      std::sort(crossings.begin(), crossings.end());
      fill_column(crossings, i, j, out);
    }
  }
  return out;
}

}  // namespace

void put_bone(const BodyBone& bone, const BodySettings& settings, FineBody& body) {
  Filled in = filled(body, bone);
  chamfer(in);
  const double cells = settings.cortex_m / body.step_m;
  const TissueTexture texture(settings.seed + 77);
  for (int k = 0; k < in.size[2]; ++k) {
    for (int j = 0; j < in.size[1]; ++j) {
      for (int i = 0; i < in.size[0]; ++i) {
        const std::size_t n = in.at(i, j, k);
        const int x = in.first[0] + i;
        const int y = in.first[1] + j;
        const int z = in.first[2] + k;
        if (in.fraction[n] <= 0.0F || !body.holds(x, y, z)) {
          continue;
        }
        const bool cortex = in.depth[n] / 3.0 <= cells;
        const double hu =
            cortex ? kCortex_hu : kCancellous_hu + 60.0 * texture.at(body.place_m(x, y, z));
        float& here = body.hu[body.at(x, y, z)];
        here += in.fraction[n] * (static_cast<float>(hu) - here);
      }
    }
  }
}

}  // namespace orthonav::test

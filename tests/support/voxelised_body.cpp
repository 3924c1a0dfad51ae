#include "tests/support/voxelised_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/tissue_texture.h"
#include "tests/support/voxelised_bone.h"

namespace orthonav::test {
namespace {

constexpr double kSoft_hu = 30.0;

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

double fraction_of(const MetalPiece& piece, Vec3 middle, double step) {
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

void put_metal(const MetalPiece& piece, FineBody& body, std::vector<float>& fractions) {
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
        const double fraction = fraction_of(piece, body.place_m(i, j, k), body.step_m);
        if (fraction > 0.0) {
          const std::size_t cell = body.at(i, j, k);
          body.hu[cell] +=
              static_cast<float>(fraction) * (static_cast<float>(piece.hu) - body.hu[cell]);
          fractions[cell] = std::max(fractions[cell], static_cast<float>(fraction));
        }
      }
    }
  }
}

/// A body of soft tissue about the bones.
FineBody soft_body(const std::vector<BodyBone>& bones, const BodySettings& settings) {
  constexpr double kFar_m = std::numeric_limits<double>::max();
  Vec3 low{kFar_m, kFar_m, kFar_m};
  Vec3 high = -low;
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
  const TissueTexture texture(settings.seed);
  body.hu.reserve(body.count());
  for (int k = 0; k < body.size[2]; ++k) {
    for (int j = 0; j < body.size[1]; ++j) {
      for (int i = 0; i < body.size[0]; ++i) {
        body.hu.push_back(static_cast<float>(kSoft_hu + 30.0 * texture.at(body.place_m(i, j, k))));
      }
    }
  }
  return body;
}

}  // namespace

FineBody fine_body(const std::vector<BodyBone>& bones, const std::vector<MetalPiece>& metal,
                   const BodySettings& settings) {
  FineBody body = soft_body(bones, settings);
  for (const BodyBone& bone : bones) {
    put_bone(bone, settings, body);
  }
  std::vector<float> fractions(body.count(), 0.0F);
  for (const MetalPiece& piece : metal) {
    put_metal(piece, body, fractions);
  }
  for (std::size_t cell = 0; cell < fractions.size(); ++cell) {
    if (fractions[cell] > 0.0F) {
      body.metal.push_back({cell, fractions[cell]});
    }
  }
  return body;
}

}  // namespace orthonav::test

#include "tests/support/stroke_truths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "base/vertex_normals.h"

namespace orthonav::test {
namespace {

constexpr double kTissueNode_m = 0.014;
constexpr double kSegmentationNode_m = 0.007;
constexpr double kUneven = 0.5;  // SD of a thickness, of its mean

/// Values at the nodes of a grid, blended in between.
class LatticeNoise {
 public:
  LatticeNoise(double node_m, Random random) : node_m_(node_m), random_(random) {}

  [[nodiscard]] double at(Vec3 p) const {
    const std::array<double, 3> x = {p.x / node_m_, p.y / node_m_, p.z / node_m_};
    std::array<double, 3> low{};
    std::array<double, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::floor(x[k]);
      const double f = x[k] - low[k];
      t[k] = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      std::uint64_t key = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const int up = (corner >> k) & 1;
        weight *= up != 0 ? t[k] : 1.0 - t[k];
        key = key * 4096 + static_cast<std::uint64_t>(static_cast<int>(low[k]) + up + 2048);
      }
      sum += weight * random_.fork(key).normal();
    }
    return sum;
  }

 private:
  double node_m_;
  Random random_;
};

/// Scales the values to mean 0 and SD 1.
void standardize(std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    mean += v / n;
  }
  for (double& v : values) {
    v -= mean;
    squares += v * v / n;
  }
  const double sd = std::sqrt(std::max(squares, 1e-30));
  for (double& v : values) {
    v /= sd;
  }
}

/// How far a ball of 8 mm about a place lies in the bone, from -1 (a ridge) to 1 (a valley).
double valley(const nav::SurfaceIndex& surface, Vec3 p) {
  constexpr double kBall_m = 0.008;
  int inside = 0;
  int all = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 off{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (off.norm() > 0.0) {
          inside += surface.contains(p + kBall_m * off.normalized()) ? 1 : 0;
          ++all;
        }
      }
    }
  }
  return 2.0 * inside / all - 1.0;
}

/// Standardized deviations of each sample's thickness.
std::vector<double> unevenness(Tissue tissue, const nav::TriangleMesh& mesh, const Random& random,
                               const DigitizedStrokes& strokes) {
  std::vector<double> out;
  if (tissue == Tissue::kUniform) {
    out.assign(strokes.samples.size(), 0.0);
    return out;
  }
  const LatticeNoise noise(kTissueNode_m, random.fork("field"));
  const nav::SurfaceIndex surface(mesh);
  for (const DigitizedSample& s : strokes.samples) {
    switch (tissue) {
      case Tissue::kUniform:
        break;
      case Tissue::kSmooth:
        out.push_back(noise.at(s.true_tip.v));
        break;
      case Tissue::kAreas:
        out.push_back(random.fork(static_cast<std::uint64_t>(s.region)).normal());
        break;
      case Tissue::kStrokes:
        out.push_back(random.fork(1000 + static_cast<std::uint64_t>(s.stroke)).normal());
        break;
      case Tissue::kValleys:
        out.push_back(valley(surface, s.true_tip.v) + 0.15 * noise.at(s.true_tip.v));
        break;
    }
  }
  standardize(out);
  return out;
}

/// Repeats each sample, and shuffles all of them.
void repeat(const StrokeTruths& truths, const Random& random,
            std::vector<DigitizedSample>& samples) {
  if (truths.copies > 1) {
    Random jitter = random.fork("copies");
    std::vector<DigitizedSample> all;
    for (const DigitizedSample& s : samples) {
      all.push_back(s);
      for (int copy = 1; copy < truths.copies; ++copy) {
        all.push_back(s);
        const double x = jitter.normal(0.0, truths.copy_jitter_m);
        const double y = jitter.normal(0.0, truths.copy_jitter_m);
        all.back().tip.v += {x, y, jitter.normal(0.0, truths.copy_jitter_m)};
      }
    }
    samples = std::move(all);
  }
  if (truths.shuffled) {
    Random order = random.fork("order");
    for (std::size_t i = samples.size(); i > 1; --i) {
      std::swap(samples[i - 1], samples[order.next() % i]);
    }
  }
}

}  // namespace

const char* name_of(Tissue tissue) {
  switch (tissue) {
    case Tissue::kUniform:
      return "uniform";
    case Tissue::kSmooth:
      return "smooth";
    case Tissue::kAreas:
      return "areas";
    case Tissue::kStrokes:
      return "strokes";
    case Tissue::kValleys:
      return "valleys";
  }
  return "";
}

void apply_truths(const StrokeTruths& truths, const nav::TriangleMesh& mesh, std::uint64_t seed,
                  DigitizedStrokes& strokes) {
  const Random random = Random(seed).fork("truths");
  Random common = random.fork("common");
  const Vec3 common_m{common.normal(0.0, truths.common_sd_m),
                      common.normal(0.0, truths.common_sd_m),
                      common.normal(0.0, truths.common_sd_m)};
  std::vector<double> uneven(strokes.samples.size(), 0.0);
  if (truths.mean_tissue_m > 0.0) {
    uneven = unevenness(truths.tissue, mesh, random.fork(name_of(truths.tissue)), strokes);
  }
  for (std::size_t i = 0; i < strokes.samples.size(); ++i) {
    DigitizedSample& s = strokes.samples[i];
    if (!s.off_bone) {
      const double lift_m = std::max(0.0, truths.mean_tissue_m * (1.0 + kUneven * uneven[i]));
      s.tip = s.tip + strokes.world_from_vertebra.rotation() * (lift_m * s.normal);
      s.true_tip = s.true_tip + lift_m * s.normal;
    }
    s.tip = s.tip + common_m;
  }
  repeat(truths, random, strokes.samples);
  for (DigitizedSample& s : strokes.samples) {
    s.tip.v.x *= truths.left_handed ? -1.0 : 1.0;
  }
}

nav::TriangleMesh segmented(const nav::TriangleMesh& mesh, double sd_m, std::uint64_t seed) {
  const LatticeNoise noise(kSegmentationNode_m, Random(seed).fork("segmentation"));
  std::vector<double> off;
  for (const Vec3& v : mesh.vertices_m) {
    off.push_back(noise.at(v));
  }
  standardize(off);
  const std::vector<Vec3> normals = vertex_normals(mesh.vertices_m, mesh.triangles);
  nav::TriangleMesh out = mesh;
  for (std::size_t i = 0; i < off.size(); ++i) {
    out.vertices_m[i] += sd_m * off[i] * normals[i];
  }
  return out;
}

nav::TriangleMesh scaled(const nav::TriangleMesh& mesh, double factor) {
  nav::TriangleMesh out = mesh;
  for (Vec3& v : out.vertices_m) {
    v = factor * v;
  }
  return out;
}

nav::TriangleMesh mirrored(const nav::TriangleMesh& mesh) {
  nav::TriangleMesh out = mesh;
  for (Vec3& v : out.vertices_m) {
    v.x = -v.x;
  }
  for (auto& t : out.triangles) {
    std::swap(t[1], t[2]);
  }
  return out;
}

}  // namespace orthonav::test

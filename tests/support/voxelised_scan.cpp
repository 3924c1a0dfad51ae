#include "tests/support/voxelised_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace orthonav::test {
namespace {

/// To 3 SDs on either side; its sum is 1.
std::vector<float> gaussian(double sigma_steps) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma_steps));
  std::vector<float> kernel;
  float sum = 0.0F;
  for (int n = -reach; n <= reach; ++n) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * n * n / (sigma_steps * sigma_steps))));
    sum += kernel.back();
  }
  for (float& k : kernel) {
    k /= sum;
  }
  return kernel;
}

/// Blurs along one axis; values beyond the ends equal those at the ends.
void blur_along(int axis, const std::vector<float>& kernel, FineBody& body) {
  const int reach = static_cast<int>(kernel.size() / 2);
  const auto a = static_cast<std::size_t>(axis);
  const int length = body.size[a];
  const std::size_t stride =
      axis == 0   ? 1
      : axis == 1 ? static_cast<std::size_t>(body.size[0])
                  : static_cast<std::size_t>(body.size[0]) * static_cast<std::size_t>(body.size[1]);
  // Whole rows of x at a time, so that memory is read in order.
  const int width = axis == 0 ? 1 : body.size[0];
  const int outer_j = axis == 1 ? 1 : body.size[1];
  const int outer_k = axis == 2 ? 1 : body.size[2];
  std::vector<float> line(static_cast<std::size_t>(length * width));
  for (int k = 0; k < outer_k; ++k) {
    for (int j = 0; j < outer_j; ++j) {
      float* start = body.hu.data() + body.at(0, j, k);
      for (int n = 0; n < length; ++n) {
        const float* from = start + static_cast<std::size_t>(n) * stride;
        std::copy(from, from + width, line.begin() + n * width);
      }
      for (int n = 0; n < length; ++n) {
        float* to = start + static_cast<std::size_t>(n) * stride;
        std::fill(to, to + width, 0.0F);
        for (int m = -reach; m <= reach; ++m) {
          const float weight = kernel[static_cast<std::size_t>(m + reach)];
          const float* from = line.data() + std::clamp(n + m, 0, length - 1) * width;
          for (int i = 0; i < width; ++i) {
            to[i] += weight * from[i];
          }
        }
      }
    }
  }
}

/// Streaks of one slice, on a grid of 1 mm over the body.
class Streaks {
 public:
  Streaks(const FineBody& body, double strength, std::uint64_t seed)
      : body_(body), strength_(strength), random_(seed) {
    for (int a = 0; a < 2; ++a) {
      size_[a] = static_cast<int>(body.size[static_cast<std::size_t>(a)] * body.step_m * 1e3) + 2;
    }
    bins_ = static_cast<int>(std::hypot(size_[0], size_[1])) + 3;
  }

  /// The streaks of the metal between two heights of the grid.
  [[nodiscard]] std::vector<double> of_slice(double low_step, double high_step) {
    std::vector<double> metal(static_cast<std::size_t>(size_[0] * size_[1]), 0.0);
    bool any = false;
    const std::size_t plane =
        static_cast<std::size_t>(body_.size[0]) * static_cast<std::size_t>(body_.size[1]);
    const double cell_mm = body_.step_m * 1e3;
    const double weight = cell_mm * cell_mm / (high_step - low_step);
    const auto first = std::lower_bound(
        body_.metal.begin(), body_.metal.end(),
        static_cast<std::size_t>(std::max(0.0, std::floor(low_step + 0.5))) * plane,
        [](const FineBody::MetalCell& m, std::size_t cell) { return m.cell < cell; });
    for (auto m = first; m != body_.metal.end(); ++m) {
      const auto k = static_cast<double>(m->cell / plane);
      const double share = std::min(high_step, k + 0.5) - std::max(low_step, k - 0.5);
      if (share <= 0.0) {
        break;
      }
      const std::size_t in_plane = m->cell % plane;
      add(static_cast<double>(in_plane % static_cast<std::size_t>(body_.size[0])) * cell_mm,
          static_cast<double>(in_plane / static_cast<std::size_t>(body_.size[0])) * cell_mm,
          share * weight * static_cast<double>(m->fraction), metal);
      any = true;
    }
    return any ? projected_back(metal) : std::vector<double>{};
  }

  /// Shared by the four places around, so that streaks lie about the metal that makes them.
  void add(double x_mm, double y_mm, double mm2, std::vector<double>& metal) const {
    const int i = static_cast<int>(x_mm);
    const int j = static_cast<int>(y_mm);
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        metal[static_cast<std::size_t>((j + b) * size_[0] + i + a)] +=
            mm2 * (1.0 - std::abs(x_mm - i - a)) * (1.0 - std::abs(y_mm - j - b));
      }
    }
  }

  [[nodiscard]] double at(const std::vector<double>& slice, double x_mm, double y_mm) const {
    const int i = std::clamp(static_cast<int>(x_mm), 0, size_[0] - 2);
    const int j = std::clamp(static_cast<int>(y_mm), 0, size_[1] - 2);
    const double u = std::clamp(x_mm - i, 0.0, 1.0);
    const double v = std::clamp(y_mm - j, 0.0, 1.0);
    const auto value = [&](int a, int b) {
      return slice[static_cast<std::size_t>((j + b) * size_[0] + i + a)];
    };
    return (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) +
           v * ((1 - u) * value(0, 1) + u * value(1, 1));
  }

 private:
  /// Parallel rays at an angle, by its cosine and sine.
  struct Rays {
    double c;
    double s;
  };

  [[nodiscard]] double bin(const Rays& rays, int i, int j) const {
    return (i - 0.5 * size_[0]) * rays.c + (j - 0.5 * size_[1]) * rays.s + 0.5 * bins_;
  }

  std::vector<double> projected_back(const std::vector<double>& metal) {
    constexpr int kAngles = 120;
    std::vector<double> out(metal.size(), 0.0);
    for (int angle = 0; angle < kAngles; ++angle) {
      const Rays rays{std::cos(angle * std::numbers::pi / kAngles),
                      std::sin(angle * std::numbers::pi / kAngles)};
      std::vector<double> error = projected(metal, rays);
      for (double& mm : error) {
        mm = mm > 0.0 ? error_of(mm) : 0.0;
      }
      add_back(filtered(error), rays, std::numbers::pi / kAngles, out);
    }
    return out;
  }

  /// How much metal each ray meets, mm.
  [[nodiscard]] std::vector<double> projected(const std::vector<double>& metal,
                                              const Rays& rays) const {
    std::vector<double> out(static_cast<std::size_t>(bins_), 0.0);
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        const double mm2 = metal[static_cast<std::size_t>(j * size_[0] + i)];
        if (mm2 > 0.0) {
          const double b = bin(rays, i, j);
          const auto whole = static_cast<std::size_t>(b);
          out[whole] += mm2 * (1.0 - (b - static_cast<double>(whole)));
          out[whole + 1] += mm2 * (b - static_cast<double>(whole));
        }
      }
    }
    return out;
  }

  /// By Ramachandran and Lakshminarayanan's filter.
  [[nodiscard]] std::vector<double> filtered(const std::vector<double>& ray) const {
    std::vector<double> out;
    for (int n = 0; n < bins_; ++n) {
      double sum = 0.25 * ray[static_cast<std::size_t>(n)];
      for (int m = (n + 1) % 2; m < bins_; m += 2) {
        const double d = n - m;
        sum -= ray[static_cast<std::size_t>(m)] / (std::numbers::pi * std::numbers::pi * d * d);
      }
      out.push_back(sum);
    }
    return out;
  }

  void add_back(const std::vector<double>& ray, const Rays& rays, double weight,
                std::vector<double>& out) const {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        const double b = bin(rays, i, j);
        const auto whole = static_cast<std::size_t>(b);
        const double u = b - static_cast<double>(whole);
        out[static_cast<std::size_t>(j * size_[0] + i)] +=
            weight * ((1.0 - u) * ray[whole] + u * ray[whole + 1]);
      }
    }
  }

  /// How much a ray through this much metal is underestimated, HU mm, with noise.
  double error_of(double metal_mm) {
    const double hardened = -8000.0 * metal_mm * 0.25 * metal_mm / (metal_mm + 20.0);
    const double starved = 60.0 * (std::exp(std::min(metal_mm, 40.0) / 12.0) - 1.0);
    return strength_ * (hardened + starved * random_.normal());
  }

  const FineBody& body_;
  double strength_;
  Random random_;
  std::array<int, 2> size_{};
  int bins_ = 0;
};

/// The mean of a column of cells between two heights, between columns linearly.
double mean_at(const FineBody& body, double x, double y, double low, double high) {
  const int i = std::clamp(static_cast<int>(x), 0, body.size[0] - 2);
  const int j = std::clamp(static_cast<int>(y), 0, body.size[1] - 2);
  const double u = x - i;
  const double v = y - j;
  double sum = 0.0;
  double weights = 0.0;
  for (int k = static_cast<int>(std::floor(low + 0.5)); k <= std::floor(high + 0.5); ++k) {
    const double weight = std::min(high, k + 0.5) - std::max(low, k - 0.5);
    if (weight <= 0.0) {
      continue;
    }
    const int kk = std::clamp(k, 0, body.size[2] - 1);
    const float* row = body.hu.data() + body.at(i, j, kk);
    const float* next = row + body.size[0];
    sum += weight * ((1 - v) * ((1 - u) * double(row[0]) + u * double(row[1])) +
                     v * ((1 - u) * double(next[0]) + u * double(next[1])));
    weights += weight;
  }
  return sum / weights;
}

/// A voxel grid that starts a random fraction of a voxel inside the body.
engine::VolumeGrid grid_in(const FineBody& body, Vec3 spacing_m, Random& random) {
  engine::VolumeGrid grid;
  grid.spacing_m = spacing_m;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const double start_m = spacing_m[a] * (0.5 + random.uniform());
    grid.origin_m[a] = body.origin_m[a] + start_m;
    grid.size[n] = static_cast<int>((body.size[n] * body.step_m - 2.0 * start_m) / spacing_m[a]);
  }
  return grid;
}

}  // namespace

engine::Volume scanned(const FineBody& body, const ScannerSettings& settings) {
  FineBody blurred = body;
  const std::vector<float> kernel = gaussian(settings.blur_m / body.step_m);
  for (int axis = 0; axis < 3; ++axis) {
    blur_along(axis, kernel, blurred);
  }
  Random random(settings.seed);
  engine::Volume out;
  out.grid = grid_in(body, settings.spacing_m, random);
  const double slice_m = settings.slice_m > 0.0 ? settings.slice_m : settings.spacing_m.z;
  Streaks streaks(body, settings.streaks, random.next());
  out.values.reserve(out.grid.voxels());
  for (int k = 0; k < out.grid.size[2]; ++k) {
    const double z = (out.grid.place_m({0, 0, double(k)}).z - body.origin_m.z) / body.step_m;
    const double low = z - 0.5 * slice_m / body.step_m;
    const double high = z + 0.5 * slice_m / body.step_m;
    const std::vector<double> streak =
        settings.streaks > 0.0 ? streaks.of_slice(low, high) : std::vector<double>{};
    for (int j = 0; j < out.grid.size[1]; ++j) {
      for (int i = 0; i < out.grid.size[0]; ++i) {
        const Vec3 p = out.grid.place_m({double(i), double(j), double(k)}) - body.origin_m;
        double hu = mean_at(blurred, p.x / body.step_m, p.y / body.step_m, low, high) +
                    settings.noise_hu * random.normal();
        if (!streak.empty()) {
          hu += streaks.at(streak, p.x * 1e3, p.y * 1e3);
        }
        hu = std::round(std::max(hu, -1024.0));
        out.values.push_back(
            static_cast<float>(settings.highest_hu > 0.0 ? std::min(hu, settings.highest_hu) : hu));
      }
    }
  }
  return out;
}

}  // namespace orthonav::test

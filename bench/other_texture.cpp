#include "bench/other_texture.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace orthonav::bench {
namespace {

constexpr int kSide = 1024;

std::size_t at(int x, int y) {
  return static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)));
}

void add_cloth(Random& random, std::vector<float>& texels) {
  for (const int cell : {128, 32, 8, 4}) {
    const int lattice = kSide / cell;
    std::vector<double> grey(static_cast<std::size_t>(lattice * lattice));
    for (double& g : grey) {
      g = random.uniform(-0.09, 0.09);
    }
    const auto node = [&](int x, int y) {
      return grey[static_cast<std::size_t>((y % lattice) * lattice + x % lattice)];
    };
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double s = static_cast<double>(x % cell) / cell;
        const double t = static_cast<double>(y % cell) / cell;
        const int i = x / cell;
        const int j = y / cell;
        texels[at(x, y)] +=
            static_cast<float>((1 - t) * ((1 - s) * node(i, j) + s * node(i + 1, j)) +
                               t * ((1 - s) * node(i, j + 1) + s * node(i + 1, j + 1)));
      }
    }
  }
}

void add_sheets(Random& random, std::vector<float>& texels, int count, double low, double high) {
  for (int k = 0; k < count; ++k) {
    const double cx = random.uniform(0.0, kSide);
    const double cy = random.uniform(0.0, kSide);
    const double half_x = random.uniform(low, high);
    const double half_y = half_x * random.uniform(0.1, 1.0);
    const double angle_rad = random.uniform(0.0, 3.2);
    const auto grey = static_cast<float>(random.uniform(0.03, 0.9));
    const int reach = static_cast<int>(half_x + half_y) + 1;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (std::abs(std::cos(angle_rad) * dx + std::sin(angle_rad) * dy) < half_x &&
            std::abs(-std::sin(angle_rad) * dx + std::cos(angle_rad) * dy) < half_y) {
          texels[at(static_cast<int>(cx) + dx, static_cast<int>(cy) + dy)] = grey;
        }
      }
    }
  }
}

/// Smooths out steps, so that a pixel need not gather more than one point.
std::vector<float> smoothed(const std::vector<float>& texels) {
  std::vector<float> out(texels.size());
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      float sum = 0.0F;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          sum += texels[at(x + dx, y + dy)] * static_cast<float>((2 - dx * dx) * (2 - dy * dy));
        }
      }
      out[at(x, y)] = std::clamp(sum / 16.0F, 0.03F, 0.9F);
    }
  }
  return out;
}

double mirrored(double u) {
  const double folded = std::abs(u - 2.0 * std::floor(0.5 * u + 0.5));
  return folded * (kSide - 2);
}

}  // namespace

Clutter::Clutter(std::uint64_t seed) {
  Random random(seed);
  texels_.assign(static_cast<std::size_t>(kSide) * kSide, 0.35F);
  add_cloth(random, texels_);
  add_sheets(random, texels_, 60, 20.0, 90.0);
  add_sheets(random, texels_, 500, 4.0, 16.0);
  texels_ = smoothed(texels_);
}

float Clutter::at(double u, double v) const {
  const double x = mirrored(u);
  const double y = mirrored(v);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const auto s = static_cast<float>(x - i);
  const auto t = static_cast<float>(y - j);
  const float* top = texels_.data() + static_cast<std::ptrdiff_t>(j) * kSide + i;
  const float* low = top + kSide;
  return (1 - t) * ((1 - s) * top[0] + s * top[1]) + t * ((1 - s) * low[0] + s * low[1]);
}

}  // namespace orthonav::bench

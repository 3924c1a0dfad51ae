#include "engine/scan/label_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scan/grid_lines.h"

namespace orthonav::engine {
namespace {

constexpr float kFar_m2 = 1.0F;  // (1 m)^2
constexpr int kSmoothings = 4;
/// Least value at a voxel's middle, as a share of the spacing, so that the voxel stays on its side
/// of the surface.
constexpr float kKept = 0.02F;

/// The lower envelope of parabolas along one line: squared distances become those with one more
/// dimension.
class Envelope {
 public:
  explicit Envelope(double spacing_m) : h2_(spacing_m * spacing_m) {}

  void transform(std::vector<float>& f, std::size_t first, std::size_t stride, std::size_t count) {
    apexes_.clear();
    starts_.clear();
    line_.resize(count);
    for (std::size_t q = 0; q < count; ++q) {
      line_[q] = static_cast<double>(f[first + q * stride]);
      add(q);
    }
    std::size_t k = 0;
    for (std::size_t q = 0; q < count; ++q) {
      const auto at = static_cast<double>(q);
      while (k + 1 < apexes_.size() && starts_[k + 1] < at) {
        ++k;
      }
      const double off = at - static_cast<double>(apexes_[k]);
      f[first + q * stride] = static_cast<float>(h2_ * off * off + line_[apexes_[k]]);
    }
  }

 private:
  void add(std::size_t q) {
    const auto square = [](std::size_t i) {
      return static_cast<double>(i) * static_cast<double>(i);
    };
    double start = -1e30;
    while (!apexes_.empty()) {
      const std::size_t p = apexes_.back();
      start = ((line_[q] / h2_ + square(q)) - (line_[p] / h2_ + square(p))) /
              (2.0 * static_cast<double>(q) - 2.0 * static_cast<double>(p));
      if (start > starts_.back()) {
        break;
      }
      apexes_.pop_back();
      starts_.pop_back();
      start = -1e30;
    }
    apexes_.push_back(q);
    starts_.push_back(start);
  }

  double h2_;
  std::vector<double> line_;
  std::vector<std::size_t> apexes_;
  std::vector<double> starts_;
};

/// Squared distances from each voxel's middle to the middle of the nearest voxel with this value.
std::vector<float> squared_distances_m2(const LabelPart& part, std::uint8_t to) {
  std::vector<float> f(part.inside.size());
  std::transform(part.inside.begin(), part.inside.end(), f.begin(),
                 [to](std::uint8_t bone) { return bone == to ? 0.0F : kFar_m2; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Envelope envelope(part.grid.spacing_m[static_cast<int>(axis)]);
    for_each_line(part.grid, axis, [&](std::size_t first, std::size_t stride, std::size_t count) {
      envelope.transform(f, first, stride, count);
    });
  }
  return f;
}

/// Each value becomes the weighted mean of itself (1/2) and its neighbours along a line (1/4 each).
void smooth_lines(const VolumeGrid& grid, std::size_t axis, std::vector<float>& f) {
  for_each_line(grid, axis, [&](std::size_t first, std::size_t stride, std::size_t count) {
    float before = f[first];
    for (std::size_t q = 0; q < count; ++q) {
      float& here = f[first + q * stride];
      const float after = q + 1 < count ? f[first + (q + 1) * stride] : here;
      const float mean = 0.5F * here + 0.25F * (before + after);
      before = here;
      here = mean;
    }
  });
}

void smooth(const VolumeGrid& grid, std::vector<float>& f) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    smooth_lines(grid, axis, f);
  }
}

/// The polynomial of Catmull and Rom through four neighbours, between the middle two.
double cubic(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

}  // namespace

LabelField::LabelField(const LabelPart& part) : grid_(part.grid) {
  const std::vector<float> to_bone_m2 = squared_distances_m2(part, 1);
  const std::vector<float> to_free_m2 = squared_distances_m2(part, 0);
  values_m_.resize(part.inside.size());
  // The surface lies midway between the middles of two voxels.
  for (std::size_t i = 0; i < values_m_.size(); ++i) {
    values_m_[i] = std::sqrt(to_bone_m2[i]) - std::sqrt(to_free_m2[i]);
  }
  const float kept_m = kKept * static_cast<float>(grid_.least_spacing_m());
  for (int round = 0; round < kSmoothings; ++round) {
    smooth(grid_, values_m_);
    std::vector<float> twice = values_m_;
    smooth(grid_, twice);
    for (std::size_t i = 0; i < twice.size(); ++i) {
      const float value_m = 2.0F * values_m_[i] - twice[i];
      values_m_[i] = part.inside[i] != 0 ? std::min(value_m, -kept_m) : std::max(value_m, kept_m);
    }
  }
}

double LabelField::value_m(Vec3 place_m) const {
  const Vec3 index = grid_.index_of(place_m);
  std::array<std::array<int, 4>, 3> at{};
  std::array<double, 3> t{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = std::clamp(index[static_cast<int>(axis)], 0.0, grid_.size[axis] - 1.0);
    const int low = static_cast<int>(x);
    t[axis] = x - low;
    for (int n = 0; n < 4; ++n) {
      at[axis][static_cast<std::size_t>(n)] = std::clamp(low + n - 1, 0, grid_.size[axis] - 1);
    }
  }
  std::array<double, 4> planes{};
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<double, 4> rows{};
    for (std::size_t b = 0; b < 4; ++b) {
      const auto v = [&](std::size_t a) {
        return static_cast<double>(values_m_[grid_.at(at[0][a], at[1][b], at[2][c])]);
      };
      rows[b] = cubic(v(0), v(1), v(2), v(3), t[0]);
    }
    planes[c] = cubic(rows[0], rows[1], rows[2], rows[3], t[1]);
  }
  return cubic(planes[0], planes[1], planes[2], planes[3], t[2]);
}

}  // namespace orthonav::engine

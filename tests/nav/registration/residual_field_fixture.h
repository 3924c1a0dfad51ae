#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "nav/registration/residual_field.h"
#include "nav/registration/tre.h"
#include "tests/support/slab_bone.h"

namespace orthonav::nav::residual_field_test {

using test::CentredPoints;

/// The screws' targets, where the error matters.
inline const Point<Vertebra> kTargets[] = {
    {{0.012, -0.030, 0.004}}, {{-0.012, -0.030, 0.004}}, {{0.020, 0.000, 0.000}}};
inline constexpr int kTrials = 60;

struct Noise {
  double white_m = 0.0003;
  double wandering_m = 0.0004;  ///< along each axis
  double correlation_s = 0.3;
  bool shuffled = false;
  double tissue_m = 0.0;   ///< mean height of waves over the bone
  double pressed_m = 0.0;  ///< SD of each stroke's own height
};

/// Root mean square errors at the targets: true and predicted.
struct Compared {
  double empirical_m = 0.0;
  double predicted_m = 0.0;
  double effective_points = 0.0;
  double field_m = 0.0;
  [[nodiscard]] double ratio() const { return predicted_m / empirical_m; }
};

inline std::optional<ResidualField> field_of(const SurfaceFit& fit) {
  return residual_field(fit, residual_units(fit, kMaxUnits));
}

inline CentredPose after(CentredPose pose, const std::array<double, 6>& step) {
  pose.rotation =
      orthonormalized(rotation_from_vector({step[3], step[4], step[5]}) * pose.rotation);
  pose.centre_m += {step[0], step[1], step[2]};
  return pose;
}

class ResidualFieldTest : public ::testing::Test {
 protected:
  /// Repeats the same strokes many times with new noise.
  Compared compare(const Noise& noise, std::size_t lanes) const {
    const std::vector<Vec3> places = test::strokes_over(surface_, lanes);
    const std::size_t a_stroke = places.size() / lanes;
    Compared out;
    double sum2 = 0.0;
    double predicted2 = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      Random random(static_cast<std::uint64_t>(trial));
      std::vector<Vec3> noisy = places;
      if (noise.tissue_m > 0.0) {
        lift(noise.tissue_m, random, noisy);
      }
      if (noise.pressed_m > 0.0) {
        press(noise.pressed_m, a_stroke, random, noisy);
      }
      for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t from = 0; from < noisy.size(); from += a_stroke) {
          const auto slow = test::wandering(a_stroke, noise.correlation_s, random);
          for (std::size_t i = 0; i < a_stroke && from + i < noisy.size(); ++i) {
            noisy[from + i][axis] += noise.wandering_m * slow[i] + random.normal(0, noise.white_m);
          }
        }
      }
      if (noise.shuffled) {
        for (std::size_t i = noisy.size(); i > 1; --i) {
          std::swap(noisy[i - 1], noisy[static_cast<std::size_t>(random.next() % i)]);
        }
      }
      const CentredPoints cloud = test::centred_somewhere(noisy, random);
      SurfaceFitOptions options;
      options.with_standoff = noise.tissue_m > 0.0 || noise.pressed_m > 0.0;
      const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, options);
      if (!fit) {
        continue;
      }
      const auto field = field_of(*fit);
      if (!field) {
        continue;
      }
      out.effective_points += field->effective_points / kTrials;
      out.field_m += field->field_sd_m / kTrials;
      const PoseUncertainty uncertainty(fit->pose.centre_m, field->covariance);
      const CentredPose pose = after(fit->pose, field->step);
      for (const Point<Vertebra>& target : kTargets) {
        // Where the fit puts the target.
        const Vec3 local = cloud.truth.rotation.transposed() * (target.v - cloud.truth.centre_m);
        sum2 += (pose.rotation * local + pose.centre_m - target.v).squared_norm();
        predicted2 += std::pow(uncertainty.predicted_tre_m(target), 2);
      }
    }
    out.empirical_m = std::sqrt(sum2 / (kTrials * std::size(kTargets)));
    out.predicted_m = std::sqrt(predicted2 / (kTrials * std::size(kTargets)));
    return out;
  }
  void lift(double mean_m, Random& random, std::vector<Vec3>& places) const {
    constexpr double kWave_m = 0.03;
    std::array<double, 4> phase{};
    for (double& p : phase) {
      p = random.uniform(0.0, 6.283);
    }
    for (Vec3& p : places) {
      const double waves =
          std::sin(6.283 * p.x / kWave_m + phase[0]) * std::cos(6.283 * p.z / kWave_m + phase[1]) +
          std::sin(6.283 * (p.x + p.z) / kWave_m + phase[2]);
      p += mean_m * std::max(0.0, 1.0 + 0.5 * waves) * surface_.nearest(p)->normal;
    }
  }
  void press(double sd_m, std::size_t a_stroke, Random& random, std::vector<Vec3>& places) const {
    for (std::size_t from = 0; from < places.size(); from += a_stroke) {
      const double height_m = std::max(0.0, random.normal(2.0 * sd_m, sd_m));
      for (std::size_t i = from; i < std::min(from + a_stroke, places.size()); ++i) {
        places[i] += height_m * surface_.nearest(places[i])->normal;
      }
    }
  }
  [[nodiscard]] std::vector<Vec3> noisy_strokes(Random& random) const {
    std::vector<Vec3> places = test::strokes_over(surface_, 10);
    for (Vec3& p : places) {
      p += Vec3{random.normal(0, 0.0002), random.normal(0, 0.0002), random.normal(0, 0.0002)};
    }
    return places;
  }
  const TriangleMesh mesh_ = test::slab_bone(test::crooked_back);
  const SurfaceIndex surface_{mesh_};
};

/// 60 trials with three targets determine an RMS to 8 %. The prediction is 7 % larger by design;
/// the rest allows for estimates from a single set of heights.
inline constexpr double kHonest = 0.25;

}  // namespace orthonav::nav::residual_field_test

#include "nav/registration/presses.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <vector>

#include "base/random.h"
#include "tests/nav/registration/stroked_bone.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav::press_fit_test {
namespace {

Vec3 somewhere(Random& random, double scale) {
  return scale * Vec3{random.normal(), random.normal(), random.normal()};
}

double worst_rms_m(const StrokedBone& bone, const PressFit& fit) {
  return worst_tre_m({fit.centre_m, fit.covariance}, bone.options.targets);
}

/// A bone, stroked and pressed, and its model, which a segmentation got wrong.
class SegmentedBone : public StrokedBone {
 public:
  SegmentedBone(std::uint64_t seed, double model_sd_m, double tissue_m)
      : StrokedBone(
            VertebraModel::prepare(orthonav::test::segmented(level().mesh, model_sd_m, seed))
                .value(),
            seed, tissue_m) {}
  /// On the bone itself, all over what was stroked.
  std::vector<PressedPlace> pressed(std::size_t count) {
    const PressModel press;
    const SurfaceIndex bone(level().mesh);
    std::vector<PressedPlace> out;
    const double common_m = random_.normal(press.height_m, press.common_sd_m);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& s = strokes_.samples[(i * strokes_.samples.size() + 7) / count];
      const Vec3 tip = bone.nearest(s.true_tip.v)->point_m +
                       (common_m + random_.normal(0.0, press.sd_m)) * s.normal;
      out.push_back({strokes_.world_from_vertebra * Point<Vertebra>{tip}, 0.0001});
    }
    return out;
  }
  /// As two views of a depth camera see it, each off along its rays.
  std::vector<PressedPlace> seen(double off_m, double noise_m) {
    std::vector<PressedPlace> out;
    const std::vector<Vec3>& vertices_m = model().reachable().vertices_m;
    for (int view = 0; view < 2; ++view) {
      // From behind, and to a side.
      const Vec3 ray = Vec3{view == 0 ? 0.5 : -0.5, 0.8, 0.3}.normalized();
      const double bias_m = random_.normal(0.0, off_m);
      for (std::size_t i = 40 * static_cast<std::size_t>(view); i < vertices_m.size();
           i += vertices_m.size() / 40) {
        const Vec3 at = vertices_m[i] + bias_m * ray + somewhere(random_, noise_m);
        out.push_back({strokes_.world_from_vertebra * Point<Vertebra>{at}, noise_m, 0.0,
                       strokes_.world_from_vertebra.rotation() * ray, view});
      }
    }
    return out;
  }
  [[nodiscard]] double error_m(const PressFit& fit) const {
    Registration r = registration;
    r.world_from_vertebra = fit.moved(registration.world_from_vertebra);
    return StrokedBone::error_m(r);
  }
};

/// Against one large Gaussian of everything: the pose of the strokes without the model's error,
/// that error at every place, and the gap beneath every press.
TEST(PressFit, IsTheConditionalOfHeightsPoseAndTheModelsErrorTogether) {
  using Matrix = Eigen::MatrixXd;
  SegmentedBone bone(2, 0.0005, 0.0);
  const auto places = bone.pressed(6);
  const PressModel press;
  const PressFit fit = fit_presses(bone.model(), bone.registration, places, press).value();
  const ModelShare& strokes = bone.registration.model_share;
  const auto m = static_cast<Eigen::Index>(strokes.places_m.size());
  const auto n = static_cast<Eigen::Index>(places.size());
  ASSERT_GT(m, 50);
  const Eigen::Matrix<double, 6, 1> step =
      Eigen::Map<const Eigen::Matrix<double, 6, 1>>(fit.step.data());

  // Rows: the heights, then the pose. Columns: what they are sums of.
  Matrix sums = Matrix::Zero(n + 6, 6 + m + 2 * n);
  Matrix rest = Matrix::Zero(6 + m + 2 * n, 6 + m + 2 * n);  // covariance but for the model's error
  sums.block(n, 0, 6, 6).setIdentity();
  std::vector<Vec3> all_m = strokes.places_m;
  for (Eigen::Index i = 0; i < m; ++i) {
    sums.block(n, 6 + i, 6, 1) = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(
        strokes.step[static_cast<std::size_t>(i)].data());
  }
  Eigen::VectorXd above_m(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedHeight& at = fit.heights[static_cast<std::size_t>(i)];
    all_m.push_back(at.at_m);
    const Vec3 turned = (at.at_m - fit.centre_m).cross(at.up);
    Eigen::Matrix<double, 1, 6> slope;
    slope << at.up.x, at.up.y, at.up.z, turned.x, turned.y, turned.z;
    // A step to the true pose takes away what the pose is off.
    sums.row(i) = -slope * sums.bottomRows(6);
    sums(i, 6 + m + i) = sums(i, 6 + m + n + i) = 1.0;
    const auto nearest = bone.model().reachable_surface().nearest(at.at_m);
    const double side = bone.model().surface().contains(at.at_m) ? -1.0 : 1.0;
    above_m(i) = side * nearest->distance_m - press.height_m - slope.dot(step);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double apart_m = (at.at_m - fit.heights[static_cast<std::size_t>(k)].at_m).norm();
      rest(6 + m + n + i, 6 + m + n + k) = std::pow(press.common_sd_m, 2) +
                                           std::pow(press.sd_m, 2) * std::exp(-apart_m / 0.003) +
                                           (i == k ? at.sd_m * at.sd_m : 0.0);
    }
  }
  for (Eigen::Index i = 0; i < 36; ++i) {
    rest(i / 6, i % 6) = strokes.rest[static_cast<std::size_t>(i)];
  }
  rest.diagonal().head<3>().array() += press.moved_sd_m * press.moved_sd_m;
  const auto field_of = [&](double length_m) {
    Matrix field = Matrix::Zero(rest.rows(), rest.cols());
    for (Eigen::Index i = 0; i < m + n; ++i) {
      for (Eigen::Index k = 0; k < m + n; ++k) {
        const Vec3 apart_m =
            all_m[static_cast<std::size_t>(i)] - all_m[static_cast<std::size_t>(k)];
        const double x = 2.146193 / length_m * apart_m.norm();
        field(6 + i, 6 + k) = (1.0 + x) * std::exp(-x);
      }
    }
    return field;
  };
  double weights = 0.0;
  Matrix mean = Matrix::Zero(6, 1);
  Matrix squares = Matrix::Zero(6, 6);
  for (const ModelErrorHypothesis& by : model_error_hypotheses()) {
    const Matrix both =
        sums * (rest + std::pow(by.error.sd_m, 2) * field_of(by.error.length_m)) * sums.transpose();
    const Matrix heights = both.topLeftCorner(n, n);
    const Matrix gain = both.bottomLeftCorner(6, n) * heights.inverse();
    const double weight =
        std::exp(by.log_probability - 0.5 * above_m.dot(heights.inverse() * above_m)) /
        std::sqrt((1e7 * heights).determinant());
    const Matrix at = gain * above_m;
    weights += weight;
    mean += weight * at;
    squares += weight * (both.bottomRightCorner(6, 6) - gain * both.topRightCorner(n, 6) +
                         at * at.transpose());
  }
  mean /= weights;
  const Matrix covariance = squares / weights - mean * mean.transpose();
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(step(i), mean(i), 2e-6) << i;
    for (Eigen::Index k = 0; k < 6; ++k) {
      EXPECT_NEAR(fit.covariance[static_cast<std::size_t>(6 * i + k)], covariance(i, k),
                  1e-3 * std::sqrt(covariance(i, i) * covariance(k, k)))
          << i << " " << k;
    }
  }
}

/// The model is off by as much under a press as under the stroke beside it: both together are
/// hardly surer than one.
TEST(PressFit, KnowsThatStrokesWereOffTheSameModel) {
  constexpr std::uint64_t kSeeds = 5;
  double squares = 0.0, told_m2 = 0.0, apart_m2 = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SegmentedBone bone(seed, 0.0005, 0.0);
    const auto places = bone.pressed(15);
    const PressFit together = fit_presses(bone.model(), bone.registration, places, {}).value();
    Registration forgotten = bone.registration;
    forgotten.model_share = {};
    const PressFit apart = fit_presses(bone.model(), forgotten, places, {}).value();
    squares += std::pow(bone.error_m(together) / worst_rms_m(bone, together), 2) / kSeeds;
    told_m2 += std::pow(worst_rms_m(bone, together), 2);
    apart_m2 += std::pow(worst_rms_m(bone, apart), 2);
  }
  EXPECT_LT(squares, 2.0);
  EXPECT_GT(squares, 0.3) << "honest, not timid";
  EXPECT_GT(std::sqrt(told_m2 / apart_m2), 1.05) << "the twin: apart they seem to be surer";
}

/// Where nothing is told of how far views are off, they are trusted too much.
TEST(PressFit, DepthViewsThatAreOffAlongTheirRaysStillTurnTheBone) {
  constexpr double kOff_m = 0.003;
  constexpr double kNoise_m = 0.001;
  constexpr std::uint64_t kSeeds = 4;
  double before_m2 = 0.0, after_m2 = 0.0, squares = 0.0, trusted_squares = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SegmentedBone bone(seed, 0.0, 0.002);
    const auto places = bone.seen(kOff_m, kNoise_m);
    const auto with = [&](double told_m) {
      PressModel camera;
      camera.height_m = 0.0;
      camera.sd_m = 0.0;
      camera.ray_sd_m = told_m;
      return fit_presses(bone.model(), bone.registration, places, camera).value();
    };
    const auto square = [&](const PressFit& fit) {
      return std::pow(bone.error_m(fit) / worst_rms_m(bone, fit), 2) / kSeeds;
    };
    before_m2 += std::pow(
        worst_rms_m(bone, fit_presses(bone.model(), bone.registration, {}, {}).value()), 2);
    const PressFit told = with(kOff_m);
    after_m2 += std::pow(worst_rms_m(bone, told), 2);
    squares += square(told);
    trusted_squares += square(with(0.0));
  }
  EXPECT_LT(after_m2, 0.6 * before_m2);
  EXPECT_LT(squares, 2.5);
  EXPECT_GT(trusted_squares, 4.0) << "the twin";
}

}  // namespace
}  // namespace orthonav::nav::press_fit_test

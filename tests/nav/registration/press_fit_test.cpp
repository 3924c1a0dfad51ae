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

/// Heights and pose as sums over the error at every place have the same covariances.
TEST(FieldCovariance, IsThatOfTheErrorAtAllPlaces) {
  constexpr double kLength_m = 0.007;
  constexpr int kStrokes = 12;
  constexpr int kPlaces = 3;
  Random random(4);
  const Vec3 centre_m = somewhere(random, 0.01);
  ModelShare strokes;
  Eigen::Matrix<double, 6, kStrokes + kPlaces> pose = decltype(pose)::Zero();
  std::vector<Vec3> all;
  for (int i = 0; i < kStrokes; ++i) {
    all.push_back(strokes.places_m.emplace_back(somewhere(random, 0.01)));
    for (double& step : strokes.step.emplace_back()) {
      step = random.normal();
    }
    pose.col(i) = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(strokes.step.back().data());
  }
  std::vector<PressedHeight> heights;
  Eigen::Matrix<double, kPlaces, kStrokes + kPlaces> height = decltype(height)::Zero();
  for (int k = 0; k < kPlaces; ++k) {
    PressedHeight& one = heights.emplace_back();
    one.at_m = all.emplace_back(somewhere(random, 0.01));
    one.up = somewhere(random, 1.0).normalized();
    const Vec3 turn = (one.at_m - centre_m).cross(one.up);
    Eigen::Matrix<double, 1, 6> slope;
    slope << one.up.x, one.up.y, one.up.z, turn.x, turn.y, turn.z;
    // A step of the pose to the true one takes away what it was off.
    height.row(k) = -slope * pose;
    height(k, kStrokes + k) = 1.0;
  }
  Eigen::MatrixXd errors(all.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double x = 2.146193 * (all[i] - all[k]).norm() / kLength_m;
      errors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = (1.0 + x) * std::exp(-x);
    }
  }
  const FieldCovariance field(strokes, kLength_m, centre_m);
  const Eigen::Matrix<double, 6, 6> of_pose = pose * errors * pose.transpose();
  for (Eigen::Index i = 0; i < 36; ++i) {
    EXPECT_NEAR(field.pose()[static_cast<std::size_t>(i)], of_pose(i / 6, i % 6), 1e-9);
  }
  const Eigen::MatrixXd of_heights = height * errors * height.transpose();
  const Eigen::MatrixXd of_both = height * errors * pose.transpose();
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const auto place = field.with_place(heights[i].at_m);
    const auto with_pose = field.with_pose(heights[i], place);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(-with_pose[k],
                  of_both(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)), 1e-9);
    }
    for (std::size_t k = 0; k < kPlaces; ++k) {
      EXPECT_NEAR(field.between(heights[i], place, heights[k], field.with_place(heights[k].at_m)),
                  of_heights(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)), 1e-9);
    }
  }
}

double worst_rms_m(const StrokedBone& bone, const PressFit& fit) {
  double worst_m = 0.0;
  for (const Point<Vertebra>& target : bone.options.targets) {
    worst_m =
        std::max(worst_m, PoseUncertainty(fit.centre_m, fit.covariance).predicted_tre_m(target));
  }
  return worst_m;
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

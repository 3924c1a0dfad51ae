// What real strokes are like, and what registrations of them are worth: 2,000 points on a sawbone
// pelvis (shared/real/ucl-mphy0026-pelvis; docs/real-measurements.md). Without it nothing is done.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "base/angle.h"
#include "nav/geometry/absolute_orientation.h"
#include "nav/registration/registration.h"
#include "tests/support/stroked_pelvis.h"

namespace orthonav::bench {
namespace {

using Pose = Transform<World, Vertebra>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Points = std::vector<Point<World>>;

/// A set's pose, as a motion (translation m, rotation vector rad) from another at a place.
struct Motion {
  Vector6 value;
  Matrix6 covariance;
};

/// `u`: of the pose `a`, in the model's frame.
Motion motion(const Pose& a, const Pose& b, const nav::PoseUncertainty& u, Vec3 place_m) {
  const Transform<Vertebra, Vertebra> step = b.inverse() * a;
  const Vec3 shift = (step * Point<Vertebra>{place_m}).v - place_m;
  const Vec3 turn = vector_from_rotation(step.rotation());
  const Vec3 r = place_m - u.centre_m();
  Matrix6 j = Matrix6::Identity();
  j.topRightCorner<3, 3>() << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
  const Matrix6 at_centre =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(u.covariance().data());
  Motion out;
  out.value << shift.x, shift.y, shift.z, turn.x, turn.y, turn.z;
  out.covariance = j * at_centre * j.transpose();
  return out;
}

/// Chi-square of the motions about their weighted mean.
double chi_square(const std::vector<Motion>& sets) {
  Matrix6 information = Matrix6::Zero();
  Vector6 sum = Vector6::Zero();
  std::vector<Matrix6> inverse;
  for (const Motion& m : sets) {
    inverse.push_back(m.covariance.inverse());
    information += inverse.back();
    sum += inverse.back() * m.value;
  }
  const Vector6 mean = information.ldlt().solve(sum);
  double chi = 0.0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Vector6 off = sets[i].value - mean;
    chi += off.dot(inverse[i] * off);
  }
  return chi;
}

/// The quantile of chi-square, by Wilson & Hilferty 1931.
double chi_square_quantile(double sds, double freedom) {
  const double v = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - v + sds * std::sqrt(v), 3.0);
}

/// Covariance of a pose about the middle of the points that it was fitted to with this FRE.
Matrix6 covariance_of_fit(const std::vector<Vec3>& points_m, Vec3 middle_m, double fre_m) {
  const auto n = static_cast<double>(points_m.size());
  // Six of 3n residuals go into the pose.
  const double variance_m2 = fre_m * fre_m * n / (3.0 * n - 6.0);
  Matrix6 information = Matrix6::Zero();
  for (const Vec3& p : points_m) {
    const Vec3 r = p - middle_m;
    Eigen::Matrix<double, 3, 6> j = Eigen::Matrix<double, 3, 6>::Zero();
    j.leftCols<3>().setIdentity();
    j.rightCols<3>() << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
    information += j.transpose() * j / variance_m2;
  }
  return information.inverse();
}

void against_posts(const test::StrokedPelvis& pelvis, const nav::Registration& r) {
  const auto posts =
      nav::absolute_orientation(pelvis.posts_in_model_m, pelvis.posts_in_world_m).value();
  Vec3 middle;
  for (const Vec3& p : pelvis.posts_in_model_m) {
    middle += 0.25 * p;
  }
  const Motion off =
      motion(r.world_from_vertebra, {posts.rotation, posts.translation_m}, *r.uncertainty, middle);
  const Matrix6 predicted =
      off.covariance + covariance_of_fit(pelvis.posts_in_model_m, middle, posts.rmse_m);
  std::printf("\nless the pose by four posts (FRE %.2f mm), with the predicted SD of both:\n",
              posts.rmse_m * 1e3);
  constexpr std::array<const char*, 6> kNames = {
      "x mm", "y mm (along the posts)", "z mm", "about x deg", "about y deg", "about z deg"};
  for (int k = 0; k < 6; ++k) {
    const double unit = k < 3 ? 1e3 : degrees(1.0);
    std::printf("  %-24s %6.2f (%.2f)\n", kNames[static_cast<std::size_t>(k)], off.value(k) * unit,
                std::sqrt(predicted(k, k)) * unit);
  }
}

/// Disjoint sets of the strokes: `in a row`, or of every `parts`-th run of 25 points.
void disjoint(const nav::VertebraModel& model, const Points& strokes, const Pose& whole,
              std::size_t parts, bool in_runs, double least_model_sd_m) {
  constexpr std::size_t kRun = 25;
  constexpr double kWrong_m = 0.002;
  const nav::PrincipalAxes& axes = model.reachable_axes();
  std::vector<Motion> accepted;
  std::size_t wrong = 0;
  std::size_t wrong_accepted = 0;
  double real_m2 = 0.0;
  double predicted_m2 = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    Points some;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      if ((in_runs ? i / kRun % parts : i * parts / strokes.size()) == part) {
        some.push_back(strokes[i]);
      }
    }
    nav::PoseSearchRegistrationOptions options;
    options.least_model_sd_m = least_model_sd_m;
    const auto r = nav::register_by_pose_search(model, some, options);
    if (!r || !r->uncertainty) {
      ++wrong;
      continue;
    }
    double off_m = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double side : {2.0, -2.0}) {
        const Point<Vertebra> end{axes.centre_m + side * axes.deviation_m[k] * axes.axes[k]};
        off_m = std::max(off_m, (r->world_from_vertebra * end - whole * end).norm());
      }
    }
    wrong += off_m > kWrong_m ? 1 : 0;
    wrong_accepted += off_m > kWrong_m && r->accepted ? 1 : 0;
    if (r->accepted) {
      accepted.push_back(motion(r->world_from_vertebra, whole, *r->uncertainty, axes.centre_m));
    }
  }
  const double freedom = 6.0 * static_cast<double>(accepted.size() - 1);
  const double chi = chi_square(accepted);
  Vector6 mean = Vector6::Zero();
  for (const Motion& m : accepted) {
    mean += m.value / static_cast<double>(accepted.size());
  }
  for (const Motion& m : accepted) {
    real_m2 += (m.value - mean).head<3>().squaredNorm() / static_cast<double>(accepted.size() - 1);
    predicted_m2 +=
        m.covariance.topLeftCorner<3, 3>().trace() / static_cast<double>(accepted.size());
  }
  // The ratio of SDs, and its interval if the true one is constant.
  std::printf("  %2zu %-10s %3zu %3zu %3zu   %.2f %.2f mm   %4.0f of %2.0f  %.1f (%.1f to %.1f)\n",
              parts, in_runs ? "in runs" : "in a row", accepted.size(), wrong, wrong_accepted,
              std::sqrt(real_m2) * 1e3, std::sqrt(predicted_m2) * 1e3, chi, freedom,
              std::sqrt(chi / freedom), std::sqrt(chi / chi_square_quantile(1.96, freedom)),
              std::sqrt(chi / chi_square_quantile(-1.96, freedom)));
}

struct Height {
  Vec3 at_m;
  Vec3 normal;
  double height_m = 0.0;
  bool counts = false;
};

struct Correlation {
  double product = 0.0;
  double distance_m = 0.0;
  std::size_t pairs = 0;

  void add(const Height& a, const Height& b, double mean_m) {
    product += (a.height_m - mean_m) * (b.height_m - mean_m);
    distance_m += (a.at_m - b.at_m).norm();
    ++pairs;
  }
  void print(const char* what, double variance_m2) const {
    const auto n = static_cast<double>(pairs);
    std::printf("  %-32s %.2f (%zu pairs, %.0f mm apart)\n", what, product / n / variance_m2, pairs,
                distance_m / n * 1e3);
  }
};

void heights(const nav::VertebraModel& model, const Points& strokes, const Pose& pose) {
  constexpr double kFar_m = 0.001;
  std::vector<Height> all;
  std::vector<double> sorted;
  for (const Point<World>& p : strokes) {
    const Vec3 at = (pose.inverse() * p).v;
    const auto near = model.surface().nearest(at).value();
    const double side = model.surface().contains(at) ? -1.0 : 1.0;
    all.push_back({at, near.normal, side * near.distance_m});
    sorted.push_back(all.back().height_m);
  }
  std::sort(sorted.begin(), sorted.end());
  const double median_m = sorted[sorted.size() / 2];
  double mean_m = 0.0;
  double count = 0.0;
  for (Height& h : all) {
    h.counts = std::abs(h.height_m - median_m) < kFar_m;
    mean_m += h.counts ? h.height_m : 0.0;
    count += h.counts ? 1.0 : 0.0;
  }
  mean_m /= count;
  double variance_m2 = 0.0;
  for (const Height& h : all) {
    variance_m2 += h.counts ? (h.height_m - mean_m) * (h.height_m - mean_m) / count : 0.0;
  }
  std::printf(
      "\nheights over the model at that pose: mean %.2f mm, SD %.2f, without the %.1f %% "
      "farther than %.0f mm from the median\n",
      mean_m * 1e3, std::sqrt(variance_m2) * 1e3,
      1e2 * (1.0 - count / static_cast<double>(all.size())), kFar_m * 1e3);
  for (const std::size_t lag : {1U, 2U, 5U, 10U, 20U, 50U}) {
    Correlation along;
    for (std::size_t i = 0; i + lag < all.size(); ++i) {
      if (all[i].counts && all[i + lag].counts) {
        along.add(all[i], all[i + lag], mean_m);
      }
    }
    const std::string name = "correlation, " + std::to_string(lag) + " points later";
    along.print(name.c_str(), variance_m2);
  }
  constexpr std::array<double, 6> kApart_m = {0.0, 0.004, 0.008, 0.016, 0.032, 0.064};
  constexpr std::size_t kAnother = 100;  // points later it is another stroke
  for (std::size_t bin = 0; bin + 1 < kApart_m.size(); ++bin) {
    Correlation across;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t k = i + kAnother; k < all.size(); ++k) {
        const double apart_m = (all[i].at_m - all[k].at_m).norm();
        if (all[i].counts && all[k].counts && apart_m >= kApart_m[bin] &&
            apart_m < kApart_m[bin + 1] && all[i].normal.dot(all[k].normal) > 0.5) {
          across.add(all[i], all[k], mean_m);
        }
      }
    }
    across.print("correlation, another stroke", variance_m2);
  }
}

int measure() {
  const auto pelvis = test::stroked_pelvis();
  if (!pelvis) {
    std::puts("skipped: needs shared/real/ucl-mphy0026-pelvis beside the checkout");
    return 0;
  }
  const auto model = nav::VertebraModel::prepare(pelvis->mesh, nav::Bone::kAny).value();
  const auto whole = nav::register_by_pose_search(*model, pelvis->strokes);
  if (!whole || !whole->accepted) {
    std::puts("the strokes are not registered");
    return 1;
  }
  std::printf(
      "%zu strokes registered: offset %.2f mm, SD %.2f mm, field %.2f mm, 99 %% of errors "
      "at the ends below %.2f mm\n",
      pelvis->strokes.size(), whole->standoff_m * 1e3, whole->noise_m * 1e3,
      whole->field_sd_m * 1e3, whole->tre_99_m * 1e3);
  against_posts(*pelvis, *whole);
  heights(*model, pelvis->strokes, whole->world_from_vertebra);
  for (const double told_m : {0.0, 0.0003}) {
    std::printf(
        "\ndisjoint sets, told that the model is off by %.1f mm at least: accepted, more "
        "than 2 mm off, of these\naccepted; real and predicted SD in 3-D at the middle; "
        "chi-square of the poses; real through predicted SD (95 %%)\n",
        told_m * 1e3);
    for (const bool in_runs : {false, true}) {
      for (const std::size_t parts : {2U, 4U, 8U, 16U}) {
        disjoint(*model, pelvis->strokes, whole->world_from_vertebra, parts, in_runs, told_m);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace orthonav::bench

int main() { return orthonav::bench::measure(); }

#include "nav/registration/posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "engine/phantom/phantom.h"
#include "nav/geometry/triangle.h"
#include "nav/registration/decision.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav::posterior {
namespace {

/// The built-in phantom's L4.
struct Bone {
  engine::CaseLevel from = engine::phantom({"L4"}).levels.at(0);
  std::shared_ptr<const VertebraModel> model = VertebraModel::prepare(from.mesh).value();

  [[nodiscard]] Question question() const {
    Question q;
    for (const ScrewPlan& screw : from.screws) {
      q.targets.insert(q.targets.end(), {screw.entry, screw.target});
    }
    return q;
  }
};
const Bone& bone() {
  static const Bone the;
  return the;
}

Observations strokes(test::StrokeVariant variant, std::uint64_t seed,
                     const test::StrokeTruths& truths = {},
                     Transform<World, Vertebra>* truth = nullptr) {
  auto digitized = test::digitize_strokes(bone().from.mesh, variant, seed).value();
  test::apply_truths(truths, bone().from.mesh, seed, digitized);
  if (truth != nullptr) {
    *truth = digitized.world_from_vertebra;
  }
  return observed(digitized.tips(), 0.0);
}

double error_m(const Transform<World, Vertebra>& pose, const Transform<World, Vertebra>& truth) {
  double most = 0.0;
  for (const Point<Vertebra>& target : bone().question().targets) {
    most = std::max(most, (pose * target - truth * target).norm());
  }
  return most;
}

double error_m(const Decision& d, const Transform<World, Vertebra>& truth) {
  return error_m(d.answer.world_from_vertebra, truth);
}

// The integral over the standoff and the noise, held against sums over a fine grid.

/// By brute force: every s and every scale of the noise.
OverStandoff summed(const Squares& q, double freedom,
                    const std::function<double(double, double)>& log_prior, double most_m) {
  constexpr int kSteps = 1500;
  constexpr int kScales = 150;
  std::vector<std::array<double, 3>> all;  // log value, s, noise²
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    const double s = most_m * (i + 0.5) / kSteps;
    const double squares = q.height - 2.0 * s * q.product + s * s * q.standoff;
    const double middle = 0.5 * std::log(squares / freedom);
    const double reach = 8.0 / std::sqrt(2.0 * freedom);
    for (int k = 0; k < kScales; ++k) {
      const double log_noise = middle + reach * (2.0 * (k + 0.5) / kScales - 1.0);
      const double noise2 = std::exp(2.0 * log_noise);
      const double value = -0.5 * freedom * std::log(2.0 * std::numbers::pi * noise2) -
                           0.5 * squares / noise2 + log_prior(s, std::sqrt(noise2)) +
                           std::log(most_m / kSteps) + std::log(2.0 * reach / kScales);
      all.push_back({value, s, noise2});
      most = std::max(most, value);
    }
  }
  OverStandoff out;
  double sum = 0.0, square = 0.0;
  for (const auto& [value, s, noise2] : all) {
    const double p = std::exp(value - most);
    sum += p;
    out.mean_m += p * s;
    square += p * s * s;
  }
  out.log_integral = most + std::log(sum);
  out.mean_m /= sum;
  out.variance_m2 = square / sum - out.mean_m * out.mean_m;
  return out;
}

/// The likeliest standoff, in SDs of it: far below zero the rest of the normal law is a thin tail,
/// whose variance and evidence have to be right all the same.
TEST(PosteriorStandoff, IsIntegratedAsASumOverEveryValueSays) {
  constexpr double kNoise_m = 0.0003;
  constexpr double kFreedom = 400.0;
  for (const double t : {-10.0, -6.0, -2.0, 0.0, 3.0, 30.0}) {
    const double sd_m = 0.00005;
    const double standoff = kNoise_m * kNoise_m / (sd_m * sd_m);
    const double at_m = t * sd_m;
    const Squares squares{kFreedom * kNoise_m * kNoise_m + at_m * at_m * standoff, at_m * standoff,
                          standoff};
    const auto even = [](double, double) { return 0.0; };
    const OverStandoff ours = over_standoff(squares, kFreedom, even);
    const OverStandoff right = summed(squares, kFreedom, even, std::max(at_m, 0.0) + 8.0 * sd_m);
    EXPECT_NEAR(ours.log_integral, right.log_integral, 0.01) << t;
    EXPECT_NEAR(ours.mean_m, right.mean_m, 0.01 * sd_m + 0.01 * right.mean_m) << t;
    EXPECT_NEAR(ours.variance_m2 / right.variance_m2, 1.0, 0.03) << t;
  }
}

TEST(PosteriorStandoff, APriorThatIsNarrowAtZeroCounts) {
  constexpr double kFreedom = 300.0;
  const double noise2 = 0.0004 * 0.0004;
  const double standoff = 4.0;  // SD 0.2 mm, beside a prior of 0.1
  const Squares squares{kFreedom * noise2, 0.0001 * standoff, standoff};
  const auto log_prior = [](double s, double) { return -0.5 * s * s / (0.0001 * 0.0001); };
  const OverStandoff ours = over_standoff(squares, kFreedom, log_prior);
  const OverStandoff right = summed(squares, kFreedom, log_prior, 0.002);
  EXPECT_NEAR(ours.log_integral, right.log_integral, 0.02);
  EXPECT_NEAR(ours.mean_m / right.mean_m, 1.0, 0.02);
}

// Distances.

/// Every triangle looked at; the side by the solid.
double distance_by_force_m(const TriangleMesh& mesh, Vec3 p, bool inside) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const TriangleMesh one{{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]},
                           {{0, 1, 2}}};
    least_m = std::min(least_m, SurfaceIndex(one).nearest(p)->distance_m);
  }
  return inside ? -least_m : least_m;
}

TEST(PosteriorBone, DistancesAreTrueDeepInsideToo) {
  const BoneSurface surface(*bone().model);
  const BoneSurface mirrored(*bone().model, true);
  const Bounds box = bounds_of(bone().from.mesh);
  Random random(3);
  // Places anywhere, and some that lie deeper than the search's field of distances is true.
  constexpr double kDeep_m = 0.008;
  std::size_t anywhere = 20, deep = 10;
  while (anywhere + deep > 0) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = random.uniform(box.low[axis], box.high[axis]);
    }
    const bool inside = bone().model->surface().contains(p);
    const bool is_deep = inside && bone().model->surface().nearest(p)->distance_m > kDeep_m;
    std::size_t& left = is_deep ? deep : anywhere;
    if (left == 0) {
      continue;
    }
    --left;
    const double right_m = distance_by_force_m(bone().from.mesh, p, inside);
    const auto place = surface.at(p);
    EXPECT_NEAR(place.distance_m, right_m, 1e-9);
    EXPECT_NEAR(place.out.dot(p - place.nearest_m), right_m, 1e-9) << "away from the bone";
    EXPECT_NEAR(mirrored.at({-p.x, p.y, p.z}).distance_m, right_m, 1e-9);
    EXPECT_NEAR(surface.near(p, bone().from.mesh.vertices_m[0]).distance_m, right_m, 1e-9);
  }
}

TEST(PosteriorBone, ScatterAboutItLiesHigherByHalfTheCurvatureTimesItsVariance) {
  const BoneSurface surface(*bone().model);
  Random random(4);
  constexpr double kSd_m = 0.0004;
  double lifted_m = 0.0, predicted_m = 0.0, bare_m = 0.0;
  const auto observations = strokes(test::StrokeVariant::kFull, 3);
  const auto truth = decided(*bone().model, observations, bone().question()).value();
  const auto from_world = truth.answer.world_from_vertebra.inverse();
  for (std::size_t i = 0; i < observations.strokes.size(); i += 4) {
    const auto place = surface.at((from_world * observations.strokes[i].tip).v);
    predicted_m += 0.5 * kSd_m * kSd_m *
                   surface.curvature_1_m(place.nearest_m, place.out, std::numbers::sqrt2 * kSd_m);
    for (int k = 0; k < 20; ++k) {
      const Vec3 off{random.normal(0.0, kSd_m), random.normal(0.0, kSd_m),
                     random.normal(0.0, kSd_m)};
      lifted_m += surface.at(place.nearest_m + off).distance_m / 20.0;
    }
    bare_m += kSd_m;
  }
  EXPECT_NEAR(lifted_m / predicted_m, 1.0, 0.35);
  EXPECT_GT(predicted_m, 0.01 * bare_m) << "a bone is convex where it is stroked";
}

// Answers.

TEST(Posterior, PredictsTheErrorsOfItsPoses) {
  // Over strokes of which it knows all but the noise: clean, few, and over uneven tissue.
  struct Kind {
    test::StrokeVariant variant;
    test::StrokeTruths truths;
  };
  std::vector<Kind> kinds{{test::StrokeVariant::kFull, {}}, {test::StrokeVariant::kSparse, {}}};
  kinds.push_back({test::StrokeVariant::kFull, {}});
  kinds.back().truths.tissue = test::Tissue::kAreas;
  kinds.back().truths.mean_tissue_m = 0.001;
  double squares = 0.0;
  double predicted = 0.0;
  int within_99 = 0, runs = 0;
  for (const Kind& kind : kinds) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Transform<World, Vertebra> truth;
      const auto o = strokes(kind.variant, seed, kind.truths, &truth);
      const auto d = decided(*bone().model, o, bone().question());
      ASSERT_TRUE(d);
      const double off_m = error_m(*d, truth);
      squares += off_m * off_m / (d->rms_m * d->rms_m);
      predicted += 1.0;
      within_99 += off_m < d->within_99_m ? 1 : 0;
      ++runs;
      EXPECT_FALSE(d->accepted && off_m > 0.002) << seed;
    }
  }
  EXPECT_GT(squares / predicted, 0.4) << "honest, not timid";
  EXPECT_LT(squares / predicted, 1.7);
  EXPECT_GE(within_99, runs - 1);
}

TEST(Posterior, CleanStrokesAreAcceptedAndTheirNoiseAndHeightAreTold) {
  Transform<World, Vertebra> truth;
  test::StrokeTruths even;
  even.tissue = test::Tissue::kUniform;
  even.mean_tissue_m = 0.001;
  const auto o = strokes(test::StrokeVariant::kFull, 2, even, &truth);
  const auto d = decided(*bone().model, o, bone().question());
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->accepted) << d->wrong;
  EXPECT_LT(error_m(*d, truth), 0.0005);
  EXPECT_NEAR(d->answer.standoff_m, 0.001, 0.0002);
  EXPECT_NEAR(d->answer.noise_m, 0.0003, 0.0001);
  EXPECT_NEAR(d->answer.size, 1.0, 4.0 * d->answer.size_sd);
  EXPECT_LT(d->answer.uneven_m, 0.0002);
}

TEST(Posterior, AHandThatWandersSmoothlyIsNotTakenForTissue) {
  // Heights along each stroke with a correlation like Matern's, of 0.8 mm over 0.3 s.
  constexpr double kSd_m = 0.0008;
  const double stays = std::exp(-2.146193 / (0.3 * 30.0));
  const BoneSurface surface(*bone().model);
  double squares = 0.0, uneven_m = 0.0;
  int smooth = 0;
  constexpr int kRuns = 6;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Transform<World, Vertebra> truth;
    auto o = strokes(test::StrokeVariant::kFull, seed, {}, &truth);
    Random random(seed);
    std::vector<double> wanders;
    double square = 0.0, first = 0.0, second = 0.0;
    for (std::size_t i = 0; i < o.strokes.size(); ++i) {
      if (i == 0 || o.strokes[i].stroke != o.strokes[i - 1].stroke) {
        for (int k = 0; k < 200; ++k) {
          first = stays * first + random.normal();
          second = stays * second + first;
        }
      }
      first = stays * first + random.normal();
      second = stays * second + first;
      wanders.push_back(second);
      square += second * second / static_cast<double>(o.strokes.size());
    }
    for (std::size_t i = 0; i < o.strokes.size(); ++i) {
      const Vec3 at = (truth.inverse() * o.strokes[i].tip).v;
      const Vec3 out = truth.rotation() * surface.at(at).out;
      o.strokes[i].tip = o.strokes[i].tip + kSd_m / std::sqrt(square) * wanders[i] * out;
    }
    const auto d = decided(*bone().model, o, bone().question()).value();
    const double off_m = error_m(d, truth);
    squares += off_m * off_m / (d.rms_m * d.rms_m);
    uneven_m += d.answer.uneven_m / kRuns;
    const Mixture& likeliest = d.answer.parts.front().of;
    smooth += likeliest.noise.smooth ? 1 : 0;
    EXPECT_NEAR(std::log(likeliest.noise.over / 0.3), 0.0, 1.1) << seed;
  }
  EXPECT_GE(smooth, kRuns - 1);
  EXPECT_LT(uneven_m, 0.7 * kSd_m);
  EXPECT_GT(squares / kRuns, 0.3) << "honest, not timid";
  EXPECT_LT(squares / kRuns, 2.0);
}

/// Strokes that were refused stay, and those made after them press harder: through the same tissue,
/// nearer to the bone.
TEST(Posterior, AHandThatPressesHarderThanBeforeIsNoField) {
  constexpr double kLater_s = 60.0;
  auto light = test::digitize_strokes(bone().from.mesh, test::StrokeVariant::kFull, 4).value();
  auto firm = test::digitize_strokes(bone().from.mesh, test::StrokeVariant::kFull, 5).value();
  test::apply_truths({test::Tissue::kSmooth, 0.0025}, bone().from.mesh, 4, light);
  test::apply_truths({test::Tissue::kSmooth, 0.0010}, bone().from.mesh, 4, firm);
  std::vector<Point<World>> tips = light.tips();
  std::vector<double> times_s = light.times_s();
  const auto same_world = light.world_from_vertebra * firm.world_from_vertebra.inverse();
  const double end_s = times_s.back();
  const std::vector<double> then_s = firm.times_s();
  for (std::size_t i = 0; i < then_s.size(); ++i) {
    tips.push_back(same_world * firm.tips()[i]);
    times_s.push_back(end_s + kLater_s + then_s[i]);
  }
  const Observations both = observed(tips, 0.0, {}, times_s);
  const Decision d = decided(*bone().model, both, bone().question()).value();
  double in_time = 0.0;
  for (const Part& part : d.answer.parts) {
    in_time += part.of.act == Act::kWhile ? part.weight : 0.0;
  }
  EXPECT_GT(in_time, 0.9);
  // The control: a hand that never changes has to be explained otherwise.
  Question never = bone().question();
  never.prior.while_s = 1e9;
  const Decision otherwise = decided(*bone().model, both, never).value();
  EXPECT_LT(otherwise.answer.log_evidence, d.answer.log_evidence - 10.0);
  EXPECT_LT(error_m(d, light.world_from_vertebra), 2.0 * d.rms_m);
}

/// Tissue that is even within an area and leaps from one to the next is no smooth field: the pose
/// is as exact as over even tissue.
TEST(Posterior, TissueThatLeapsBetweenAreasIsNoField) {
  for (const double mean_m : {0.001, 0.002}) {
    auto digitized =
        test::digitize_strokes(bone().from.mesh, test::StrokeVariant::kFull, 9).value();
    test::apply_truths({test::Tissue::kAreas, mean_m}, bone().from.mesh, 9, digitized);
    const Observations areas = observed(digitized.tips(), 0.0, {}, digitized.times_s());
    ASSERT_GT(areas.strokes.back().stroke, 3 * areas.strokes.back().area) << "of many strokes each";
    const Decision d = decided(*bone().model, areas, bone().question()).value();
    double by_area = 0.0;
    for (const Part& part : d.answer.parts) {
      by_area += part.of.act == Act::kArea ? part.weight : 0.0;
    }
    EXPECT_GT(by_area, 0.99) << mean_m;
    EXPECT_TRUE(d.accepted) << mean_m;
    EXPECT_LT(error_m(d, digitized.world_from_vertebra), 0.0004) << mean_m;
    // The control: the same points, each of whose strokes is an area, are a field.
    Observations apart = areas;
    for (StrokePoint& p : apart.strokes) {
      p.area = p.stroke;
    }
    const Decision field = decided(*bone().model, apart, bone().question()).value();
    EXPECT_LT(field.answer.log_evidence, d.answer.log_evidence - 3.0) << mean_m;
  }
}

TEST(Posterior, RepeatedPointsSayNothingNew) {
  const auto once =
      test::digitize_strokes(bone().from.mesh, test::StrokeVariant::kSparse, 4).value();
  std::vector<Point<World>> tips = once.tips();
  const auto first = decided(*bone().model, observed(tips, 0.0), bone().question());
  const std::vector<Point<World>> again = tips;
  tips.insert(tips.end(), again.begin(), again.end());
  const auto second = decided(*bone().model, observed(tips, 0.0), bone().question());
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->rms_m / first->rms_m, 1.0, 1e-6);
}

TEST(Posterior, AModelOfAnotherSizeIsNoticed) {
  for (const double size : {0.95, 1.05}) {
    const auto other = VertebraModel::prepare(test::scaled(bone().from.mesh, size)).value();
    const auto d =
        decided(*other, strokes(test::StrokeVariant::kFull, 5), bone().question()).value();
    EXPECT_FALSE(d.accepted) << size;
    EXPECT_NEAR(d.answer.size, 1.0 / size, 0.01);
    const auto most = std::max_element(
        d.explanations.begin(), d.explanations.end(),
        [](const auto& a, const auto& b) { return a.probability < b.probability; });
    EXPECT_EQ(most->kind, Explanation::Kind::kSize);
  }
}

TEST(Posterior, StrokesOfAnotherLevelAreRefused) {
  const auto l2 = engine::phantom({"L2"}).levels.at(0);
  const auto l2_model = VertebraModel::prepare(l2.mesh).value();
  const auto foreign = test::digitize_strokes(l2.mesh, test::StrokeVariant::kFull, 1).value();
  Question question = bone().question();
  question.neighbours.push_back({"L2", l2_model.get()});
  const auto d = decided(*bone().model, observed(foreign.tips(), 0.0), question).value();
  EXPECT_FALSE(d.accepted);
  EXPECT_GT(d.wrong, 0.99);
}

TEST(Posterior, PointsThatHoldNoPoseAreRefusedInOneLine) {
  const Question question = bone().question();
  const auto refused = [&](const std::vector<Point<World>>& points) {
    const auto d = decided(*bone().model, observed(points, 0.0), question);
    return !d || !d->accepted;
  };
  std::vector<Point<World>> line, ball, plane, noise, same(300);
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    line.push_back({{0.0002 * i, 0.0, 0.0}});
    const Vec3 n = Vec3{random.normal(), random.normal(), random.normal()}.normalized();
    ball.push_back({0.02 * n});
    plane.push_back({{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0.0}});
    noise.push_back(
        {{random.normal(0.0, 0.03), random.normal(0.0, 0.03), random.normal(0.0, 0.03)}});
  }
  std::vector<Point<World>> broken = line;
  broken[17].v.y = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point<World>> far = line;
  far[40].v.z = 1e300;
  for (const auto& points : {line, ball, plane, noise, same, broken, far, {}}) {
    EXPECT_TRUE(refused(points));
  }
}

TEST(Posterior, IsTheSameAgain) {
  const auto o = strokes(test::StrokeVariant::kPartial, 6);
  const auto a = decided(*bone().model, o, bone().question()).value();
  const auto b = decided(*bone().model, o, bone().question()).value();
  EXPECT_EQ(a.wrong, b.wrong);
  EXPECT_EQ(a.answer.world_from_vertebra.translation(), b.answer.world_from_vertebra.translation());
  EXPECT_EQ(a.answer.log_evidence, b.answer.log_evidence);
}

}  // namespace
}  // namespace orthonav::nav::posterior

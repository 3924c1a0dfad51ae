#include "nav/registration/posterior.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <utility>

#include "nav/statistics/median.h"

namespace orthonav::nav::posterior {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Rows6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr double kNever = -std::numeric_limits<double>::infinity();
/// Rotations are compared with translations at this lever arm.
constexpr double kLever_m = 0.03;

double log_sum(double a, double b) {
  const double most = std::max(a, b);
  return most == kNever ? kNever : most + std::log1p(std::exp(std::min(a, b) - most));
}

// ---------------------------------------------------------------------------------------------
// The heights at a pose.

}  // namespace

/// Every point at a pose.
struct Touches {
  Transform<Vertebra, World> from_world;
  Vec3 centre_m;  ///< of the points, in the model's frame
  struct Touch {
    Vec3 lever_m;  ///< from the centre
    Vec3 out;
    Vec3 nearest_m;
    double height_m = 0.0;
    /// How deep in a valley the place lies (a ridge: negative).
    double valley_m = 0.0;
    /// Sum of the bone's curvatures there, convex positive: points that scatter about a curved
    /// surface lie, on average, half of it times their variance off the surface.
    double curvature_1_m = 0.0;
  };
  std::vector<Touch> all;
};

namespace {

/// `wanted`: only these points; empty: all. `before`: what was found at another pose, perhaps for
/// some points only; they keep the shape of the bone that they had there.
Touches touches_at(const Observations& observations, const BoneSurface& bone,
                   const Transform<Vertebra, World>& from_world,
                   std::span<const std::uint32_t> wanted, const Touches* before) {
  constexpr double kScatter_m = 0.001;
  constexpr double kValley_m = 0.006;
  Touches out;
  out.from_world = from_world;
  out.all.resize(observations.strokes.size());
  Vec3 centre_in_world_m;
  for (const StrokePoint& p : observations.strokes) {
    centre_in_world_m += p.tip.v / static_cast<double>(observations.strokes.size());
  }
  out.centre_m = (from_world * Point<World>{centre_in_world_m}).v;
  const std::size_t count = wanted.empty() ? out.all.size() : wanted.size();
  // A hundred places tell the shape about all of them, each about those that follow it: of points
  // in no order it says little, and to look at all of these doubles the time.
  const std::size_t every = std::max<std::size_t>(1, count / 100);
  const Touches::Touch* shape = nullptr;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = wanted.empty() ? k : wanted[k];
    const Vec3 p = (from_world * observations.strokes[i].tip).v;
    const Touches::Touch* same = before != nullptr ? &before->all[i] : nullptr;
    if (same != nullptr && !(same->out.squared_norm() > 0.0)) {
      same = nullptr;  // it was not wanted there
    }
    const auto place = same != nullptr ? bone.near(p, same->nearest_m) : bone.at(p);
    Touches::Touch& touch = out.all[i];
    touch.lever_m = p - out.centre_m;
    touch.out = place.out;
    touch.nearest_m = place.nearest_m;
    touch.height_m = place.distance_m - observations.tip_radius_m;
    if (same != nullptr) {
      shape = same;
    } else if (shape == nullptr || (before == nullptr && k % every == 0)) {
      touch.valley_m = -bone.mean_height_around_m(place.nearest_m, place.out, kValley_m);
      touch.curvature_1_m = bone.curvature_1_m(place.nearest_m, place.out, kScatter_m);
      shape = &touch;
    }
    touch.valley_m = shape->valley_m;
    touch.curvature_1_m = shape->curvature_1_m;
  }
  return out;
}

double entropy(double p) { return p > 1e-300 ? -p * std::log(p) : 0.0; }

using Square = Eigen::Matrix<double, kBlock, kBlock>;

/// Which points belong to the bone, by a mixture of a Gaussian about the mean height and an even
/// density (expectation maximization, from the median); and how those of the blocks all of whose
/// points do deviate from the block's mean.
Hand hand_at(const Observations& observations, const Prior& prior,
             std::span<const std::array<std::uint32_t, kBlock>> blocks, const Touches& t) {
  constexpr int kRounds = 8;
  constexpr double kLeast_m = 0.0001;
  constexpr double kMax_m = 0.010;
  constexpr double kSdByMedian = 1.4826;
  constexpr double kBelongs = 0.5;
  Hand out;
  std::vector<double> heights;
  for (const auto& touch : t.all) {
    heights.push_back(touch.height_m);
  }
  double mean_m = median(heights);
  for (double& h : heights) {
    h = std::abs(h - mean_m);
  }
  out.spread_m = std::clamp(kSdByMedian * median(std::move(heights)), kLeast_m, kMax_m);
  out.belongs.assign(t.all.size(), 1.0);
  const double outside = prior.outlier_share / prior.outlier_range_m;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0.0, sum_m = 0.0, sum_m2 = 0.0;
    for (std::size_t i = 0; i < t.all.size(); ++i) {
      const double height_m = t.all[i].height_m;
      const double z = (height_m - mean_m) / out.spread_m;
      const double inside = (1.0 - prior.outlier_share) * std::exp(-0.5 * z * z) /
                            (out.spread_m * std::sqrt(2.0 * std::numbers::pi));
      out.belongs[i] = inside / (inside + outside);
      sum += out.belongs[i];
      sum_m += out.belongs[i] * height_m;
      sum_m2 += out.belongs[i] * height_m * height_m;
    }
    if (!(sum > 6.0)) {
      break;
    }
    mean_m = sum_m / sum;
    out.spread_m =
        std::clamp(std::sqrt(std::max(0.0, sum_m2 / sum - mean_m * mean_m)), kLeast_m, kMax_m);
  }
  for (const double p : out.belongs) {
    out.inliers += p;
    out.log_outliers += p * std::log1p(-prior.outlier_share) + (1.0 - p) * std::log(outside) +
                        entropy(p) + entropy(1.0 - p);
  }
  Eigen::Map<Square> products(out.products_m2.data());
  for (const auto& block : blocks) {
    Eigen::Matrix<double, kBlock, 1> deviations;
    bool all = true;
    for (std::size_t k = 0; k < kBlock; ++k) {
      deviations(static_cast<Eigen::Index>(k)) = t.all[block[k]].height_m;
      all = all && out.belongs[block[k]] > kBelongs;
    }
    if (!all) {
      continue;
    }
    deviations.array() -= deviations.mean();
    products += deviations * deviations.transpose();
    out.blocks += 1.0;
    for (std::size_t lag = 1; lag < kBlock; ++lag) {
      for (std::size_t k = 0; k + lag < kBlock; ++k) {
        const StrokePoint& a = observations.strokes[block[k]];
        const StrokePoint& b = observations.strokes[block[k + lag]];
        out.lag_s[lag] += (b.time_s - a.time_s) / static_cast<double>(kBlock - lag);
      }
    }
  }
  if (out.blocks > 0.0) {
    products /= out.blocks;
    for (std::size_t lag = 1; lag < kBlock; ++lag) {
      out.lag_s[lag] /= out.blocks;
    }
  }
  return out;
}

// What a height consists of, as columns: pose (6), valley, standoff, size, curvature; the height.
constexpr Eigen::Index kValley = 6;
constexpr Eigen::Index kMoved = 7;  ///< how many are integrated whatever else is
constexpr Eigen::Index kStandoff = 7;
constexpr Eigen::Index kSize = 8;
constexpr Eigen::Index kCurvature = 9;
constexpr Eigen::Index kHeight = 10;
constexpr Eigen::Index kColumns = 11;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, kColumns>;
using Products = Eigen::Matrix<double, kColumns, kColumns>;

// ---------------------------------------------------------------------------------------------
// The grid, and the prior of a point of it.

constexpr int kShares = 7;
constexpr int kTimes = 9;
constexpr int kRatios = 6;
constexpr int kActs = 3;
constexpr double kLeastRatio = 0.12;

constexpr double kByRatio = 2.8;
/// The SD of number k, of the noise's; each is `kByRatio` times the one before.
double ratio(int k) { return k == 0 ? 0.0 : kLeastRatio * std::pow(kByRatio, k - 1); }
/// Between it and the next one.
double ratio_above(int k) { return kLeastRatio * std::pow(kByRatio, k - 0.5); }

/// Indices of what a point of the grid is made of. Even times and lengths are rough, odd smooth.
enum Index : std::size_t { kShare, kTime, kTissue, kLength, kStroke, kModel, kAct };
using Node = std::array<int, 7>;

/// An index that means nothing where another one has this value: white noise has no time, no tissue
/// no length, a hand that is even no acts. It is then 0.
struct Detail {
  std::size_t detail;
  std::size_t of;
  int means_nothing_at;
};
constexpr Detail kDetails[] = {
    {kTime, kShare, kShares - 1}, {kLength, kTissue, 0}, {kAct, kStroke, 0}};
Node canonical(Node node) {
  for (const Detail& d : kDetails) {
    if (node[d.of] == d.means_nothing_at) {
      node[d.detail] = 0;
    }
  }
  return node;
}

Mixture mixture(const Node& node, const Prior& prior, bool in_time) {
  Mixture out;
  if (in_time) {
    const double least = std::log(prior.white_share_least / (1.0 - prior.white_share_least));
    const double log_odds = least * (1.0 - 2.0 * node[kShare] / (kShares - 1.0));
    out.white = node[kShare] == kShares - 1 ? 1.0 : 1.0 / (1.0 + std::exp(-log_odds));
    out.noise = {prior.shortest_s *
                     std::pow(prior.longest_s / prior.shortest_s, node[kTime] / 2 / (kTimes - 1.0)),
                 node[kTime] % 2 == 1};
  } else {
    out.white = 1.0;
  }
  out.tissue = ratio(node[kTissue]);
  out.tissue_over = {prior.tissue_lengths_m[static_cast<std::size_t>(node[kLength]) / 2],
                     node[kLength] % 2 == 1};
  out.stroke = ratio(node[kStroke]);
  out.model = ratio(node[kModel]);
  out.act = static_cast<Act>(node[kAct]);
  return out;
}

/// Log prior of a point of the grid, given s and the noise.
double log_prior_of(const Prior& prior, const Node& node, double s_m, double noise_m) {
  // The mass of a law between this SD and its neighbours.
  const auto mass = [&](int k, const auto& less) {
    const double low = k == 0 ? 0.0 : less(ratio_above(k - 1) * noise_m);
    const double high = k == kRatios - 1 ? 1.0 : less(ratio_above(k) * noise_m);
    return std::max(0.0, high - low);
  };
  const auto uneven = [&](double sd_m) { return varies_by_less(prior, sd_m, s_m); };
  const double tissue = mass(node[kTissue], uneven);
  const double strokes = prior.uneven_hand_share * mass(node[kStroke], uneven) +
                         (node[kStroke] == 0 ? 1.0 - prior.uneven_hand_share : 0.0);
  const double model =
      mass(node[kModel], [&](double sd_m) { return model_off_by_less(prior, sd_m); });
  // Times, lengths and kinds of act, where they mean something, are equally likely.
  const double times = node[kShare] == kShares - 1 ? 1.0 : 2.0 * kTimes;
  const double lengths =
      node[kTissue] == 0 ? 1.0 : 2.0 * static_cast<double>(prior.tissue_lengths_m.size());
  const double acts = node[kStroke] == 0 ? 1.0 : static_cast<double>(kActs);
  return std::log(tissue / lengths) + std::log(strokes / acts) + std::log(model / times) +
         log_density_of_noise(prior, noise_m);
}

// ---------------------------------------------------------------------------------------------
// Covariances: of the units' heights, and within a block, in units of the noise's variance.

double correlation_at(const Correlated& of, double apart) {
  const double x = apart / of.over;
  return of.smooth ? smooth_correlation(x) : std::exp(-x);
}

/// Mean correlation of a field over the bone between two units, by their halves.
double between(const Unit& a, const Unit& b, const Correlated& field) {
  const auto correlation = [&](Vec3 p, Vec3 q) { return correlation_at(field, (p - q).norm()); };
  constexpr double kFar = 4.0;
  const Vec3 middle_a = a.middle_m();
  const Vec3 middle_b = b.middle_m();
  const double longest_m2 = std::max((a.three_quarters_m - a.quarter_m).squared_norm(),
                                     (b.three_quarters_m - b.quarter_m).squared_norm());
  if ((middle_a - middle_b).squared_norm() > kFar * kFar * longest_m2) {
    return correlation(middle_a, middle_b);
  }
  return 0.25 *
         (correlation(a.quarter_m, b.quarter_m) + correlation(a.quarter_m, b.three_quarters_m) +
          correlation(a.three_quarters_m, b.quarter_m) +
          correlation(a.three_quarters_m, b.three_quarters_m));
}

/// Mean correlation between two units of a stroke of noise that wanders: the double integral of
/// `correlation_at` over the time of both.
double wandering(const Unit& a, const Unit& b, const Correlated& noise) {
  const double scale_1_s = (noise.smooth ? kSmoothScale : 1.0) / noise.over;
  const double length_a = std::max(1e-3, scale_1_s * (a.end_s - a.begin_s));
  const double length_b = std::max(1e-3, scale_1_s * (b.end_s - b.begin_s));
  if (&a == &b) {
    const double over = length_a * length_a;
    return noise.smooth
               ? 2.0 * (2.0 * length_a - 3.0 + (length_a + 3.0) * std::exp(-length_a)) / over
               : 2.0 * (length_a + std::expm1(-length_a)) / over;
  }
  const double gap = std::max(
      0.0, scale_1_s * (b.begin_s > a.begin_s ? b.begin_s - a.end_s : a.begin_s - b.end_s));
  // Moments of exp(-x) over either unit.
  const double a_0 = -std::expm1(-length_a);
  const double b_0 = -std::expm1(-length_b);
  const double a_1 = a_0 - length_a * std::exp(-length_a);
  const double b_1 = b_0 - length_b * std::exp(-length_b);
  return std::exp(-gap) / (length_a * length_b) *
         (noise.smooth ? (1.0 + gap) * a_0 * b_0 + a_1 * b_0 + a_0 * b_1 : a_0 * b_0);
}

using Across = Eigen::Matrix<double, kBlock - 1, kBlock>;
Across helmert() {
  Across h = Across::Zero();
  for (Eigen::Index k = 1; k < static_cast<Eigen::Index>(kBlock); ++k) {
    const double n = static_cast<double>(k);
    h.row(k - 1).head(k).setConstant(1.0 / std::sqrt(n * (n + 1.0)));
    h(k - 1, k) = -n / std::sqrt(n * (n + 1.0));
  }
  return h;
}

}  // namespace

struct Averaged::Units {
  const Observations& observations;
  const Prior& prior;
  const Hand& hand;
  std::vector<Unit> given;
  std::vector<std::size_t> members;   ///< of these, those of which enough belongs to the bone
  std::vector<Unit> units;            ///< the members
  std::vector<double> points;         ///< of each
  std::vector<std::uint32_t> wanted;  ///< points of all of them
  double within = 0.0;                ///< dimensions of what is within blocks
  bool has_areas = false;             ///< several, and fewer than strokes

  /// Of each unit's points, evenly, about `most_points`.
  Units(const Observations& measured, const Prior& known, const Hand& of, std::size_t most,
        std::size_t most_points)
      : observations(measured), prior(known), hand(of), given(units_of(measured, most)) {
    for (Unit& unit : given) {
      const std::size_t every = (unit.points.size() + most_points - 1) / most_points;
      std::vector<std::uint32_t> some;
      for (std::size_t k = every / 2; k < unit.points.size(); k += every) {
        some.push_back(unit.points[k]);
      }
      unit.points = std::move(some);
    }
  }

  /// Takes in what is new of the hand.
  void tell() {
    constexpr double kLeastOfUnit = 0.25;
    const std::vector<std::size_t> before = std::exchange(members, {});
    units.clear();
    points.clear();
    wanted.clear();
    for (std::size_t k = 0; k < given.size(); ++k) {
      const Unit& unit = given[k];
      double sum = 0.0;
      for (const std::uint32_t i : unit.points) {
        sum += hand.belongs[i];
      }
      if (sum >= kLeastOfUnit * static_cast<double>(unit.points.size())) {
        members.push_back(k);
        units.push_back(unit);
        points.push_back(sum);
        wanted.insert(wanted.end(), unit.points.begin(), unit.points.end());
      }
    }
    has_areas = !units.empty() && units.back().area > 0 && units.back().area < units.back().stroke;
    within =
        hand.blocks > 0.0 ? std::max(0.0, hand.inliers - static_cast<double>(units.size())) : 0.0;
    for (auto& [node, factor] : factors) {
      if (factor) {
        spare.push_back(std::move(factor->root));
      }
    }
    factors.clear();
    if (members != before) {
      fields.clear();
      wandering_noise.clear();
      acts.clear();
    }
  }

  /// Covariances, relative to the noise's variance, by what they are of; lower triangles.
  std::map<Correlated, Eigen::MatrixXd> fields;
  std::map<Correlated, Eigen::MatrixXd> wandering_noise;
  std::map<Act, Eigen::MatrixXd> acts;
  struct Factor {
    Eigen::MatrixXd root;  ///< Cholesky's, lower triangle
    double log_determinant = 0.0;
    // Of the deviations within a block, a dimension:
    double log_determinant_within = 0.0;
    double quadratic_within_m2 = 0.0;
  };
  std::map<Node, std::optional<Factor>> factors;
  /// Roots of an earlier hand: new memory would cost as much as the sums that are written to it.
  std::vector<Eigen::MatrixXd> spare;

  template <class Key, class Of>
  const Eigen::MatrixXd& kept(std::map<Key, Eigen::MatrixXd>& all, const Key& key, const Of& of) {
    auto [place, is_new] = all.try_emplace(key);
    if (is_new) {
      const auto m = static_cast<Eigen::Index>(units.size());
      place->second = Eigen::MatrixXd::Zero(m, m);
      for (Eigen::Index b = 0; b < m; ++b) {
        for (Eigen::Index a = b; a < m; ++a) {
          place->second(a, b) =
              of(units[static_cast<std::size_t>(a)], units[static_cast<std::size_t>(b)]);
        }
      }
    }
    return place->second;
  }

  const Eigen::MatrixXd& of_field(const Correlated& field) {
    return kept(fields, field, [&](const Unit& a, const Unit& b) { return between(a, b, field); });
  }

  /// Of the heights of acts.
  const Eigen::MatrixXd& of_act(Act act) {
    return kept(acts, act, [&](const Unit& a, const Unit& b) {
      switch (act) {
        case Act::kStroke:
          return a.stroke == b.stroke ? 1.0 : 0.0;
        case Act::kArea:
          return a.area == b.area ? 1.0 : 0.0;
        case Act::kWhile:
          break;
      }
      const double apart_s = 0.5 * std::abs(a.begin_s + a.end_s - b.begin_s - b.end_s);
      return std::exp(-apart_s / prior.while_s);
    });
  }

  /// Empty where the covariance is not positive definite.
  const std::optional<Factor>& factor(const Node& node) {
    auto [place, is_new] = factors.try_emplace(node);
    if (!is_new) {
      return place->second;
    }
    const Mixture mix = mixture(node, prior, observations.in_time);
    const Correlated model{prior.model_length_m, true};
    const auto m = static_cast<Eigen::Index>(units.size());
    std::vector<std::pair<double, const Eigen::MatrixXd*>> causes;
    if (mix.model > 0.0) {
      causes.emplace_back(mix.model * mix.model, &of_field(model));
    }
    if (mix.tissue > 0.0) {
      causes.emplace_back(mix.tissue * mix.tissue, &of_field(mix.tissue_over));
    }
    if (mix.white < 1.0) {
      causes.emplace_back(1.0 - mix.white,
                          &kept(wandering_noise, mix.noise, [&](const Unit& a, const Unit& b) {
                            return a.stroke == b.stroke ? wandering(a, b, mix.noise) : 0.0;
                          }));
    }
    if (mix.stroke > 0.0) {
      causes.emplace_back(mix.stroke * mix.stroke, &of_act(mix.act));
    }
    Factor out;
    Eigen::MatrixXd& c = out.root;
    if (!spare.empty()) {
      c.swap(spare.back());
      spare.pop_back();
    }
    c.resize(m, m);
    for (Eigen::Index k = 0; k < m; ++k) {
      auto column = c.col(k).tail(m - k);
      column.setZero();
      for (const auto& [variance, correlation] : causes) {
        column += variance * correlation->col(k).tail(m - k);
      }
      column(0) += mix.white / points[static_cast<std::size_t>(k)];
    }
    // In place: a copy would cost as much again in page faults, since hundreds are kept.
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> in_place(c);
    if (in_place.info() != Eigen::Success) {
      return place->second;
    }
    out.log_determinant = 2.0 * c.diagonal().array().log().sum();
    if (hand.blocks > 0.0) {
      std::array<double, kBlock> by_lag{};
      for (std::size_t lag = 0; lag < kBlock; ++lag) {
        by_lag[lag] = lag == 0 ? mix.white : 0.0;
        if (mix.white < 1.0) {
          by_lag[lag] += (1.0 - mix.white) * correlation_at(mix.noise, hand.lag_s[lag]);
        }
      }
      // Deviations from the mean: what is left in the seven directions across (1, ..., 1).
      Square covariance;
      for (std::size_t a = 0; a < kBlock; ++a) {
        for (std::size_t b = 0; b < kBlock; ++b) {
          covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
              by_lag[a > b ? a - b : b - a];
        }
      }
      static const Across across = helmert();
      using Small = Eigen::Matrix<double, kBlock - 1, kBlock - 1>;
      const Eigen::LLT<Small> root(across * covariance * across.transpose());
      const Small seen =
          across * Eigen::Map<const Square>(hand.products_m2.data()) * across.transpose();
      constexpr double kDimensions = kBlock - 1;
      out.log_determinant_within =
          2.0 * root.matrixLLT().diagonal().array().log().sum() / kDimensions;
      out.quadratic_within_m2 = root.solve(seen).trace() / kDimensions;
    }
    place->second = std::move(out);
    return place->second;
  }

  /// Means over the units.
  [[nodiscard]] Columns columns_of(const Touches& t) const {
    const auto m = static_cast<Eigen::Index>(units.size());
    Columns out = Columns::Zero(m, kColumns);
    for (Eigen::Index k = 0; k < m; ++k) {
      for (const std::uint32_t i : units[static_cast<std::size_t>(k)].points) {
        const Touches::Touch& touch = t.all[i];
        const Vec3 turned = touch.lever_m.cross(touch.out) / kLever_m;
        Eigen::Matrix<double, 1, kColumns> one;
        one.head<6>() << -touch.out.x, -touch.out.y, -touch.out.z, -turned.x, -turned.y, -turned.z;
        one(kValley) = touch.valley_m;
        one(kStandoff) = 1.0;
        // Of the place on the surface: the tip's own lever holds the height that it is to explain.
        one(kSize) = (touch.nearest_m - t.centre_m).dot(touch.out);
        one(kCurvature) = touch.curvature_1_m;
        one(kHeight) = touch.height_m;
        out.row(k) += hand.belongs[i] / points[static_cast<std::size_t>(k)] * one;
      }
    }
    // How deep valleys are has mean 0 and SD 1.
    auto valley = out.col(kValley);
    valley.array() -= valley.mean();
    valley /= std::max(1e-9, std::sqrt(valley.squaredNorm() / static_cast<double>(m)));
    return out;
  }
};

namespace {

// ---------------------------------------------------------------------------------------------
// The evidence of a point of the grid.

/// Nodes and weights of Gauss and Legendre's quadrature over [0, 1].
struct Quadrature {
  static constexpr std::size_t kNodes = 16;
  std::array<double, kNodes> at{};
  std::array<double, kNodes> weight{};
  Quadrature() {
    constexpr auto n = static_cast<double>(kNodes);
    for (std::size_t k = 0; k < kNodes; ++k) {
      double x = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.75) / (n + 0.5));
      double slope = 1.0;
      for (int round = 0; round < 50; ++round) {
        double p0 = 1.0, p1 = x;
        for (std::size_t j = 2; j <= kNodes; ++j) {
          const auto d = static_cast<double>(j);
          const double p2 = ((2.0 * d - 1.0) * x * p1 - (d - 1.0) * p0) / d;
          p0 = p1;
          p1 = p2;
        }
        slope = n * (x * p1 - p0) / (x * x - 1.0);
        x -= p1 / slope;
      }
      at[k] = 0.5 * (1.0 - x);
      weight[k] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};

}  // namespace

OverStandoff over_standoff(const Squares& squares, double freedom,
                           const std::function<double(double, double)>& log_prior) {
  // Where it is likely, as far as the square counts.
  constexpr double kWide = 4.5;
  const double at_m = squares.product / squares.standoff;
  const double least = squares.height - std::max(0.0, at_m) * squares.product;
  const double sd_m = std::sqrt(std::max(least, 1e-18) / freedom / squares.standoff);
  const double low_m = std::max(0.0, at_m - kWide * sd_m);
  const double high_m = at_m > 0.0 ? at_m + kWide * sd_m
                                   : at_m + std::sqrt(at_m * at_m + kWide * kWide * sd_m * sd_m);
  static const Quadrature quadrature;
  struct Node {
    double s_m = 0.0, log_value = 0.0, noise_m2 = 0.0;
  };
  std::array<Node, Quadrature::kNodes> nodes;
  double most = kNever;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    // Denser where the range begins, at which the prior of bare bone is narrow.
    const double t = quadrature.at[k];
    Node& node = nodes[k];
    node.s_m = low_m + (high_m - low_m) * t * t;
    const double width_m = (high_m - low_m) * 2.0 * t * quadrature.weight[k];
    const double sum_m2 = std::max(
        squares.height - 2.0 * node.s_m * squares.product + node.s_m * node.s_m * squares.standoff,
        1e-18);
    node.noise_m2 = sum_m2 / freedom;
    // The noise's SD by Laplace's method in its logarithm.
    node.log_value = -0.5 * freedom * (std::log(2.0 * std::numbers::pi * node.noise_m2) + 1.0) +
                     0.5 * std::log(std::numbers::pi / freedom) +
                     log_prior(node.s_m, std::sqrt(node.noise_m2)) + std::log(width_m);
    most = std::max(most, node.log_value);
  }
  OverStandoff out;
  if (!(most > kNever)) {
    out.log_integral = kNever;
    return out;
  }
  double sum = 0.0;
  double square_m2 = 0.0;
  for (const Node& node : nodes) {
    const double p = std::exp(node.log_value - most);
    sum += p;
    out.mean_m += p * node.s_m;
    square_m2 += p * node.s_m * node.s_m;
    out.noise_m2 += p * node.noise_m2;
  }
  out.log_integral = most + std::log(sum);
  out.mean_m /= sum;
  out.noise_m2 /= sum;
  out.variance_m2 = std::max(0.0, square_m2 / sum - out.mean_m * out.mean_m);
  return out;
}

/// What a point of the grid says of the heights at a pose.
struct Answer {
  Part part;
  double log_weight = kNever;              ///< evidence and prior, the pose integrated
  Eigen::Matrix<double, kMoved, 1> moved;  ///< mean of the columns that are integrated
  /// Covariance of these, and of the standoff behind them, m^2.
  Eigen::Matrix<double, kMoved + 1, kMoved + 1> spread_m2;
  double lifts_m2 = 0.0;  ///< what scatter takes off a height, by curvature
  // Where all is asked for:
  double log_here = kNever;  ///< the pose being the one that the heights are of
  double log_size = kNever;  ///< the pose and the size integrated
  double size = 0.0, size_variance = 0.0;
};

namespace {

enum class Asked : std::uint8_t { kWeight, kAll };

/// From the columns' units to a step's: m and rad.
Vector6 step_scale() {
  Vector6 scale;
  scale << 1.0, 1.0, 1.0, 1.0 / kLever_m, 1.0 / kLever_m, 1.0 / kLever_m;
  return scale;
}

/// `whitened`: the columns, by the factor of this node.
std::optional<Answer> concluded(const Averaged::Units& units, const Averaged::Units::Factor& factor,
                                const Columns& whitened, const Node& node, Asked asked) {
  const Prior& prior = units.prior;
  const Mixture of = mixture(node, prior, units.observations.in_time);
  Products all = whitened.transpose() * whitened;
  // Tissue that is thick in valleys, by an unknown amount of the size of its unevenness.
  constexpr double kNone = 1e-6;
  const double valley = std::max(kNone, of.tissue);
  all(kValley, kValley) += 1.0 / (valley * valley);
  using Moved = Eigen::Matrix<double, kMoved, kMoved>;
  const Eigen::LLT<Moved> llt(all.topLeftCorner<kMoved, kMoved>());
  if (llt.info() != Eigen::Success || !all.allFinite()) {
    return std::nullopt;
  }
  const Vector6 pivots = llt.matrixLLT().diagonal().head<6>();
  constexpr double kLeastVisible = 1e-4;  // of the most visible motion's SD
  if (!(pivots.minCoeff() > kLeastVisible * pivots.maxCoeff())) {
    return std::nullopt;
  }
  // Standoff, size, curvature and height, less what pose and valleys explain.
  const Eigen::Matrix<double, kMoved, 4> solved_four = llt.solve(all.topRightCorner<kMoved, 4>());
  const Eigen::Matrix4d left_four =
      all.bottomRightCorner<4, 4>() - all.topRightCorner<kMoved, 4>().transpose() * solved_four;
  // The blocks are a sample of all deviations within rows: what they say a dimension holds for all.
  const double inside_m2 = units.within * factor.quadratic_within_m2;
  const double dimensions = static_cast<double>(units.units.size()) + units.within;
  const double freedom = dimensions - 6.0;
  if (!(freedom > 1.0) || !(left_four(0, 0) > 0.0)) {
    return std::nullopt;
  }
  // Scatter about a curved surface lifts the points by half their variance times its curvature.
  const double lifts_m2 =
      0.5 * (left_four(3, 3) - left_four(0, 3) * left_four(0, 3) / left_four(0, 0) + inside_m2) /
      freedom;
  Eigen::Matrix<double, 4, 3> kept = Eigen::Matrix<double, 4, 3>::Zero();
  kept(0, 0) = kept(1, 1) = kept(3, 2) = 1.0;
  kept(2, 2) = -lifts_m2;
  const Eigen::Matrix3d left = kept.transpose() * left_four * kept;
  const Eigen::Matrix<double, kMoved, 3> solved = solved_four * kept;

  const auto log_prior = [&](double s_m, double noise_m) {
    return log_density_of_standoff(prior, s_m) + log_prior_of(prior, node, s_m, noise_m);
  };
  const double fixed =
      units.hand.log_outliers -
      0.5 * (factor.log_determinant + units.within * factor.log_determinant_within);
  const double log_nuisance = std::log(valley);
  const double log_pose = llt.matrixLLT().diagonal().array().log().sum() + log_nuisance;
  const OverStandoff over =
      over_standoff({left(2, 2) + inside_m2, left(0, 2), left(0, 0)}, freedom, log_prior);
  Answer out;
  out.log_weight = over.log_integral + fixed - log_pose;
  if (asked == Asked::kAll) {
    // The pose held, valleys integrated.
    const double held = all(kValley, kValley);
    const Eigen::RowVector4d across = all.block<1, 4>(kValley, kStandoff);
    const Eigen::Matrix3d raw =
        kept.transpose() * (all.bottomRightCorner<4, 4>() - across.transpose() * across / held) *
        kept;
    out.log_here =
        fixed - 0.5 * std::log(held) - log_nuisance +
        over_standoff({raw(2, 2) + inside_m2, raw(0, 2), raw(0, 0)}, dimensions, log_prior)
            .log_integral;
    // The size has a normal prior: integrated, it takes its part of the squares.
    const double precision = over.noise_m2 / (prior.size_sd * prior.size_sd);
    const double information = left(1, 1) + precision;
    const OverStandoff sized = over_standoff(
        {left(2, 2) - left(1, 2) * left(1, 2) / information + inside_m2,
         left(0, 2) - left(1, 2) * left(0, 1) / information,
         // Over a flat part the points can't tell a size from a standoff.
         std::max(left(0, 0) - left(0, 1) * left(0, 1) / information, 1e-9 * left(0, 0))},
        freedom, log_prior);
    out.log_size = sized.log_integral + fixed - log_pose + 0.5 * std::log(precision / information);
    const double by_standoff = left(0, 1) / information;
    out.size = left(1, 2) / information - sized.mean_m * by_standoff;
    out.size_variance =
        sized.noise_m2 / information + sized.variance_m2 * by_standoff * by_standoff;
  }
  out.part.of = of;
  out.part.noise_m = std::sqrt(over.noise_m2);
  out.part.standoff_m = over.mean_m;
  out.moved = solved.col(2) - over.mean_m * solved.col(0);
  out.lifts_m2 = lifts_m2;
  Eigen::Matrix<double, kMoved + 1, 1> by_standoff;
  by_standoff << -solved.col(0), 1.0;
  out.spread_m2 = over.variance_m2 * by_standoff * by_standoff.transpose();
  out.spread_m2.topLeftCorner<kMoved, kMoved>() += over.noise_m2 * llt.solve(Moved::Identity());
  Eigen::Map<Vector6> step(out.part.step.data());
  step = step_scale().asDiagonal() * out.moved.head<6>();
  Eigen::Map<Rows6> covariance(out.part.covariance.data());
  covariance =
      step_scale().asDiagonal() * out.spread_m2.topLeftCorner<6, 6>() * step_scale().asDiagonal();
  if (!std::isfinite(out.log_weight) || !step.allFinite()) {
    return std::nullopt;
  }
  return out;
}

std::optional<Answer> answer(Averaged::Units& units, const Columns& columns, const Node& node,
                             Asked asked) {
  const auto& factor = units.factor(node);
  if (!factor) {
    return std::nullopt;
  }
  const Columns whitened = factor->root.triangularView<Eigen::Lower>().solve(columns);
  return concluded(units, *factor, whitened, node, asked);
}

/// Points of the grid with their answers.
using Answers = std::vector<std::pair<Node, Answer>>;

double most_of(const Answers& answers) {
  double most = kNever;
  for (const auto& [node, a] : answers) {
    most = std::max(most, a.log_weight);
  }
  return most;
}

/// How many values each index of a point of the grid has.
Node size_of_grid(const Averaged::Units& units) {
  const bool in_time = units.observations.in_time;
  return {in_time ? kShares : 1,
          in_time ? 2 * kTimes : 1,
          kRatios,
          2 * static_cast<int>(units.prior.tissue_lengths_m.size()),
          kRatios,
          kRatios,
          units.has_areas ? kActs : 1};
}

/// The points of the grid next to one.
std::vector<Node> neighbours_of(const Node& node, const Node& size) {
  std::vector<Node> out;
  for (std::size_t k = 0; k < node.size(); ++k) {
    const bool means_nothing = std::any_of(
        std::begin(kDetails), std::end(kDetails),
        [&](const Detail& d) { return d.detail == k && node[d.of] == d.means_nothing_at; });
    if (means_nothing) {
      continue;
    }
    // Every other length, or time, is of the same smoothness.
    for (const int by :
         k == kLength || k == kTime ? std::vector<int>{-2, -1, 1, 2} : std::vector<int>{-1, 1}) {
      Node next = node;
      next[k] += by;
      if (next[k] < 0 || next[k] >= size[k]) {
        continue;
      }
      out.push_back(canonical(next));
      for (const Detail& d : kDetails) {
        if (d.of == k && node[k] == d.means_nothing_at) {
          // It begins to mean something.
          for (next[d.detail] = 0; next[d.detail] < size[d.detail]; ++next[d.detail]) {
            out.push_back(next);
          }
        }
      }
      if (k == kTime && std::abs(by) == 1) {
        // Noise of the other smoothness fits best with another white share.
        for (const int share : {node[kShare] - 1, node[kShare] + 1}) {
          if (share >= 0 && share < size[kShare]) {
            Node diagonal = next;
            diagonal[kShare] = share;
            out.push_back(canonical(diagonal));
          }
        }
      }
    }
  }
  return out;
}

/// A few points of all the grid.
std::vector<Node> scattered(const Node& size) {
  std::vector<Node> out;
  const bool in_time = size[kShare] > 1;
  for (const int share : in_time ? std::vector<int>{1, 3, 5} : std::vector<int>{0}) {
    for (const int time : in_time ? std::vector<int>{6, 7, 12} : std::vector<int>{0}) {
      const Node even{share, time};
      out.push_back(even);
      // Each cause of unevenness starts small and large. Were one alone to start large, it would be
      // the likeliest at once, and from the others, which are then far less likely, nothing is
      // explored.
      for (const int much : {2, 4}) {
        for (const std::size_t uneven : {kTissue, kStroke, kModel}) {
          out.push_back(even);
          out.back()[uneven] = much;
          if (uneven == kTissue) {
            out.back()[kLength] = 3;
          }
        }
        for (int act = 1; act < size[kAct]; ++act) {
          out.push_back(even);
          out.back()[kStroke] = much;
          out.back()[kAct] = act;
        }
      }
    }
  }
  return out;
}

/// The points of the grid that have weight, the likeliest first, at most `kKept` of them: from a
/// few starts, the neighbours of whatever is likely. Empty where a good many of them leave the log
/// evidence far below `least`.
std::vector<Node> explored(Averaged::Units& units, const Columns& columns,
                           std::span<const Node> starts, double least) {
  constexpr double kLikely = 6.0;
  // Only points this close to the likeliest have their neighbours looked at. With 6 the results
  // that were measured stay the same, and it takes 1.2 to 1.8 times as long.
  constexpr double kExpanded = 2.0;
  constexpr std::size_t kMost = 700;
  constexpr std::size_t kKept = 48;
  constexpr std::size_t kGoodMany = 100;
  constexpr double kFarBelow = 40.0;
  const Node size = size_of_grid(units);
  std::set<Node> seen;
  std::vector<std::pair<double, Node>> found;
  std::priority_queue<std::pair<double, Node>> likely;
  double most = kNever;
  const auto look = [&](const Node& node) {
    if (seen.size() >= kMost || !seen.insert(node).second) {
      return;
    }
    if (const auto a = answer(units, columns, node, Asked::kWeight)) {
      most = std::max(most, a->log_weight);
      likely.emplace(a->log_weight, node);
      found.emplace_back(-a->log_weight, node);
    }
  };
  for (const Node& node : starts) {
    look(node);
  }
  while (!likely.empty()) {
    const auto [log_weight, node] = likely.top();
    likely.pop();
    if (log_weight < most - kExpanded) {
      break;
    }
    if (seen.size() >= kGoodMany && most < least - kFarBelow) {
      return {};
    }
    for (const Node& next : neighbours_of(node, size)) {
      look(next);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<Node> out;
  for (const auto& [less, node] : found) {
    if (out.size() < kKept && -less > most - kLikely) {
      out.push_back(node);
    }
  }
  return out;
}

Answers answers_at(Averaged::Units& units, const Touches& t, std::span<const Node> nodes) {
  const Columns columns = units.columns_of(t);
  Answers out;
  for (const Node& node : nodes) {
    if (auto found = answer(units, columns, node, Asked::kAll)) {
      out.emplace_back(node, *found);
    }
  }
  return out;
}

Vector6 mean_step(const Answers& answers) {
  const double most = most_of(answers);
  double sum = 0.0;
  Vector6 mean = Vector6::Zero();
  for (const auto& [node, a] : answers) {
    const double p = std::exp(a.log_weight - most);
    sum += p;
    mean += p * Eigen::Map<const Vector6>(a.part.step.data());
  }
  return mean / sum;
}

double log_here(const Answers& answers) {
  double sum = kNever;
  for (const auto& [node, a] : answers) {
    sum = log_sum(sum, a.log_here);
  }
  return sum;
}

/// Vertebra from World after a step of the points about their centre.
Transform<Vertebra, World> stepped(const Touches& t, const Vector6& step) {
  const Mat3 turn = rotation_from_vector({step(3), step(4), step(5)});
  const Mat3 rotation = orthonormalized(turn * t.from_world.rotation());
  const Vec3 centre = t.centre_m + Vec3{step(0), step(1), step(2)};
  // The centre of the points goes along.
  const Vec3 centre_in_world = (t.from_world.inverse() * Point<Vertebra>{t.centre_m}).v;
  return {rotation, centre - rotation * centre_in_world};
}

/// `answers`: the likeliest first; their weights are set, and their steps from the mean.
Posterior assembled(const Touches& t, const Hand& hand, Answers& answers) {
  Posterior out;
  out.centre_m = t.centre_m;
  double all = kNever, with_size = kNever;
  for (const auto& [node, a] : answers) {
    all = log_sum(all, a.log_weight);
    with_size = log_sum(with_size, a.log_size);
  }
  out.log_evidence = all;
  out.size_log_evidence = with_size - all;
  double size = 0.0, size_square = 0.0;
  Vector6 mean = Vector6::Zero();
  double uneven_m2 = 0.0;
  for (auto& [node, a] : answers) {
    a.part.weight = std::exp(a.log_weight - all);
    const double p = std::exp(a.log_size - with_size);
    size += p * a.size;
    size_square += p * (a.size_variance + a.size * a.size);
    mean += a.part.weight * Eigen::Map<const Vector6>(a.part.step.data());
    out.noise_m += a.part.weight * a.part.noise_m;
    out.standoff_m += a.part.weight * a.part.standoff_m;
    const Mixture& of = a.part.of;
    const double fields = of.tissue * of.tissue + of.model * of.model;
    const double strokes = of.stroke * of.stroke;
    uneven_m2 += a.part.weight * a.part.noise_m * a.part.noise_m * (fields + strokes);
    out.across_strokes += a.part.weight * fields / (fields + strokes + 1.0);
  }
  out.size = std::exp(size);
  out.size_sd = std::sqrt(std::max(0.0, size_square - size * size));
  out.uneven_m = std::sqrt(uneven_m2);
  Matrix6 covariance = Matrix6::Zero();
  for (auto& [node, a] : answers) {
    Eigen::Map<Vector6> step(a.part.step.data());
    step -= mean;
    covariance += a.part.weight *
                  (Eigen::Map<const Rows6>(a.part.covariance.data()) + step * step.transpose());
    out.parts.push_back(a.part);
  }
  Eigen::Map<Rows6>(out.covariance.data()) = covariance;
  out.world_from_vertebra = stepped(t, mean).inverse();
  out.hand = hand;
  return out;
}

/// The mean heights of the strokes' units by the likeliest points of the grid, without noise.
std::vector<EstimatedHeight> heights_of(Averaged::Units& units, const Touches& t,
                                        const Answers& likeliest_first) {
  constexpr std::size_t kFew = 3;  // the others would not change the picture
  const Columns columns = units.columns_of(t);
  const auto n = columns.rows();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
  double sum = 0.0;
  for (const auto& [node, a] :
       std::span(likeliest_first).first(std::min(kFew, likeliest_first.size()))) {
    const auto& factor = units.factor(node);
    const Mixture& of = a.part.of;
    const Eigen::VectorXd valleys = a.moved(kValley) * columns.col(kValley);
    const Eigen::VectorXd left = columns.col(kHeight) - a.lifts_m2 * columns.col(kCurvature) -
                                 columns.leftCols<kMoved>() * a.moved -
                                 a.part.standoff_m * columns.col(kStandoff);
    const auto root = factor->root.triangularView<Eigen::Lower>();
    const Eigen::VectorXd solved = root.adjoint().solve(root.solve(left));
    // What the covariance of the fields, and of the strokes' own heights, makes of what is left.
    Eigen::VectorXd fields = Eigen::VectorXd::Zero(n);
    const auto add = [&](double sd, const Eigen::MatrixXd& correlation) {
      fields += sd * sd * (correlation.selfadjointView<Eigen::Lower>() * solved);
    };
    add(of.tissue, units.of_field(of.tissue_over));
    add(of.model, units.of_field({units.prior.model_length_m, true}));
    add(of.stroke, units.of_act(of.act));
    const double p = std::exp(a.log_weight - likeliest_first.front().second.log_weight);
    sum += p;
    mean += p * (valleys + fields) + Eigen::VectorXd::Constant(n, p * a.part.standoff_m);
  }
  std::vector<EstimatedHeight> out;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Unit& unit = units.units[static_cast<std::size_t>(k)];
    out.push_back({t.from_world * Point<World>{unit.middle_m()}, mean(k) / sum});
  }
  return out;
}

/// How an error of the model has moved the mean pose, over all points of the grid. `mean`: what
/// `assembled` made of them.
ModelShare model_share_of(Averaged::Units& units, const Touches& t, const Answers& answers,
                          const Posterior& mean) {
  const Correlated field{units.prior.model_length_m, true};
  const Eigen::MatrixXd correlation = units.of_field(field).selfadjointView<Eigen::Lower>();
  const Columns columns = units.columns_of(t);
  using Gain = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  Gain gain = Gain::Zero(6, columns.rows());
  Matrix6 of_model = Matrix6::Zero();
  for (const auto& [node, a] : answers) {
    // The step is linear in the heights; valleys and standoff are estimated along with it.
    const auto root = units.factor(node)->root.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd solved = root.adjoint().solve(root.solve(columns.leftCols<kMoved + 1>()));
    const double noise_m2 = a.part.noise_m * a.part.noise_m;
    const Gain at =
        step_scale().asDiagonal() * (a.spread_m2.topRows<6>() / noise_m2 * solved.transpose());
    gain += a.part.weight * at;
    const double model_m2 = noise_m2 * a.part.of.model * a.part.of.model;
    of_model += a.part.weight * model_m2 * (at * correlation * at.transpose());
  }
  ModelShare out;
  for (Eigen::Index k = 0; k < gain.cols(); ++k) {
    const Unit& unit = units.units[static_cast<std::size_t>(k)];
    out.places_m.push_back((t.from_world * Point<World>{unit.middle_m()}).v);
    // The error moved the fitted pose by its gain; the true pose is that much back.
    Eigen::Map<Vector6>(out.step.emplace_back().data()) = -gain.col(k);
  }
  Eigen::Map<Rows6>(out.rest.data()) = Eigen::Map<const Rows6>(mean.covariance.data()) - of_model;
  return out;
}

/// Gauss-Newton steps to where the pose is likeliest, averaged over these points of the grid. A
/// step that makes it less likely is halved, then refused; ended when neither translation nor
/// rotation moves.
void descend(Averaged::Units& units, const BoneSurface& bone, std::span<const Node> nodes,
             int most_steps, double stands_m, Touches& here) {
  constexpr int kMaxHalvings = 4;
  Answers answers = answers_at(units, here, nodes);
  for (int k = 0; k < most_steps && !answers.empty(); ++k) {
    Vector6 step = mean_step(answers);
    const double before = log_here(answers);
    bool better = false;
    for (int halved = 0; halved <= kMaxHalvings; ++halved, step *= 0.5) {
      Touches there =
          touches_at(units.observations, bone, stepped(here, step), units.wanted, &here);
      Answers then = answers_at(units, there, nodes);
      better = !then.empty() && log_here(then) >= before;
      if (better) {
        here = std::move(there);
        answers = std::move(then);
        break;
      }
    }
    if (!better ||
        (step.head<3>().norm() < stands_m && kLever_m * step.tail<3>().norm() < stands_m)) {
      return;
    }
  }
}

}  // namespace

Averaged::Averaged(const Observations& observations, const Prior& prior)
    : observations_(observations),
      prior_(prior),
      few_(std::make_unique<Units>(observations, prior, hand_, 64, 6)),
      all_(std::make_unique<Units>(observations, prior, hand_, kUnits,
                                   std::max<std::size_t>(1, observations.strokes.size()))),
      blocks_(blocks_of(observations, all_->given)) {}
Averaged::~Averaged() = default;

double Averaged::rows() const { return static_cast<double>(std::min(kUnits, all_->given.size())); }

void Averaged::tell(Hand hand) {
  hand_ = std::move(hand);
  few_->tell();
  all_->tell();
}

std::optional<Posterior> posterior_of(Averaged& averaged, const BoneSurface& bone,
                                      const Transform<World, Vertebra>& start, Effort effort,
                                      bool tells_hand, double least) {
  constexpr double kStands_m = 3e-6;
  constexpr double kNearlyStands_m = 3e-5;
  constexpr double kAgain_m = 0.0001;
  const Observations& observations = averaged.observations();
  // The likeliest points of the grid steer the descent.
  const auto steering = [](std::span<const Node> nodes) {
    return nodes.first(std::min<std::size_t>(4, nodes.size()));
  };
  Transform<Vertebra, World> from_world = start.inverse();
  const bool full = effort == Effort::kFull;
  const int most_rounds = full ? 3 : 1;
  // What the points tell of the hand, and where the grid has weight, is looked at where the descent
  // begins and, if that was elsewhere, again where it ends.
  Touches here;
  Touches all;  // where the hand is told
  std::vector<Node> nodes;
  for (int round = 0; round < most_rounds; ++round) {
    if (tells_hand) {
      all = touches_at(observations, bone, from_world, {}, nullptr);
      averaged.tell(hand_at(observations, averaged.prior(), averaged.blocks(), all));
    }
    Averaged::Units& few = averaged.few();
    here = touches_at(observations, bone, from_world, few.wanted, tells_hand ? &all : nullptr);
    nodes = explored(few, few.columns_of(here), scattered(size_of_grid(few)), least);
    if (nodes.empty()) {
      return std::nullopt;
    }
    const Vec3 before_m = here.centre_m;
    const Mat3 before = from_world.rotation();
    descend(few, bone, steering(nodes), 12, full ? kStands_m : kNearlyStands_m, here);
    from_world = here.from_world;
    if ((here.centre_m - before_m).norm() < kAgain_m &&
        kLever_m * rotation_angle_rad(from_world.rotation(), before) < kAgain_m) {
      break;
    }
  }
  Averaged::Units& units = full ? averaged.all() : averaged.few();
  if (full) {
    here = touches_at(observations, bone, from_world, {}, tells_hand ? &all : &here);
    // Rows that are shorter see shorter fields.
    nodes = explored(units, units.columns_of(here), nodes, kNever);
    descend(units, bone, steering(nodes), 3, kNearlyStands_m, here);
  }
  Answers answers = answers_at(units, here, nodes);
  if (answers.empty()) {
    return std::nullopt;
  }
  std::stable_sort(answers.begin(), answers.end(), [](const auto& a, const auto& b) {
    return a.second.log_weight > b.second.log_weight;
  });
  std::vector<EstimatedHeight> heights;
  if (full && tells_hand) {
    heights = heights_of(units, here, answers);
  }
  Posterior out = assembled(here, averaged.hand(), answers);
  out.heights = std::move(heights);
  if (full && tells_hand) {
    out.model_share = model_share_of(units, here, answers, out);
  }
  return out;
}

}  // namespace orthonav::nav::posterior

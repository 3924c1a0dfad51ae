#include "nav/posterior/posterior.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <map>
#include <numbers>
#include <queue>

#include "nav/statistics/median.h"
#include "nav/statistics/whitened_system.h"

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

/// What every pose has in common.
struct Problem {
  const Observations& observations;
  const BoneSurface& bone;
  const Prior& prior;
  Vec3 centre_in_world_m;
  std::vector<std::array<std::uint32_t, kBlock>> blocks;
  const Hand* hand = nullptr;
};

using Square = Eigen::Matrix<double, kBlock, kBlock>;

/// Every point at a pose.
struct Touches {
  Transform<Vertebra, World> from_world;
  Vec3 centre_m;  ///< of the points, in the model's frame
  struct Touch {
    Vec3 lever_m;  ///< from the centre
    Vec3 out;
    Vec3 nearest_m;
    double height_m = 0.0;
    double belongs = 1.0;
    /// Sum of the bone's curvatures there, convex positive: points that scatter about a curved
    /// surface lie, on average, half of it times their variance off the surface.
    double curvature_1_m = 0.0;
  };
  std::vector<Touch> all;
  double spread_m = 0.0;
  double log_outliers = 0.0;  ///< of the points as members of the bone, or not
  double inliers = 0.0;
};

/// Which points belong to the bone: those of the hand that is given or, by a mixture of a Gaussian
/// about the mean height and an even density, those at this pose (expectation maximization, from
/// the median).
void tell_outliers(const Problem& problem, Touches& t) {
  const Prior& prior = problem.prior;
  constexpr int kRounds = 8;
  constexpr double kLeast_m = 0.0001;
  constexpr double kMost_m = 0.004;
  constexpr double kSdByMedian = 1.4826;
  std::vector<double> heights;
  for (const auto& touch : t.all) {
    heights.push_back(touch.height_m);
  }
  double mean_m = median(heights);
  for (double& h : heights) {
    h = std::abs(h - mean_m);
  }
  double sd_m = std::clamp(kSdByMedian * median(std::move(heights)), kLeast_m, kMost_m);
  // Mean and SD of the points that belong to the bone; false where too few do.
  const auto average = [&] {
    double sum = 0.0, sum_m = 0.0, sum_m2 = 0.0;
    for (const auto& touch : t.all) {
      sum += touch.belongs;
      sum_m += touch.belongs * touch.height_m;
      sum_m2 += touch.belongs * touch.height_m * touch.height_m;
    }
    if (!(sum > 6.0)) {
      return false;
    }
    mean_m = sum_m / sum;
    sd_m = std::clamp(std::sqrt(std::max(0.0, sum_m2 / sum - mean_m * mean_m)), kLeast_m, kMost_m);
    return true;
  };
  const double outside = prior.outlier_share / prior.outlier_range_m;
  if (problem.hand != nullptr) {
    for (std::size_t i = 0; i < t.all.size(); ++i) {
      t.all[i].belongs = problem.hand->belongs[i];
    }
    average();
  } else {
    for (int round = 0; round < kRounds; ++round) {
      for (auto& touch : t.all) {
        const double z = (touch.height_m - mean_m) / sd_m;
        const double inside = (1.0 - prior.outlier_share) * std::exp(-0.5 * z * z) /
                              (sd_m * std::sqrt(2.0 * std::numbers::pi));
        touch.belongs = inside / (inside + outside);
      }
      if (!average()) {
        break;
      }
    }
  }
  t.spread_m = sd_m;
  t.log_outliers = t.inliers = 0.0;
  const auto entropy = [](double p) { return p > 1e-300 ? -p * std::log(p) : 0.0; };
  for (const auto& touch : t.all) {
    const double z = touch.belongs;
    t.inliers += z;
    t.log_outliers += z * std::log1p(-prior.outlier_share) + (1.0 - z) * std::log(outside) +
                      entropy(z) + entropy(1.0 - z);
  }
}

Touches touches_at(const Problem& problem, const Transform<Vertebra, World>& from_world,
                   const Touches* hint) {
  Touches out;
  out.from_world = from_world;
  out.centre_m = (from_world * Point<World>{problem.centre_in_world_m}).v;
  out.all.resize(problem.observations.strokes.size());
  for (std::size_t i = 0; i < out.all.size(); ++i) {
    const Vec3 p = (from_world * problem.observations.strokes[i].tip).v;
    const auto place =
        problem.bone.near(p, hint != nullptr ? hint->all[i].nearest_m : problem.bone.place_near(p));
    Touches::Touch& touch = out.all[i];
    touch.lever_m = p - out.centre_m;
    touch.out = place.out;
    touch.nearest_m = place.nearest_m;
    touch.height_m = place.distance_m - problem.observations.tip_radius_m;
  }
  tell_outliers(problem, out);
  const std::size_t every = std::max<std::size_t>(1, out.all.size() / 200);
  for (std::size_t i = 0; i < out.all.size(); ++i) {
    out.all[i].curvature_1_m =
        hint != nullptr  ? hint->all[i].curvature_1_m
        : i % every == 0 ? problem.bone.curvature_1_m(out.all[i].nearest_m, out.all[i].out,
                                                      std::numbers::sqrt2 * out.spread_m)
                         : out.all[i - 1].curvature_1_m;
  }
  return out;
}

constexpr std::size_t kColumns = 10;  // pose, standoff, size, curvature, height

/// The units' mean heights, and how points scatter within blocks.
struct Rows {
  std::vector<const Unit*> units;  ///< those of which enough belongs to the bone
  std::vector<double> points;      ///< of each
  std::vector<std::array<double, kColumns>> columns;
  Hand hand;
  double within = 0.0;  ///< dimensions of what is within blocks
  double log_outliers = 0.0;
};

/// Of the blocks all of whose points belong to the bone.
Hand hand_of(const Problem& problem, const Touches& t) {
  constexpr double kBelongs = 0.5;
  Hand out;
  Eigen::Map<Square> products(out.products_m2.data());
  for (const auto& block : problem.blocks) {
    Eigen::Matrix<double, kBlock, 1> heights;
    bool all = true;
    for (std::size_t k = 0; k < kBlock; ++k) {
      heights(static_cast<Eigen::Index>(k)) = t.all[block[k]].height_m;
      all = all && t.all[block[k]].belongs > kBelongs;
    }
    if (!all) {
      continue;
    }
    heights.array() -= heights.mean();
    products += heights * heights.transpose();
    out.blocks += 1.0;
    for (std::size_t lag = 1; lag < kBlock; ++lag) {
      for (std::size_t k = 0; k + lag < kBlock; ++k) {
        const StrokePoint& a = problem.observations.strokes[block[k]];
        const StrokePoint& b = problem.observations.strokes[block[k + lag]];
        out.lag_s[lag] += (b.time_s - a.time_s) / static_cast<double>(kBlock - lag);
        out.lag_m[lag] += (b.tip - a.tip).norm() / static_cast<double>(kBlock - lag);
      }
    }
  }
  if (out.blocks > 0.0) {
    products /= out.blocks;
    for (std::size_t lag = 1; lag < kBlock; ++lag) {
      out.lag_s[lag] /= out.blocks;
      out.lag_m[lag] /= out.blocks;
    }
  }
  return out;
}

Rows rows_of(const Problem& problem, std::span<const Unit> units, const Touches& t) {
  constexpr double kLeastOfUnit = 0.25;
  Rows rows;
  rows.log_outliers = problem.prior.point_counts * t.log_outliers;
  for (const Unit& unit : units) {
    double sum = 0.0;
    std::array<double, kColumns> mean{};
    for (const std::uint32_t i : unit.points) {
      const Touches::Touch& touch = t.all[i];
      const Vec3 turned = touch.lever_m.cross(touch.out) / kLever_m;
      const std::array<double, kColumns> one = {
          -touch.out.x, -touch.out.y, -touch.out.z, -turned.x, -turned.y, -turned.z,
          // Of the place on the surface: the tip's own lever holds the height that it is to
          // explain.
          1.0, (touch.nearest_m - t.centre_m).dot(touch.out), touch.curvature_1_m, touch.height_m};
      sum += touch.belongs;
      for (std::size_t k = 0; k < kColumns; ++k) {
        mean[k] += touch.belongs * one[k];
      }
    }
    if (sum < kLeastOfUnit * static_cast<double>(unit.points.size())) {
      continue;
    }
    for (double& m : mean) {
      m /= sum;
    }
    rows.units.push_back(&unit);
    rows.points.push_back(sum);
    rows.columns.push_back(mean);
  }
  rows.hand = problem.hand != nullptr ? *problem.hand : hand_of(problem, t);
  if (rows.hand.blocks > 0.0) {
    rows.within = problem.prior.point_counts *
                  std::max(0.0, t.inliers - static_cast<double>(rows.units.size()));
  }
  return rows;
}

// ---------------------------------------------------------------------------------------------
// Covariances: of the units' heights, and within a block, in units of the noise's variance.

/// Correlation of a field, which falls to 1/e over its length: exponential where it is rough, and
/// Matern's of order 3/2 where it is smooth.
struct Field {
  double length_m = 0.0;
  bool smooth = false;
  [[nodiscard]] double at(double distance_m) const {
    constexpr double kByLength = 2.146193;  // (1 + x) exp(-x) = 1/e
    const double x = distance_m / length_m;
    return smooth ? (1.0 + kByLength * x) * std::exp(-kByLength * x) : std::exp(-x);
  }
  friend auto operator<=>(const Field&, const Field&) = default;
};

/// Its mean between two units, by their halves.
double between(const Unit& a, const Unit& b, const Field& field) {
  const auto correlation = [&](Vec3 p, Vec3 q) { return field.at((p - q).norm()); };
  constexpr double kFar = 4.0;
  const Vec3 middle_a = 0.5 * (a.quarter_m + a.three_quarters_m);
  const Vec3 middle_b = 0.5 * (b.quarter_m + b.three_quarters_m);
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

/// Mean correlation between two units of a stroke of noise that wanders.
double wandering(const Unit& a, const Unit& b, double time_s) {
  const double length_a = std::max(1e-6, (a.end_s - a.begin_s) / time_s);
  const double length_b = std::max(1e-6, (b.end_s - b.begin_s) / time_s);
  if (&a == &b) {
    return 2.0 * (length_a + std::expm1(-length_a)) / (length_a * length_a);
  }
  const double gap =
      std::max(0.0, b.begin_s > a.begin_s ? b.begin_s - a.end_s : a.begin_s - b.end_s) / time_s;
  return std::expm1(-length_a) * std::expm1(-length_b) / (length_a * length_b) * std::exp(-gap);
}

class Covariances {
 public:
  explicit Covariances(const Rows& rows, double model_length_m)
      : rows_(rows), model_length_m_(model_length_m) {}

  /// Whitened columns of the rows; false where the covariance is not positive definite.
  bool whiten(const Mixture& mix) {
    const std::size_t m = rows_.units.size();
    const Eigen::MatrixXd* const tissue =
        mix.tissue > 0.0 ? &field({mix.length_m, mix.smooth}) : nullptr;
    const Eigen::MatrixXd* const model =
        mix.model > 0.0 ? &field({model_length_m_, true}) : nullptr;
    const Eigen::MatrixXd* const noise = mix.white < 1.0 ? &along(mix.time_s) : nullptr;
    const double tissue2 = mix.tissue * mix.tissue;
    const double model2 = mix.model * mix.model;
    const double stroke2 = mix.stroke * mix.stroke;
    system_.reset(m, kColumns);
    for (std::size_t b = 0; b < m; ++b) {
      double* const column = system_.column_of(b);
      const auto j = static_cast<Eigen::Index>(b);
      for (std::size_t a = b; a < m; ++a) {
        const auto i = static_cast<Eigen::Index>(a);
        double sum = 0.0;
        if (tissue != nullptr) {
          sum += tissue2 * (*tissue)(i, j);
        }
        if (model != nullptr) {
          sum += model2 * (*model)(i, j);
        }
        if (rows_.units[a]->stroke == rows_.units[b]->stroke) {
          sum += stroke2;
          if (noise != nullptr) {
            sum += (1.0 - mix.white) * (*noise)(i, j);
          }
        }
        column[a] = sum;
      }
      column[b] += mix.white / rows_.points[b];
      for (std::size_t k = 0; k < kColumns; ++k) {
        system_.right_side(b, k) = rows_.columns[b][k];
      }
    }
    return system_.whiten();
  }

  using Products = Eigen::Matrix<double, kColumns, kColumns>;
  [[nodiscard]] Products products() const {
    Products out = Products::Zero();
    for (std::size_t k = 0; k < system_.size(); ++k) {
      const Eigen::Map<const Eigen::Matrix<double, kColumns, 1>> row(system_.right_sides(k));
      out.noalias() += row * row.transpose();
    }
    return out;
  }
  [[nodiscard]] double log_determinant() const { return system_.log_determinant(); }

  struct Within {
    double log_determinant = 0.0;  ///< a dimension
    double quadratic = 0.0;        ///< a dimension, m^2
  };
  [[nodiscard]] Within within(const Mixture& mix) const {
    if (!(rows_.hand.blocks > 0.0)) {
      return {};
    }
    std::array<double, kBlock> by_lag{};
    for (std::size_t lag = 0; lag < kBlock; ++lag) {
      by_lag[lag] = (lag == 0 ? mix.white : 0.0);
      if (mix.white < 1.0) {
        by_lag[lag] += (1.0 - mix.white) * std::exp(-rows_.hand.lag_s[lag] / mix.time_s);
      }
      if (mix.tissue > 0.0) {
        by_lag[lag] +=
            mix.tissue * mix.tissue * Field{mix.length_m, mix.smooth}.at(rows_.hand.lag_m[lag]);
      }
      by_lag[lag] += mix.model * mix.model * Field{model_length_m_, true}.at(rows_.hand.lag_m[lag]);
    }
    // Deviations from the mean: what is left in the seven directions across (1, ..., 1).
    Square covariance;
    for (std::size_t a = 0; a < kBlock; ++a) {
      for (std::size_t b = 0; b < kBlock; ++b) {
        covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
            by_lag[a > b ? a - b : b - a];
      }
    }
    using Across = Eigen::Matrix<double, kBlock - 1, kBlock>;
    static const Across across = helmert();
    using Small = Eigen::Matrix<double, kBlock - 1, kBlock - 1>;
    const Small c = across * covariance * across.transpose();
    const Small s =
        across * Eigen::Map<const Square>(rows_.hand.products_m2.data()) * across.transpose();
    const Eigen::LLT<Small> llt(c);
    constexpr double kDimensions = kBlock - 1;
    double log_determinant = 0.0;
    for (Eigen::Index k = 0; k < c.rows(); ++k) {
      log_determinant += 2.0 * std::log(llt.matrixLLT()(k, k));
    }
    return {log_determinant / kDimensions, llt.solve(s).trace() / kDimensions};
  }

 private:
  static Eigen::Matrix<double, kBlock - 1, kBlock> helmert() {
    Eigen::Matrix<double, kBlock - 1, kBlock> h = Eigen::Matrix<double, kBlock - 1, kBlock>::Zero();
    for (Eigen::Index k = 1; k < static_cast<Eigen::Index>(kBlock); ++k) {
      const double n = static_cast<double>(k);
      h.row(k - 1).head(k).setConstant(1.0 / std::sqrt(n * (n + 1.0)));
      h(k - 1, k) = -n / std::sqrt(n * (n + 1.0));
    }
    return h;
  }
  template <class Key, class Of>
  const Eigen::MatrixXd& kept(std::map<Key, Eigen::MatrixXd>& all, const Key& key, const Of& of) {
    auto [place, is_new] = all.try_emplace(key);
    if (is_new) {
      const auto m = static_cast<Eigen::Index>(rows_.units.size());
      place->second = Eigen::MatrixXd::Zero(m, m);
      for (Eigen::Index b = 0; b < m; ++b) {
        for (Eigen::Index a = b; a < m; ++a) {
          place->second(a, b) = of(*rows_.units[static_cast<std::size_t>(a)],
                                   *rows_.units[static_cast<std::size_t>(b)]);
        }
      }
    }
    return place->second;
  }
  const Eigen::MatrixXd& field(const Field& of) {
    return kept(fields_, of, [&](const Unit& a, const Unit& b) { return between(a, b, of); });
  }
  const Eigen::MatrixXd& along(double time_s) {
    return kept(noises_, time_s, [&](const Unit& a, const Unit& b) {
      return a.stroke == b.stroke ? wandering(a, b, time_s) : 0.0;
    });
  }

  const Rows& rows_;
  double model_length_m_;
  std::map<Field, Eigen::MatrixXd> fields_;
  std::map<double, Eigen::MatrixXd> noises_;
  WhitenedSystem system_;
};

// ---------------------------------------------------------------------------------------------
// The grid, and the prior of a point of it.

constexpr int kShares = 11;
constexpr int kTimes = 9;
constexpr int kRatios = 8;
constexpr double kLeastRatio = 0.12;

/// The SD of number k, of the noise's; each is twice the one before.
double ratio(int k) { return k == 0 ? 0.0 : kLeastRatio * std::ldexp(1.0, k - 1); }
/// Between it and the next one.
double ratio_above(int k) { return kLeastRatio * std::ldexp(std::numbers::sqrt2, k - 1); }

/// share, time, tissue, its length and smoothness, strokes, model.
using Node = std::array<int, 6>;

Mixture mixture(const Node& node, const Prior& prior, bool in_time) {
  Mixture out;
  if (in_time) {
    const double least = std::log(prior.white_share_least / (1.0 - prior.white_share_least));
    const double log_odds = least * (1.0 - 2.0 * node[0] / (kShares - 1.0));
    out.white = 1.0 / (1.0 + std::exp(-log_odds));
    out.time_s =
        prior.shortest_s * std::pow(prior.longest_s / prior.shortest_s, node[1] / (kTimes - 1.0));
  } else {
    out.white = 1.0;
    out.time_s = prior.longest_s;
  }
  out.tissue = ratio(node[2]);
  out.length_m = prior.tissue_lengths_m[static_cast<std::size_t>(node[3]) / 2];
  out.smooth = node[3] % 2 == 1;
  out.stroke = ratio(node[4]);
  out.model = ratio(node[5]);
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
  double tissue = mass(node[2], uneven);
  if (node[2] > 0) {
    tissue /= 2.0 * static_cast<double>(prior.tissue_lengths_m.size());
  }
  const double strokes = prior.uneven_hand_share * mass(node[4], uneven) +
                         (node[4] == 0 ? 1.0 - prior.uneven_hand_share : 0.0);
  const double model = mass(node[5], [&](double sd_m) { return model_off_by_less(prior, sd_m); });
  return std::log(tissue) + std::log(strokes) + std::log(model) +
         log_density_of_noise(prior, noise_m);
}

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

namespace {

/// What a point of the grid says of the heights at a pose.
struct Answer {
  Part part;
  double log_weight = kNever;  ///< evidence and prior, the pose integrated
  // Where all is asked for:
  double log_here = kNever;  ///< the pose being the one that the heights are of
  double log_size = kNever;  ///< the pose and the size integrated
  double size = 0.0, size_variance = 0.0;
};

enum class Asked : std::uint8_t { kWeight, kAll };

std::optional<Answer> answer(Covariances& covariances, const Rows& rows, const Problem& problem,
                             const Node& node, Asked asked) {
  const Prior& prior = problem.prior;
  const Mixture mix = mixture(node, prior, problem.observations.in_time);
  if (!covariances.whiten(mix)) {
    return std::nullopt;
  }
  const Covariances::Products all = covariances.products();
  const Covariances::Within within = covariances.within(mix);
  const Eigen::LLT<Matrix6> llt(all.topLeftCorner<6, 6>());
  if (llt.info() != Eigen::Success || !all.allFinite()) {
    return std::nullopt;
  }
  const Vector6 pivots = llt.matrixLLT().diagonal();
  constexpr double kLeastVisible = 1e-4;  // of the most visible motion's SD
  if (!(pivots.minCoeff() > kLeastVisible * pivots.maxCoeff())) {
    return std::nullopt;
  }
  // Standoff, size, curvature and height, less what the pose explains.
  const Eigen::Matrix<double, 6, 4> solved_four = llt.solve(all.topRightCorner<6, 4>());
  const Eigen::Matrix4d left_four =
      all.bottomRightCorner<4, 4>() - all.topRightCorner<6, 4>().transpose() * solved_four;
  const double inside_m2 = rows.within * within.quadratic;
  const double dimensions = static_cast<double>(rows.units.size()) + rows.within;
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
  const Eigen::Matrix<double, 6, 3> solved = solved_four * kept;

  const auto log_prior = [&](double s_m, double noise_m) {
    return log_density_of_standoff(prior, s_m) + log_prior_of(prior, node, s_m, noise_m);
  };
  const double fixed = -0.5 * covariances.log_determinant() -
                       0.5 * rows.within * within.log_determinant + rows.log_outliers;
  const double log_pose = pivots.array().log().sum();
  const OverStandoff over =
      over_standoff({left(2, 2) + inside_m2, left(0, 2), left(0, 0)}, freedom, log_prior);
  Answer out;
  out.log_weight = over.log_integral + fixed - log_pose;
  if (asked == Asked::kAll) {
    const Eigen::Matrix3d raw = kept.transpose() * all.bottomRightCorner<4, 4>() * kept;
    out.log_here =
        fixed + over_standoff({raw(2, 2) + inside_m2, raw(0, 2), raw(0, 0)}, dimensions, log_prior)
                    .log_integral;
    // The size has a normal prior: integrated, it takes its part of the squares.
    const double precision = over.noise_m2 / (prior.size_sd * prior.size_sd);
    const double information = left(1, 1) + precision;
    const OverStandoff sized =
        over_standoff({left(2, 2) - left(1, 2) * left(1, 2) / information + inside_m2,
                       left(0, 2) - left(1, 2) * left(0, 1) / information,
                       left(0, 0) - left(0, 1) * left(0, 1) / information},
                      freedom, log_prior);
    out.log_size = sized.log_integral + fixed - log_pose + 0.5 * std::log(precision / information);
    const double by_standoff = left(0, 1) / information;
    out.size = left(1, 2) / information - sized.mean_m * by_standoff;
    out.size_variance =
        sized.noise_m2 / information + sized.variance_m2 * by_standoff * by_standoff;
  }
  out.part.of = mix;
  out.part.noise_m = std::sqrt(over.noise_m2);
  out.part.standoff_m = over.mean_m;
  Vector6 scale;
  scale << 1.0, 1.0, 1.0, 1.0 / kLever_m, 1.0 / kLever_m, 1.0 / kLever_m;
  const Vector6 by_standoff = scale.asDiagonal() * solved.col(0);
  const Matrix6 inverse = llt.solve(Matrix6::Identity());
  Eigen::Map<Vector6> step(out.part.step.data());
  step = scale.asDiagonal() * solved.col(2) - over.mean_m * by_standoff;
  Eigen::Map<Rows6>(out.part.covariance.data()) =
      over.noise_m2 * (scale.asDiagonal() * inverse * scale.asDiagonal()) +
      over.variance_m2 * by_standoff * by_standoff.transpose();
  if (!std::isfinite(out.log_weight) || !step.allFinite()) {
    return std::nullopt;
  }
  return out;
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

/// Where the length of tissue stands in a point of the grid that has no tissue.
constexpr int kNoLength = 3;

/// The points of the grid next to one.
std::vector<Node> neighbours_of(const Node& node, const Problem& problem) {
  constexpr std::size_t kTissue = 2;
  constexpr std::size_t kLength = 3;
  const bool in_time = problem.observations.in_time;
  const int lengths = 2 * static_cast<int>(problem.prior.tissue_lengths_m.size());
  const Node size = {
      in_time ? kShares : 1, in_time ? kTimes : 1, kRatios, lengths, kRatios, kRatios};
  std::vector<Node> out;
  for (std::size_t k = 0; k < node.size(); ++k) {
    if (k == kLength && node[kTissue] == 0) {
      continue;  // without tissue its length means nothing
    }
    // Every other length is of the same smoothness.
    for (const int by : k == kLength ? std::vector<int>{-2, -1, 1, 2} : std::vector<int>{-1, 1}) {
      Node next = node;
      next[k] += by;
      if (next[k] < 0 || next[k] >= size[k]) {
        continue;
      }
      if (next[kTissue] == 0) {
        next[kLength] = kNoLength;
      }
      out.push_back(next);
      if (k == kTissue && node[kTissue] == 0) {
        for (next[kLength] = 0; next[kLength] < lengths; ++next[kLength]) {
          out.push_back(next);
        }
      }
    }
  }
  return out;
}

/// The likeliest first.
void sort_by_weight(Answers& answers) {
  std::stable_sort(answers.begin(), answers.end(), [](const auto& a, const auto& b) {
    return a.second.log_weight > b.second.log_weight;
  });
}

/// Every point of the grid that has weight: from a few starts, the neighbours of whatever is
/// likely.
Answers explored(const Rows& rows, const Problem& problem) {
  constexpr double kLikely = 6.0;
  constexpr std::size_t kMost = 700;
  Covariances covariances(rows, problem.prior.model_length_m);
  std::map<Node, std::optional<Answer>> seen;
  std::priority_queue<std::pair<double, Node>> likely;
  double most = kNever;
  const auto look = [&](const Node& node) {
    if (seen.size() >= kMost || seen.contains(node)) {
      return;
    }
    const auto found = answer(covariances, rows, problem, node, Asked::kWeight);
    if (found) {
      most = std::max(most, found->log_weight);
      likely.emplace(found->log_weight, node);
    }
    seen.emplace(node, found);
  };
  const bool in_time = problem.observations.in_time;
  for (const int share : in_time ? std::vector<int>{2, 5, 8} : std::vector<int>{0}) {
    for (const int time : in_time ? std::vector<int>{3, 6} : std::vector<int>{0}) {
      look({share, time, 0, kNoLength, 0, 0});
      look({share, time, 3, kNoLength, 0, 0});
      look({share, time, 0, kNoLength, 3, 0});
      look({share, time, 0, kNoLength, 0, 3});
    }
  }
  while (!likely.empty()) {
    const auto [log_weight, node] = likely.top();
    likely.pop();
    if (log_weight < most - kLikely) {
      break;
    }
    for (const Node& next : neighbours_of(node, problem)) {
      look(next);
    }
  }
  Answers out;
  for (const auto& [node, found] : seen) {
    if (found && found->log_weight > most - kLikely) {
      out.emplace_back(node, *found);
    }
  }
  sort_by_weight(out);
  return out;
}

Answers answers_at(const Rows& rows, const Problem& problem, std::span<const Node> nodes) {
  Covariances covariances(rows, problem.prior.model_length_m);
  Answers out;
  for (const Node& node : nodes) {
    if (auto found = answer(covariances, rows, problem, node, Asked::kAll)) {
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

Posterior assembled(const Touches& t, const Rows& rows, Answers answers) {
  Posterior out;
  out.centre_m = t.centre_m;
  sort_by_weight(answers);
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
    uneven_m2 += a.part.weight * a.part.noise_m * a.part.noise_m *
                 (a.part.of.tissue * a.part.of.tissue + a.part.of.stroke * a.part.of.stroke +
                  a.part.of.model * a.part.of.model);
  }
  out.size = std::exp(size);
  out.size_sd = std::sqrt(std::max(0.0, size_square - size * size));
  out.uneven_m = std::sqrt(uneven_m2);
  out.spread_m = t.spread_m;
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
  out.inlier_share = t.inliers / static_cast<double>(t.all.size());
  out.hand = rows.hand;
  out.hand.belongs.clear();
  for (const auto& touch : t.all) {
    out.hand.belongs.push_back(touch.belongs);
  }
  return out;
}

/// Gauss-Newton steps to where the pose is likeliest, averaged over these points of the grid. A
/// step that makes it less likely is halved, then refused; ended when neither translation nor
/// rotation moves.
void descend(const Problem& problem, std::span<const Unit> units, std::span<const Node> nodes,
             int most_steps, Touches& here) {
  constexpr int kMostHalvings = 4;
  constexpr double kStands_m = 3e-6;
  Answers answers = answers_at(rows_of(problem, units, here), problem, nodes);
  for (int k = 0; k < most_steps && !answers.empty(); ++k) {
    Vector6 step = mean_step(answers);
    const double before = log_here(answers);
    bool better = false;
    for (int halved = 0; halved <= kMostHalvings; ++halved, step *= 0.5) {
      Touches there = touches_at(problem, stepped(here, step), &here);
      Answers then = answers_at(rows_of(problem, units, there), problem, nodes);
      better = !then.empty() && log_here(then) >= before;
      if (better) {
        here = std::move(there);
        answers = std::move(then);
        break;
      }
    }
    if (!better ||
        (step.head<3>().norm() < kStands_m && kLever_m * step.tail<3>().norm() < kStands_m)) {
      return;
    }
  }
}

}  // namespace

std::optional<Posterior> posterior_of(const Observations& observations, const BoneSurface& bone,
                                      const Prior& prior, const Transform<World, Vertebra>& start,
                                      Effort effort, const Hand* hand) {
  constexpr std::size_t kFewUnits = 64;
  constexpr std::size_t kManyUnits = 160;
  constexpr std::size_t kFewestPoints = 24;
  constexpr std::size_t kSteering = 4;  // points of the grid that the descent uses
  constexpr std::size_t kKept = 48;
  constexpr double kAgain_m = 0.0001;
  if (observations.strokes.size() < kFewestPoints) {
    return std::nullopt;
  }
  Problem problem{observations, bone, prior, {}, {}, hand};
  for (const StrokePoint& p : observations.strokes) {
    problem.centre_in_world_m += p.tip.v / static_cast<double>(observations.strokes.size());
  }
  const bool full = effort == Effort::kFull;
  const std::vector<Unit> few = units_of(observations, kFewUnits);
  const std::vector<Unit> units = full ? units_of(observations, kManyUnits) : few;
  problem.blocks = blocks_of(observations, units);

  Touches here = touches_at(problem, start.inverse(), nullptr);
  std::vector<Node> nodes;
  // The grid is explored where the descent begins and, if that was elsewhere, again where it ends.
  for (const int most_steps : full ? std::vector<int>{12, 3} : std::vector<int>{12}) {
    const Vec3 explored_at_m = here.centre_m;
    nodes.clear();
    for (const auto& [node, a] : explored(rows_of(problem, few, here), problem)) {
      if (nodes.size() < kKept) {
        nodes.push_back(node);
      }
    }
    if (nodes.empty()) {
      return std::nullopt;
    }
    descend(problem, units, std::span(nodes).first(std::min(kSteering, nodes.size())), most_steps,
            here);
    if ((here.centre_m - explored_at_m).norm() < kAgain_m) {
      break;
    }
  }
  const Rows rows = rows_of(problem, units, here);
  Answers answers = answers_at(rows, problem, nodes);
  if (answers.empty()) {
    return std::nullopt;
  }
  return assembled(here, rows, std::move(answers));
}

}  // namespace orthonav::nav::posterior

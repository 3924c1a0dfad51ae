#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "nav/registration/bone_surface.h"
#include "nav/registration/model_error.h"
#include "nav/registration/observations.h"
#include "nav/registration/prior.h"

namespace orthonav::nav::posterior {

// The model of the heights. Under a pose, the signed distance d of a point at place p, at time t of
// stroke k, is
//
//   d = s (1 + u(p)) + c v(p) + f(p) + g(k) + n(t)
//
// s >= 0 is the mean height of the tip (tissue, a light hand), u a Gaussian field over the bone
// (tissue's thickness), v how deep in a valley the place lies (tissue is thick there, by an unknown
// c), f another field (the model is not the bone), g a height per act of the hand, n the noise
// of hand and tracker: white from point to point, and wandering along a stroke
// (Ornstein-Uhlenbeck). Or the point has nothing to do with the bone, and d is anything within a
// range.
//
// Points are averaged over some 160 units of their strokes, whose heights are the rows. How points
// deviate from the mean of the block of eight that they are in tells of the noise from point to
// point. The pose (with a flat prior: per metre, and per radian at a lever arm, the same for every
// explanation), c and the size of the model are integrated in closed form, the noise's SD by
// Laplace's method, s by quadrature; all else are hyperparameters, whose joint grid is summed over.
// (Rasmussen & Williams 2006, sections 2.7 and 5.4.)

/// A correlation that falls to 1/e over a length (m) or a time (s): exponential, or Matern's of
/// order 3/2 where what is correlated is smooth.
struct Correlated {
  double over = 0.0;
  bool smooth = false;
  friend auto operator<=>(const Correlated&, const Correlated&) = default;
};

/// What the hand strokes with the same pressure, and so at a height of its own: one stroke, one
/// area, or whatever is stroked at about the same time.
enum class Act : std::uint8_t { kStroke, kArea, kWhile };

/// A point of the grid: what the heights consist of, relative to the noise.
struct Mixture {
  double white = 0.0;   ///< share of the noise's variance that is white
  Correlated noise;     ///< the rest, in time
  double tissue = 0.0;  ///< SD of tissue over the bone, of the noise's SD; 0: there is none
  Correlated tissue_over;
  double stroke = 0.0;  ///< SD of the heights of acts, of the noise's SD
  Act act = Act::kStroke;
  double model = 0.0;  ///< SD of the model's error, of the noise's SD
};

/// What one point of the grid says.
struct Part {
  Mixture of;
  double weight = 0.0;  ///< its probability
  double noise_m = 0.0;
  double standoff_m = 0.0;  ///< mean of s
  /// Of the pose: the step of the points (translation m, rotation vector rad) about
  /// `Posterior::centre_m` in the model's frame, and its covariance by rows. The bone moves by the
  /// opposite.
  std::array<double, 6> step{};
  std::array<double, 36> covariance{};
};

/// What points tell of hand and tracker: how they deviate from the mean of the block that they are
/// in, and which of them have nothing to do with the bone.
struct Hand {
  std::array<double, kBlock * kBlock> products_m2{};  ///< mean, symmetric
  double blocks = 0.0;
  std::array<double, kBlock> lag_s{};  ///< mean time between points, by how many lie between
  std::vector<double> belongs;         ///< of each point, the probability that it is of the bone
  double inliers = 0.0;                ///< their sum
  double log_outliers = 0.0;           ///< of the points as members of the bone, or not
  double spread_m = 0.0;               ///< SD of the members' heights altogether
};

/// The points averaged over units, under a hand, with the covariances at every point of the grid
/// that was asked for. They depend on places in World only: all hypotheses share them.
class Averaged {
 public:
  /// Keeps references to both.
  Averaged(const Observations& observations, const Prior& prior);
  ~Averaged();
  Averaged(const Averaged&) = delete;
  Averaged& operator=(const Averaged&) = delete;

  static constexpr std::size_t kUnits = 160;
  struct Units;
  [[nodiscard]] Units& few() {
    return *few_;
  }  ///< fewer, and a few points of each, to tell roughly
  [[nodiscard]] Units& all() { return *all_; }
  [[nodiscard]] std::span<const std::array<std::uint32_t, kBlock>> blocks() const {
    return blocks_;
  }
  /// How many rows the points are, about: what is counted for each point counts so often.
  [[nodiscard]] double rows() const;
  [[nodiscard]] const Observations& observations() const { return observations_; }
  [[nodiscard]] const Prior& prior() const { return prior_; }
  [[nodiscard]] const Hand& hand() const { return hand_; }
  void tell(Hand hand);

 private:
  const Observations& observations_;
  const Prior& prior_;
  Hand hand_;
  std::unique_ptr<Units> few_;
  std::unique_ptr<Units> all_;
  std::vector<std::array<std::uint32_t, kBlock>> blocks_;
};

/// The posterior of the pose under one hypothesis, as a mixture of Gaussians.
struct Posterior {
  Transform<World, Vertebra> world_from_vertebra;  ///< at its mean
  Vec3 centre_m;                                   ///< of the points, in the model's frame
  std::vector<Part> parts;                         ///< the likeliest first; weights add up to 1
  std::array<double, 36> covariance{};             ///< of all parts together
  double log_evidence = 0.0;
  /// Log evidence of a model of any size against one of its own, without the odds; and the size
  /// then, of the bone relative to the model.
  double size_log_evidence = 0.0;
  double size = 1.0;
  double size_sd = 0.0;
  double noise_m = 0.0;     ///< SD of hand and tracker
  double standoff_m = 0.0;  ///< mean height of the tip above the bone
  double uneven_m = 0.0;    ///< SD over the bone of what is not noise
  /// Correlation of the heights of two points at the same place, of different strokes.
  double across_strokes = 0.0;
  /// How high the tip was along the strokes, without noise; of a full look that told the hand.
  std::vector<EstimatedHeight> heights;
  ModelShare model_share;  ///< about `centre_m`; likewise
  Hand hand;
};

/// A sum of squares (m^2) as a function of the standoff s: height - 2 s product + s^2 standoff.
struct Squares {
  double height = 0.0;
  double product = 0.0;
  double standoff = 0.0;
};

/// The heights' density, times a prior, integrated over s >= 0 and over the noise's SD.
struct OverStandoff {
  double log_integral = 0.0;
  double mean_m = 0.0;  ///< of s
  double variance_m2 = 0.0;
  double noise_m2 = 0.0;  ///< mean
};
/// `freedom`: degrees of freedom of the squares. `log_prior`: a density in s (1/m) and in the
/// logarithm of the noise's SD. By quadrature in s, so that a truncated tail is as exact as the
/// middle, and by Laplace's method in the noise.
[[nodiscard]] OverStandoff over_standoff(
    const Squares& squares, double freedom,
    const std::function<double(double s_m, double noise_m)>& log_prior);

/// How closely to look: `kRough` takes little time and tells which hypotheses are far worse.
enum class Effort : std::uint8_t { kRough, kFull };

/// The posterior near `start`. `tells_hand`: the hand is what the points tell at this pose, and
/// stays so afterwards; otherwise it is that of the best explanation, for all others to be compared
/// with it. The first look tells. Empty where the points leave a motion undetermined, or where it
/// is soon plain that the log evidence is less than `least`.
[[nodiscard]] std::optional<Posterior> posterior_of(
    Averaged& averaged, const BoneSurface& bone, const Transform<World, Vertebra>& start,
    Effort effort, bool tells_hand, double least = -std::numeric_limits<double>::infinity());

}  // namespace orthonav::nav::posterior

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "hal/api/devices.h"

namespace orthonav::nav {

/// How the cameras appear to differ from their reported calibration.
struct StereoAlignment {
  Vec3 rotation_rad{};  ///< of the right camera, in its frame, relative to the reported calibration
  Vec3 sd_rad{};
  std::int64_t pairs = 0;
  bool significant = false;
  bool within_bounds = true;
  bool applied = false;  ///< poses take the rotation into account
  /// The right camera's focal length divided by the left one's, and the baseline's length, as
  /// fractions by which they exceed what is reported. Poses do not take them into account.
  double focal_fraction = 0.0;
  double focal_sd = 0.0;
  double baseline_fraction = 0.0;
  double baseline_sd = 0.0;
};

/// Turns the right camera by a rotation vector (rad) in its own frame.
inline void rotate_right_camera(StereoCalibration& calibration, Vec3 rotation_rad) {
  const Transform<RightCamera, RightCamera> correction(rotation_from_vector(rotation_rad), {});
  calibration.right_from_rig = correction * calibration.right_from_rig;
}

/// The size of a tool's tags as the two cameras measure it.
struct TagSize {
  double fraction = 0.0;  ///< by which they are larger than stated
  double sd = 0.0;
  std::int64_t measurements = 0;
  bool notable = false;  ///< more than small errors of the cameras could cause
  /// Certainly a different size than stated: a wrong print or a wrong unit (or misaligned cameras).
  /// Poses are then wrong.
  bool disagrees = false;
  double applied = 0.0;  ///< the part of `fraction` that poses take into account
};

/// The unknowns of the cameras: the right one's rotation vector (rad, in its frame), then the
/// logarithms of its focal length and of the baseline.
inline constexpr std::size_t kCameraUnknowns = 5;
inline constexpr std::size_t kFocalUnknown = 3;
inline constexpr std::size_t kBaselineUnknown = 4;
/// The logarithm of the size of a tool's tags, after those of the cameras.
inline constexpr std::size_t kTagSizeUnknown = 5;
inline constexpr std::size_t kCalibrationUnknowns = 6;

/// Least-squares equations from one pair and the tags of one tool that both cameras saw, for the
/// deviation of the calibration from the one that poses are computed with; the tags' poses and
/// their light are eliminated.
struct CalibrationEquations {
  std::array<double, kCalibrationUnknowns * kCalibrationUnknowns> information{};  ///< symmetric
  std::array<double, kCalibrationUnknowns> right{};
  /// By how much the squared, normalised error would fall if each camera had its own pose of every
  /// tag: how strongly the two pictures contradict each other with the calibration as it is.
  double contradiction = 0.0;
  int tags = 0;
};

struct ToolEquations {
  std::size_t tool = 0;
  CalibrationEquations equations;
};

struct CalibrationOptions {
  /// Fewer pairs may agree by chance.
  std::int64_t min_pairs = 30;
  /// By how much the squared, normalised error must fall: with 3 rotations and 3 tools this happens
  /// by chance in 1 of 100,000 cases.
  double significance = 35.0;
  /// Prior SDs; all rotations are equally likely.
  double focal_sd = 0.001;
  double baseline_sd = 0.0015;
  double size_sd = 0.003;
};

/// Estimates from tags in use how the right camera is turned and how large each tool's tags are
/// (least squares with priors). At a single distance, the common size of all tags can't be
/// distinguished from the angle between the cameras; the stated sizes are then assumed to be right
/// on average, and only their differences are corrected. From the same equations it says how large
/// each tool's tags are if the cameras are as calibrated: a page "fitted to paper" is 3 % off or
/// more, which no camera explains.
class OnlineCalibration {
 public:
  explicit OnlineCalibration(std::size_t tools, const CalibrationOptions& options = {});

  void add(std::size_t tool, const CalibrationEquations& pair);
  /// Of a tool that can't be followed at its stated size: the fraction by which its tag's corners
  /// say that it is larger. Counts for `tag_size` alone.
  void add_size(std::size_t tool, double fraction, double sd);
  /// Whether the two pictures of a pair may be of the same moment: whether what is left of their
  /// contradiction, after the calibration has explained what it can within its own uncertainty,
  /// happens by chance. One entry per tool that both cameras saw. A pair has the weight with which
  /// it counts for the calibration, since errors of light and lens contradict each other too.
  [[nodiscard]] bool explains(std::span<const ToolEquations> pair);
  /// Forgets every pair; what was applied stays applied.
  void restart();
  [[nodiscard]] std::int64_t pairs() const { return pairs_; }
  /// Computes the correction that the caller must apply now, and counts it as applied. False,
  /// without a correction, while it is not certain, too small to matter, or beyond the limits.
  bool correct();
  /// The rotation (rad) by which the right camera is to be turned, by the last `correct()`.
  [[nodiscard]] Vec3 rotation_rad() const { return rotation_rad_; }
  /// The size of a tool's tags, the cameras being as calibrated. Nothing before the first pair and
  /// after a correction.
  [[nodiscard]] std::optional<TagSize> tag_size(std::size_t tool) const;
  /// A tag printed at the wrong size looks like cameras that are turned towards each other.
  [[nodiscard]] bool may_be_of_wrong_size() const;
  /// The factor of a tool's stated tag sizes by all corrections so far.
  [[nodiscard]] double size_factor(std::size_t tool) const;
  /// The SD of how much larger one tool's tags are than another's, as a fraction.
  [[nodiscard]] double size_difference_sd(std::size_t tool, std::size_t other) const;
  /// Includes the corrections applied. Nothing before the first pair, or while a direction is
  /// undetermined.
  [[nodiscard]] std::optional<StereoAlignment> alignment() const;

 private:
  using Camera = std::array<double, kCameraUnknowns>;
  struct Tool {
    Camera cross{};  ///< information shared with the cameras
    double information = 0.0;
    double right = 0.0;
    double applied = 0.0;  ///< logarithm of the factor
    // What is left of the size by the cameras as calibrated.
    double size_information = 0.0;
    double size_sum = 0.0;  ///< of fractions, weighted by their information
    std::int64_t sizes = 0;
  };
  struct Estimate;
  struct Priors {
    double rotation_precision = 0.0;  ///< 0: all rotations are equally likely
    double size_sd = 0.0;
  };
  [[nodiscard]] std::optional<Estimate> estimate(const Priors& priors) const;
  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] double size_change(const Tool& tool, const Camera& cameras) const;
  void apply(const Camera& cameras);

  CalibrationOptions options_;
  std::array<double, kCameraUnknowns * kCameraUnknowns> information_{};
  Camera right_{};
  std::vector<Tool> tools_;
  std::vector<Tool> kept_;  ///< scratch
  Vec3 applied_rad_{};
  Vec3 rotation_rad_{};
  bool applied_ = false;
  std::int64_t pairs_ = 0;
};

}  // namespace orthonav::nav

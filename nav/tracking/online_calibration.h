#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nav/tracking/stereo_alignment.h"

namespace orthonav::nav {

/// Of the cameras: the right one's rotation vector (rad, in its frame), then the logarithms of its
/// focal length and of the baseline.
inline constexpr std::size_t kCameraUnknowns = 5;
inline constexpr std::size_t kFocalUnknown = 3;
inline constexpr std::size_t kBaselineUnknown = 4;
/// The logarithm of the size of a tool's tags, after those of the cameras.
inline constexpr std::size_t kTagSizeUnknown = 5;
inline constexpr std::size_t kCalibrationUnknowns = 6;

/// What one pair says, through one tool that both cameras saw, about how the calibration differs
/// from what poses are computed with: least squares, the pose and the light eliminated.
struct CalibrationEquations {
  std::array<double, kCalibrationUnknowns * kCalibrationUnknowns> information{};  ///< symmetric
  std::array<double, kCalibrationUnknowns> right{};
};

struct CalibrationOptions {
  /// Errors repeat from pair to pair: only this fraction of a pair's information is new.
  double independent_fraction = 0.05;
  /// Fewer pairs may agree by accident.
  std::int64_t min_pairs = 30;
  /// By how much the squared, normalised error must fall: with 3 rotations and 3 tools 1 in 100,000
  /// by chance.
  double significance = 35.0;
  /// What was found is applied where it turns the camera by more than this, a twentieth of a
  /// pixel, or where a tag's size changes by more than this.
  double min_rotation_rad = 0.00015;
  double min_size = 0.0004;
  /// With a larger rotation the device is broken, or the calibration belongs to another one; tags
  /// whose size is off by more were printed at the wrong scale, which is reported instead.
  double max_rotation_rad = 0.01;
  double max_size = 0.015;
  /// SDs before anything was seen; any rotation is as likely as another.
  double focal_sd = 0.001;
  double baseline_sd = 0.0015;
  double size_sd = 0.003;
};

/// Estimates from tags in use how the right camera is turned and how large each tool's tags are
/// (least squares with priors). The common size of all tags and the angle between the cameras look
/// alike from one distance; the stated sizes then count as right on average, so what is corrected
/// is how they differ.
class OnlineCalibration {
 public:
  explicit OnlineCalibration(std::size_t tools, const CalibrationOptions& options = {});

  void add(std::size_t tool, const CalibrationEquations& pair);
  /// Computes what has to change now; false while that is not certain, too small to matter or
  /// beyond the limits. What was found then counts as applied.
  bool correct();
  /// The rotation (rad) by which the right camera is to be turned, by the last `correct()`.
  [[nodiscard]] Vec3 turn_rad() const { return turn_rad_; }
  /// The factor of a tool's stated tag sizes by all corrections so far.
  [[nodiscard]] double size_factor(std::size_t tool) const;
  /// The SD of that factor. That of the prior while nothing was seen.
  [[nodiscard]] double size_sd(std::size_t tool) const;
  /// The SD of how much larger one tool's tags are than another's, as a fraction.
  [[nodiscard]] double size_difference_sd(std::size_t tool, std::size_t other) const;
  /// With what was applied. Nothing before the first pair, or while a direction is undetermined.
  [[nodiscard]] std::optional<StereoAlignment> alignment() const;

 private:
  using Camera = std::array<double, kCameraUnknowns>;
  struct Tool {
    Camera cross{};  ///< information that it shares with the cameras
    double information = 0.0;
    double right = 0.0;
    double applied = 0.0;  ///< logarithm of the factor
  };
  struct Estimate;
  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] double size_change(const Tool& tool, const Camera& cameras) const;
  void apply(const Camera& cameras);

  CalibrationOptions options_;
  std::array<double, kCameraUnknowns * kCameraUnknowns> information_{};
  Camera right_{};
  std::vector<Tool> tools_;
  Vec3 applied_rad_{};
  Vec3 turn_rad_{};
  bool applied_ = false;
  std::int64_t pairs_ = 0;
};

}  // namespace orthonav::nav

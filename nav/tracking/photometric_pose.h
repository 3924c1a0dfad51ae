#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/tracked.h"
#include "base/vec.h"
#include "hal/api/camera_model.h"
#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/online_calibration.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {

/// The rays of a camera, for the model of a view: the unit-plane point of every pixel's centre, one
/// array per coordinate, NaN where a pixel has no direction.
struct RayTable {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> x;
  std::vector<float> y;
  /// Pixels per unit of the unit plane, near the middle of the image.
  double focal_px = 1.0;

  explicit RayTable(const CameraModel& camera);
};

/// A tag's template, prepared for interpolation: near the edges between a cell and its neighbours,
/// grey is a polynomial in the fractions of the blur's footprint that lie over each of them.
class BlurredTag {
 public:
  /// `size_m` is measured from outer edge to outer edge of the border.
  BlurredTag(TagTemplate tag, double size_m);

  [[nodiscard]] const TagTemplate& cells() const { return tag_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  void set_size(double size_m) { cell_m_ = tag_.cell_m(size_m); }
  /// The nine coefficients of a cell: 1, left, right, above, below, and the four corners.
  [[nodiscard]] const float* coefficients(int row, int column) const {
    return coefficients_.data() + 12 * static_cast<std::size_t>(row * tag_.cells + column);
  }

 private:
  TagTemplate tag_;
  double cell_m_ = 0.0;
  std::vector<float> coefficients_;
};

/// Light, lens and sensor of one tag in one image. Grey = (black + contrast · response(white)) ·
/// shade, with white the blurred template in [0, 1], response(w) = w + bend · w (1 − w) + bow ·
/// w (1 − w) (1 − 2w) + …, and shade = 1 + slope · (column, row) from the middle, in half widths of
/// the template. Kept from pair to pair, since light changes slowly.
struct Photometry {
  double black = 30.0;
  double contrast = 150.0;
  std::array<double, 2> slope{};  ///< along columns and along rows
  /// SD of the blur, in cells, across edges between columns and between rows; lens, pixel and
  /// motion together.
  std::array<double, 2> blur_cells{0.15, 0.15};
  /// Excess kurtosis of the blur's profile along columns and along rows: 0 for a Gaussian, larger
  /// if the lens scatters light, smaller along a motion.
  std::array<double, 2> excess_kurtosis{};
  /// Correlation of the blur between columns and rows, from an oblique view of the tag or from
  /// motion.
  double blur_correlation = 0.0;
  /// Departure of the sensor's response from a line: like a gamma, which makes white areas grow,
  /// and like increased contrast in the middle, in the last three places.
  std::array<double, 3> response{};
  /// Variance of a grey value in black and in white areas; initially so large that nothing is an
  /// outlier.
  std::array<double, 2> variance{2500.0, 2500.0};
  /// Additional variance along edges, per square of the slope of the blurred template (per cell):
  /// there the model's error exceeds the noise.
  double edge_variance = 0.0;
  /// How much more strongly the edges pull at the pose than noise alone would
  /// (`ViewEquations::sandwich_factor`).
  double sandwich_factor = 1.0;
  bool known = false;  ///< from an earlier fit
};

/// Columns of the linear model of a view. The pose is perturbed in the frame of the tag: shift
/// (in cells) and rotation vector.
inline constexpr std::size_t kPoseColumns = 6;
/// Black, contrast, slopes, logarithms of blur, excess kurtosis, blur correlation, response.
inline constexpr std::size_t kLightColumns = 12;
inline constexpr std::size_t kColumns = kPoseColumns + kLightColumns;

/// The sums of weighted least squares over the pixels of one view, and what they say about the fit.
struct ViewEquations {
  /// Upper triangle by rows of JᵀWJ over the columns and the residual as the last column.
  std::array<double, (kColumns + 1) * (kColumns + 2) / 2> sums{};
  double pixels = 0.0;           ///< that were compared
  double kept = 0.0;             ///< of these, by robust weight
  double sandwich_factor = 1.0;  ///< how much more strongly the edges pull at the pose than noise
                                 ///< alone would
  /// Robustly weighted least squares of the squared residuals on the black and white fractions of
  /// the pixels, away from edges: noise grows linearly from black to white.
  std::array<double, 2> squares{};
  std::array<double, 3> fractions{};  ///< black by black, black by white, white by white
  /// Least squares of the remaining squared residuals on the square of the slope.
  double edge_squares = 0.0;
  double edge_fractions = 0.0;

  [[nodiscard]] double sum(std::size_t row, std::size_t column) const {
    return sums[row * (kColumns + 1) - row * (row + 1) / 2 + column];
  }
};

/// Compares the image with the model at a pose. `doubt_cells` is how far off the pose may still be:
/// a pixel counts as an outlier only if that does not explain it. Reuses its memory; one thread at
/// a time.
class ViewModel {
 public:
  ViewModel();
  /// `cell_weights` (one per cell; empty: unknown) says to what extent each cell showed the tag
  /// last time; it receives the values found this time.
  void linearize(const GreyImage& image, const CameraModel& camera, const RayTable& rays,
                 const BlurredTag& tag, const CameraFromTag& pose, const Photometry& light,
                 double doubt_cells, std::vector<float>& cell_weights, ViewEquations& out);
  /// For each piece of an edge, two cells long: its pull at each column (the sums of w r J).
  [[nodiscard]] std::span<const float> scores() const { return scores_; }

 private:
  static constexpr int kBlock = 64;
  static constexpr float kPieceCells = 2.0F;
  /// What is kept for each pixel of a block.
  enum BlockColumn {
    kGrey,
    kBx,
    kBy,
    kT,
    kTx,
    kTy,
    kTsx,
    kTsy,
    kTtx,
    kTty,
    kTc,
    kVariance,
    kSlope2,
    kKept,
    kWeight,
    kFirst,
    kBlockColumns = kFirst + kColumns + 1
  };
  bool place(const CameraModel& camera, const BlurredTag& tag, const CameraFromTag& pose);
  /// Pixels [from, to) of a row, counted from `x0_`: those on the tag lie between.
  struct OnTag {
    int from = 0;
    int to = 0;
  };
  OnTag spread(const RayTable& rays, int y, const Photometry& light);
  void collect(const GreyImage& image, const BlurredTag& tag, int y, OnTag row,
               const Photometry& light, double doubt_cells, ViewEquations& out);
  void add(int k, int i, std::uint8_t grey, float blur_correlation, const float* coefficients);
  void finish(const Photometry& light, double doubt_cells, ViewEquations& out);
  void compare(const Photometry& light);
  void weigh(const Photometry& light, double doubt_cells);
  void sum_up(ViewEquations& out) const;
  void count(int pixels, ViewEquations& out);
  void score(int pixels);
  [[nodiscard]] int pieces_across() const {
    return static_cast<int>((2.0F * half_ + 0.5F) / kPieceCells) + 1;
  }

  std::vector<float> scores_;
  std::vector<float> row_;
  std::vector<float> block_;                  ///< kBlockColumns of kBlock
  std::array<std::uint16_t, kBlock> cell_{};  ///< of each pixel of the block
  int filled_ = 0;
  // By cell: the last weight, the number of pixels now, and how many of them are kept.
  std::vector<float> believed_;
  std::vector<float> counted_;
  std::vector<float> kept_;
  // For the current view.
  int x0_ = 0;
  int x1_ = 0;
  int y0_ = 0;
  int y1_ = 0;
  std::array<float, 9> plane_from_ray_{};  ///< (column, row, 1) in cells by a ray, up to scale
  float depth_ = 1.0F;
  Vec3 eye_cells_{};  ///< the camera's centre from the tag's middle: columns, rows, out of face
  float half_ = 0.0F;
};

/// A view's equations for the tag's pose, with its light eliminated (Schur complement). Residuals
/// that scatter more than their noise reduce its weight.
struct ReducedView {
  std::array<double, 36> normal{};
  std::array<double, 6> right{};
};

/// One tag of a tool in one image, with the light remembered for it.
struct TagView {
  const BlurredTag* tag = nullptr;
  Transform<Marker, Tag> marker_from_tag;  ///< poses of a tool are those of its first tag
  bool right = false;                      ///< camera
  Photometry light;
  std::vector<float> cell_weights;  ///< by cell: 0 where it is hidden
  // Of the last fit:
  double kept_fraction = 0.0;  ///< of the pixels, by robust weight
  /// In: whether to use this view at all. Out: whether the fit used it.
  bool used = true;
};

struct PhotometricFit {
  Transform<Rig, Marker> rig_from_marker;
  /// In the frame of the marker: (translation m, rotation vector rad).
  std::array<double, 36> covariance{};
  int views = 0;  ///< sightings used
  bool left = false;
  bool right = false;
  int iterations = 0;
};

/// The pose that explains every sighting at once, since every edge of a tag's cells tells of it:
/// Gauss-Newton over SE(3), each view's light, blur and response eliminated by the Schur
/// complement, weights by Tukey's biweight.
class PhotometricSolver {
 public:
  explicit PhotometricSolver(const StereoCalibration& calibration);

  /// Improves a pose that is right to about half a cell; `doubt_m` says how far off it may be. Only
  /// sightings with `used` set count; their light is updated even if the fit fails. Nothing if too
  /// little of the tags is visible.
  [[nodiscard]] std::optional<PhotometricFit> solve(const StereoFrame& frame,
                                                    const Transform<Rig, Marker>& start,
                                                    double doubt_m, std::span<TagView> views);
  /// The calibration equations of the last fit; nothing if only one camera was used.
  [[nodiscard]] std::optional<CalibrationEquations> calibration_equations(
      const PhotometricFit& fit, std::span<const TagView> views) const;
  /// The equations of one view of the last fit.
  [[nodiscard]] ReducedView view_equations(std::size_t index, const TagView& view) const;
  /// The equations of a view at `pose`, from those at the pose that fits it best.
  [[nodiscard]] static ReducedView shifted(const TagView& view, const ReducedView& at_best,
                                           const Transform<Rig, Marker>& best,
                                           const Transform<Rig, Marker>& pose);
  /// Adds the calibration equations of a tag that both cameras saw, at a pose.
  void add_tag(const Transform<Rig, Marker>& pose, const TagView& left, const ReducedView& of_left,
               const TagView& right, const ReducedView& of_right, CalibrationEquations& out) const;
  /// Pixels per unit of the unit plane, near the middle of the left or the right image.
  [[nodiscard]] double focal_px(bool right) const {
    return right ? right_rays_->focal_px : left_rays_->focal_px;
  }
  /// Turns the right camera by a rotation vector in its own frame.
  void rotate_right_camera(Vec3 rotation_rad) {
    nav::rotate_right_camera(calibration_, rotation_rad);
  }
  [[nodiscard]] const StereoCalibration& calibration() const { return calibration_; }
  /// Camera from tag for a sighting of a tool at a pose.
  [[nodiscard]] CameraFromTag camera_from_tag(const TagView& view,
                                              const Transform<Rig, Marker>& pose) const;

 private:
  struct Step {
    double size_m = 0.0;          ///< how far the motion moves the farthest cells
    double pixels_a_metre = 0.0;  ///< in the nearest view
  };
  /// Moves the pose of `fit`, with the light of every view eliminated, and updates the lights.
  std::optional<Step> step(const StereoFrame& frame, double doubt_m, std::span<TagView> views,
                           PhotometricFit& fit);
  [[nodiscard]] double pixels_a_metre(const TagView& view,
                                      const Transform<Rig, Marker>& pose) const;

  StereoCalibration calibration_;
  // Copies share them: no rotation of a camera changes its rays.
  std::shared_ptr<const RayTable> left_rays_;
  std::shared_ptr<const RayTable> right_rays_;
  ViewModel model_;
  std::vector<ViewEquations> equations_;
};

}  // namespace orthonav::nav

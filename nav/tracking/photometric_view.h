#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/vec.h"
#include "hal/api/camera_model.h"
#include "nav/tracking/blurred_tag.h"

namespace orthonav::nav {

/// The pose of a tag in a camera: camera from marker. Left or right does not matter here.
struct CameraFromTag {
  Mat3 rotation = Mat3::identity();
  Vec3 translation_m{};
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
  /// How much more strongly the edges pull at the pose than noise alone would (`scatter`).
  double sandwich_factor = 1.0;
  bool known = false;  ///< from an earlier fit
};

/// Columns of the linear model of a view. The pose is perturbed in the frame of the tag: shift
/// (in cells) and rotation vector.
inline constexpr std::size_t kPoseColumns = 6;
/// Black, contrast, slopes, logarithms of blur, excess kurtosis, blur correlation, response.
inline constexpr std::size_t kLightColumns = 12;
inline constexpr std::size_t kColumns = kPoseColumns + kLightColumns;

/// The fraction of clean noise's variance that remains under the robust weights: E[w r²] / (E[w]
/// σ²) of Tukey's biweight at 4.7 SD.
inline constexpr double kRobustVariance = 0.829;

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
  bool face(const Mat3& rotation, Vec3 t);
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
  void judge_cells(std::vector<float>& cell_weights) const;

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

}  // namespace orthonav::nav

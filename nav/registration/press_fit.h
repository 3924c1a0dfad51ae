#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nav/registration/pressed_places.h"

namespace orthonav::nav {

/// A pressed place, as far as its height depends on it, in the model's frame.
struct PressedHeight {
  Vec3 at_m;
  Vec3 up;   ///< unit, out of the bone
  Vec3 ray;  ///< unit, from a camera; zero: pressed
  int view = 0;
  double time_s = 0.0;
  double sd_m = 0.0;  ///< of this place alone, from tracking and tremor
};

/// What an error of the model, a field of SD 1 over the bone, does to pressed places: it changes
/// the height of each, and it has moved the pose of the strokes, against which heights are
/// measured.
class FieldCovariance {
 public:
  /// `length_m`: over which the error is correlated. Keeps a reference to `strokes`.
  FieldCovariance(const ModelShare& strokes, double length_m, Vec3 centre_m);

  /// Covariance of the pose of the strokes, by rows.
  [[nodiscard]] const std::array<double, 36>& pose() const { return pose_; }
  /// Covariance of that pose with the error at a place.
  [[nodiscard]] std::array<double, 6> with_place(Vec3 at_m) const;
  /// Covariance of a height with the pose, negated, as the step to the true pose lowers heights.
  /// `place`: `with_place` there.
  [[nodiscard]] std::array<double, 6> with_pose(const PressedHeight& at,
                                                const std::array<double, 6>& place) const;
  /// Covariance of two heights.
  [[nodiscard]] double between(const PressedHeight& a, const std::array<double, 6>& place_a,
                               const PressedHeight& b, const std::array<double, 6>& place_b) const;

 private:
  const ModelShare& strokes_;
  double length_m_;
  Vec3 centre_m_;
  std::array<double, 36> pose_{};
};

/// What the heights of pressed places say about the pose of the strokes: a Gaussian posterior
/// (Rasmussen & Williams 2006, section 2.7) whose noise consists of the error of each press, the
/// model's own error as a field over the bone, and World's random walk. The field is the same as
/// under the strokes: where their pose shares it (`Registration::model_share`), a press beside a
/// stroke tells nothing new of it. SD and length of the field are marginalised on a grid, weighted
/// by a prior and by the likelihood of the heights.
struct PressFit {
  Vec3 centre_m;                        ///< of the step, in the model's frame
  std::array<double, 6> step{};         ///< translation m, rotation vector rad; from the heights
  std::array<double, 36> covariance{};  ///< after the step, by rows, of the bone where it lies now
  /// For each place: its distance from the bone as predicted from all other places and the strokes
  /// (including SD and length of the field), and the SD of that.
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
  ModelError model;    ///< root mean square SD, mean length
  double now_s = 0.0;  ///< when the last of the places was pressed

  /// The pose of the bone as it lies now, given the pose from its strokes.
  [[nodiscard]] Transform<World, Vertebra> moved(
      const Transform<World, Vertebra>& world_from_vertebra) const;
  /// The covariance if each of these places were pressed next.
  [[nodiscard]] std::vector<std::array<double, 36>> with(std::span<const PressedHeight> next,
                                                         const PressModel& press) const;

  // With the likeliest field, for `with`.
  ModelError likeliest;
  std::vector<PressedHeight> heights;
  std::vector<double> inverse_1_m2;           ///< of the heights' covariance
  std::vector<std::array<double, 6>> shared;  ///< covariance of the pose now with each height
  std::array<double, 36> before{};            ///< of the pose of the strokes, without the field
  ModelShare strokes;                         ///< how the field is in it
  std::array<double, 36> likeliest_covariance{};
};

/// Fits the step of the pose of `strokes`. Without places, the result is that of the strokes, with
/// the usual error of a model in place of what they tell of it. Empty if the strokes leave a motion
/// undetermined or a number is not finite.
[[nodiscard]] std::optional<PressFit> fit_presses(const VertebraModel& model,
                                                  const Registration& strokes,
                                                  std::span<const PressedPlace> places,
                                                  const PressModel& press);

/// A step of the pose about `centre_m`, from the registered vertebra to the true one.
[[nodiscard]] inline Transform<Vertebra, Vertebra> moved_by(const std::array<double, 6>& step,
                                                            Vec3 centre_m) {
  const Mat3 rotation = orthonormalized(rotation_from_vector({step[3], step[4], step[5]}));
  return {rotation, centre_m + Vec3{step[0], step[1], step[2]} - rotation * centre_m};
}

}  // namespace orthonav::nav

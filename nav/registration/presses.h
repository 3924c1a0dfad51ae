#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nav/registration/model_error.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// A place where the pointer's tip was pressed to the bone, or that a depth camera saw of it.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;    ///< of the tip's position along each axis: tracking and tremor
  double time_s = 0.0;  ///< since the bone was registered by its strokes
  Vec3 ray{};           ///< unit, World, from the camera; zero: it was pressed
  int view = 0;         ///< of the camera: what it is off, it is off in all of one view
};

/// Prior knowledge about such places.
struct PressModel {
  /// Height of the tip above the bone: mean, SD common to all places, SD of each place. Estimates
  /// for soft tissue under a pressed tip.
  double height_m = 0.0002;
  double common_sd_m = 0.0002;
  double sd_m = 0.0003;
  double tip_radius_m = 0.0;
  /// Of places that a depth camera saw: SD of what it is off along its rays.
  double ray_sd_m = 0.0;
  /// SD along each axis of World's motion relative to the bone between the strokes and the
  /// registration; and its random walk from then on, m/√s.
  double moved_sd_m = 0.0003;
  double drift_m_per_sqrt_s = 0.0;
  /// SD along each axis of its motion since the places were pressed, if the random walk is not part
  /// of the fit: included in the reported uncertainty, but not compared with the limits.
  double since_sd_m = 0.0;
  /// If known; otherwise it is estimated from the places, within the usual range of segmentations.
  std::optional<ModelError> model;
  /// The model's error where the fit takes it to be smaller than it is: included in the reported
  /// uncertainty, but not compared with the limits.
  std::optional<ModelError> left_out;
};

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

/// A registration that includes pressed places.
struct JoinedPlaces {
  Registration registration;
  /// For each place: its distance from the bone as predicted from all other places and the strokes,
  /// and the SD of that (leave one out).
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
  ModelError model;  ///< as estimated from the places
};

/// Includes pressed places, which `fit_presses` has fitted with the same model and strokes, in a
/// registration: the pose is that of the bone, by strokes and places together, at the time the last
/// place was pressed, and the uncertainty includes the model's own error. `accepted`, `reasons` and
/// `provisional` are judged again; everything else measured on the strokes stays. Empty without
/// places. `targets` as for the registration.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      const PressFit& fit, const PressModel& press,
                                                      const PoseSearchRegistrationOptions& options);

/// A place that is worth pressing.
struct NextPlace {
  Point<World> place;
  /// Root mean square error to expect at the worst target, now and after this place is pressed.
  double tre_m = 0.0;
  double tre_then_m = 0.0;
};

/// Two places nearer to each other than this add little more than one.
inline constexpr double kPressesApart_m = 0.003;

/// The place on the stroked bone that reduces the error at the worst target most if pressed in
/// addition to `pressed`, of which `fit` is, at least `apart_m` from them. Empty if none reduces
/// it.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PressFit& fit, const PressModel& press,
    const PoseSearchRegistrationOptions& options, double apart_m = kPressesApart_m);

}  // namespace orthonav::nav

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/vec.h"
#include "hal/sim/error_model.h"
#include "study/mean_interval.h"

namespace orthonav::engine {

/// Mean durations of the steps, seconds; each varies log-normally about its mean. All but
/// the touch are estimates, to be multiplied by `RodExperimentOptions::pace`.
struct RodStepDurations {
  /// For one head. 36.7 s with a pointer was published for the heads of a rod (the comparison of
  /// HoloYolo); over five of them. Not multiplied by `pace`.
  double touch_head_s = 7.3;
  double measure_s = 20.0;   ///< hold the rod at the heads or a ruler, and mark the length
  double cut_s = 30.0;       ///< with a hand cutter
  double bend_s = 20.0;      ///< set the bender, bend
  double compare_s = 10.0;   ///< look at the heads, or at the hologram, after or before a bend
  double try_s = 25.0;       ///< lay the rod in the heads and look at each
  double take_out_s = 10.0;  ///< before it is bent again
  double mark_s = 5.0;       ///< lay off one bend and its roll, as instructed
  /// The same head once more: the tip is lifted, turned and put down again. Estimate: as long as a
  /// landmark takes. Not multiplied by `pace`.
  double touch_again_s = 3.0;
  /// Relative SD of a step. Estimate.
  double scatter = 0.3;
};

/// The rods, and the accuracy of hand, eye and hologram. Every line states the source of its value;
/// "estimate": not published. For vectors, SD is per axis.
///
/// Two values are fitted, both only to the *control* arm of the publication: `pace` to its 465 s
/// and `eye_length_sd` to its 4 of 18 rods of the right length. The result of the arm with the
/// template is not fitted, and nothing may be tuned to it. It agrees on the length, and does not
/// explain the published shorter time (docs/accuracy.md, "Rods").
struct RodExperimentOptions {
  std::size_t rods = 18;  ///< in each arm, as published

  /// The touched tops of the heads, LPS. Empty: for every rod a lumbar spine of its own, 3 to 6
  /// heads 35 mm apart that turn by 10° from one to the next, set off sideways by 2.5 mm and in
  /// depth by 1.5 mm (SD; estimates).
  std::vector<Vec3> heads_m;
  /// From the heads to the vertebrae. Each screw is assumed to point there, perpendicular to the
  /// rod.
  Vec3 to_bone{0.0, -1.0, 0.0};
  /// From the touched top to the rod's middle. Estimate: half of a tulip of 12 mm.
  double head_to_seat_m = 0.006;

  // The rod: Ti-6Al-4V, as surgeons use.

  double rod_diameter_m = 0.0055;
  double yield_pa = 758e6;
  double modulus_pa = 114e9;
  double bend_width_m = 0.020;  ///< of the rod that a bender curves

  // The definition of a right length; ours, since the publication does not state one.

  double overhang_m = 0.005;  ///< wanted beyond the middle of the end seats
  double shortest_overhang_m = 0.002;
  double longest_overhang_m = 0.008;

  // The template.

  double head_pick_m = sim::ErrorModel{}.head_pick_m;  ///< SD of touching the middle of a head
  double navigation_m = 0.001;                         ///< SD of where the pointer is. Estimate
  /// SD of where the bender perceives the hologram beside the rod, one draw for each place of it.
  /// 1.3 mm is the low end of 1.3 to 2.3 mm (error_model.h).
  double perception_m = sim::ErrorModel{}.overlay_perception_m;
  /// A place that appears nearer to the hologram than this is left as it is. Estimate: the SD of
  /// perceiving it, rounded up.
  double matched_m = 0.0015;
  int most_matching_bends = 3;  ///< for one place. Estimate
  /// How far below the heads the template assumes the rod to lie; 0 is a template through the
  /// heads.
  double assumed_head_to_seat_m = 0.006;
  double length_reading_m = 0.0005;  ///< SD of laying off the length read. Estimate

  // The eye.

  /// Relative SD of the length estimated at the heads. Fitted to 4 of 18.
  double eye_length_sd = 0.13;
  /// How much too far a rod is bent at first, per metre of it. Ten surgeons without a template bent
  /// rods of 125 mm by 18.9° too far, whether 40°, 60° or 80° were wanted (Sardi et al. 2023,
  /// Global Spine J 13:425). With templates it was 0.2° too little, so none is assumed in the arm
  /// with the template.
  double eye_overbend_rad_per_m = 2.64;
  /// Relative SD of a bend made after a look at the heads, in its plane and across it. Estimate.
  double eye_bend_sd = 0.3;
  double eye_place_m = 0.002;  ///< SD of where along the rod a bend is set. Estimate

  // The touches before instructions are made; none of these values is fitted. The other arms touch
  // as published.

  /// The ball at the pointer's end is put into the drive socket of each screw. False: on top of the
  /// head, as in the arm with the template.
  bool in_socket = true;
  /// SD of that ball in the socket. Estimate (0.2 to 0.5 mm): a ball of 1 mm has 0.2 mm of play in
  /// a landmark made for it, and a socket is wider.
  double socket_seating_m = 0.0003;
  /// SD of what navigation adds to one head and not to the others, the same for all touches of a
  /// head. Measured with a patient reference: 0.11 mm (`bench_rod_heads --reference`); the
  /// pointer's tip, off by 0.5 mm and held 10° differently from head to head, adds 0.09 mm. What
  /// all heads have in common, 0.7 mm, moves the rod as a whole. Rounded up.
  double neighbour_navigation_m = 0.00015;
  /// Of each head; its place is their mean. Rods of `long_rod_heads` and more are not expected to
  /// lie within 1.0 mm of every head after one touch each (nav::rod_expectation).
  int head_touches = 1;
  int long_rod_touches = 2;
  std::size_t long_rod_heads = 5;

  // The instructions; none of these values is fitted.

  /// Relative error of the stated spring-back, SD over rods; the same for all bends of a rod.
  double spring_back_error = 0.10;
  /// SD of setting the bender. Estimate: half of a division of 2°.
  double bender_setting_rad = 1.0 * kRadiansPerDegree;
  /// SD of turning the rod to a roll. Estimate: 0.15 mm off the line on a 5.5 mm rod.
  double roll_setting_rad = 3.0 * kRadiansPerDegree;
  /// Both ends are marked where the middles of the end seats will be, and the rod is laid by these
  /// marks instead of by eye.
  bool ends_marked = true;
  /// SD of laying it so. Estimate: each mark is laid off and seen to 0.5 mm, and there are two.
  double placing_by_marks_m = 0.0005;

  // The hand, in all arms.

  /// Relative error in judging the elastic recovery of a bend, SD. Estimate.
  double recovery_error = 0.25;
  double cutting_m = 0.0005;  ///< SD of the cut at its mark. Estimate
  double placing_m = 0.001;   ///< SD of laying the rod so that both ends overhang equally. Estimate
  /// Across the rod; a head farther off than this is missed. Half of the 5 mm by which a rod must
  /// not be forced down (Paik et al. 2013, Spine J 13:1617).
  double missed_m = 0.0025;
  int most_rebends = 8;  ///< Estimate
  /// Multiplies the estimated durations. Fitted to 465 s: either the steps take longer than
  /// estimated, or there are more of them than modelled.
  double pace = 2.16;
  /// Relative SD of the pace over rods, the same for a rod in both arms.
  double pace_sd = sim::ErrorModel{}.pace_sd;
  RodStepDurations durations;

  /// Everything wrong with the numbers, one line each: name, value, limit. Empty: fine.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// The spring-back of a bend: the recovered curvature of a round rod in plastic bending, 1.70 ·
/// 2σ_y / (E d), over the width of the bend; 4.7° by default.
[[nodiscard]] double elastic_recovery_rad(const RodExperimentOptions& options);

/// One finished rod in the heads. It is cut only once, so a wrong length stays.
struct BentRod {
  std::size_t heads = 0;
  double length_m = 0.0;
  double first_overhang_m = 0.0;  ///< negative: does not reach its seat
  double last_overhang_m = 0.0;
  bool right_length = false;     ///< both overhangs lie within the limits
  double first_try_m = 0.0;      ///< mean distance of the seats, across the rod, at the first try
  double head_distance_m = 0.0;  ///< the same in the end
  int rebends = 0;
  double time_s = 0.0;
};

struct RodArm {
  std::vector<BentRod> rods;
  std::size_t right_lengths = 0;
  std::size_t rebends = 0;
  double mean_time_s = 0.0;
  double time_sd_s = 0.0;
  double mean_first_try_m = 0.0;
  double mean_head_distance_m = 0.0;
};

/// Two arms over the same spines, and the differences with minus without the template, pair by
/// pair.
struct RodExperiment {
  RodArm with_template;
  RodArm control;
  MeanInterval time_s;
  MeanInterval head_distance_m;  ///< in the end
  MeanInterval first_try_m;
  MeanInterval right_length;  ///< of the fractions
};

/// One rod bent as instructed, with its distances from the heads at the first try, before any
/// bending by eye.
struct InstructedRod {
  BentRod rod;
  std::optional<std::size_t> bends;  ///< absent: no instructions, so bent with the template
  double off_touched_m = 0.0;        ///< the farthest seat, as touched
  double off_heads_m = 0.0;          ///< the farthest true seat
  double expected_within = 0.0;      ///< probability of `kInstructedLimit_m`, stated before bending
};

/// The accuracy that instructions should reach at every head.
inline constexpr double kInstructedLimit_m = 0.001;

struct InstructedRods {
  RodArm arm;
  std::vector<InstructedRod> rods;
  std::size_t refused = 0;            ///< had no instructions
  std::size_t bends = 0;              ///< instructed, of all
  std::size_t within_of_touched = 0;  ///< every seat as touched within `kInstructedLimit_m`
  std::size_t within_of_heads = 0;    ///< every true seat
  double expected_within = 0.0;       ///< of those with instructions, as stated before bending
};

/// Bends `rods` rods with a template (heads touched, length and bends from `nav::rod_template` and
/// `nav::rod_cut`, every bend compared with the hologram) and the same number by eye, for the same
/// heads. In both arms the rod is then tried in the heads and the worst bend bent again by eye, as
/// long as a head is missed. The experiment of Wanivenhaus et al. (2019, Spine J 19:1687) with our
/// magnitudes. The same options and seed give the same result; rod k is the same however many there
/// are. `options.check()` must find nothing.
[[nodiscard]] RodExperiment run_rod_experiment(const RodExperimentOptions& options,
                                               std::uint64_t seed);

/// The same rods with the same touches, bent according to `nav::rod_instructions` on a bender with
/// a scale: each rod springs back by `spring_back_error` (SD) more or less than stated. It is
/// then tried in the heads, and bent again by eye as in the other arms.
[[nodiscard]] InstructedRods run_instructed_rods(const RodExperimentOptions& options,
                                                 std::uint64_t seed);

}  // namespace orthonav::engine

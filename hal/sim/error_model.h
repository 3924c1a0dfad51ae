#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orthonav::sim {

/// Every imperfection of the simulated operating room. `perfect()` has all of them at zero. Each
/// line says where its default comes from: a measurement, a publication, or our own estimate
/// ("a guess": not published for this device or this hand). For vectors, SD is per axis.
/// docs/accuracy.md discusses which of them decide the outcome.
struct ErrorModel {
  // The camera: HoloLens 2 front cameras. Grey values are of 255.

  /// Gaussian SD of lens and pixel cross-talk, in addition to the pixel's own square. Estimate:
  /// edges in published frames of these cameras rise over about two pixels.
  double blur_sigma_px = 0.7;
  /// Duration of the exposure, which decides motion blur. Estimate for a lit operating field.
  double exposure_s = 0.004;
  /// Fraction of light lost in the corner of the image. Estimate; wide lenses lose up to cos⁴.
  double vignetting = 0.3;
  /// Variance of a grey value per grey value: photon statistics of a full well of about 2,500
  /// electrons, small pixels at some gain. Estimate.
  double shot_noise = 0.1;
  /// SD of a grey value in the dark. Estimate.
  double read_noise_grey = 1.0;

  // The calibration that the device reports, compared with the true one. One real unit's factory
  // calibration was off by 0.6 px across the epipolar lines; the first four give an SD
  // of 0.28 px there, and an SD of depth of 1.5 mm at arm's length.

  double calibration_focal_ratio = 0.0007;   ///< SD, per camera
  double calibration_centre_px = 0.15;       ///< SD, per camera and axis
  double calibration_rotation_rad = 0.0005;  ///< SD per axis, right relative to left camera
  double calibration_baseline_m = 0.00015;   ///< SD per axis of the right camera's position
  /// SD of a radial error of the lens at the image's corner, per camera; it grows with the cube of
  /// the distance from the middle. Estimate: what a calibration with a board leaves there.
  double calibration_distortion_px = 0.3;

  // The head and the map.

  /// SD of the head's position below 0.5 Hz. Estimate for a surgeon bending over the table; more
  /// than the quiet standing of posturography (Winter 1995), since hands and eyes are at work.
  double head_sway_m = 0.012;
  double head_sway_rad = 0.03;  ///< SD of its rotation, likewise
  /// SD of the reported head pose from frame to frame. Estimate: static jitter of inside-out
  /// trackers lies below a millimetre.
  double head_pose_noise_m = 0.0005;
  double head_pose_noise_rad = 0.0003;
  /// Fraction of that variance that lasts for seconds instead of being new in every frame.
  /// Estimate: a tracker smooths over many frames, so its error is far from white.
  double head_pose_lasting = 0.5;
  /// Random walk of World relative to the room: 1 mm and half a milliradian after 100 s. The low
  /// end of what is reported (0.1 to 0.5 mm/sqrt(s)): with 0.3 the surfaces of the paper would not
  /// have fitted as they did.
  double map_drift_m_per_sqrt_s = 0.0001;
  double map_drift_rad_per_sqrt_s = 0.00005;
  /// Occasionally the map corrects itself in one step: SD per axis, and how often. Estimate.
  double map_step_m = 0.0005;
  double map_steps_per_min = 0.5;

  // The tools as the planning file describes them, compared with the real ones.

  /// SD of the tip after a pivot calibration with such cameras. Estimate.
  double tip_calibration_m = 0.0005;
  /// SD of the axis about the two directions across it: a printed tool, made by hand (0.005 to
  /// 0.017).
  double axis_calibration_rad = 0.010;
  /// Relative SD of a printed tag's size against the size that is stated (0.001 to 0.01).
  double tag_scale = 0.003;
  /// SD of the height of a tag's edges above its middle, for a print glued to a plate by hand (0 to
  /// 0.3 mm). Estimate.
  double tag_bow_m = 0.0001;
  /// The light of the lamp that a tag mirrors in the worst direction, relative to what white paper
  /// scatters (0 to 0.6). Estimate for a matt laser print; a laminated one mirrors more.
  double tag_gloss = 0.15;

  // The light.

  /// Amplitude of the lamp's light at twice the mains frequency, relative to its mean. IEEE
  /// 1789-2015 allows at most 0.08 at 100 Hz; a surgical lamp on smoothed current has a fraction of
  /// that.
  double light_flicker = 0.02;

  // The model relative to the bone it was made from.

  /// RMS distance of the preoperative surface from the bone (0.3 to 0.8 mm).
  double model_error_m = 0.0005;
  /// Correlation length of that distance (5 to 10 mm).
  double model_error_length_m = 0.007;

  // The patient. All zero: a phantom on a table.

  /// Mean thickness of the soft tissue left on the stroked surface: thick in valleys, thin on
  /// ridges. 1 mm: a spine that was dissected in a hurry.
  double tissue_m = 0.0;
  /// Peak-to-peak motion of the spine with a breath where it moves most (1.96 +- 1.32 mm in ten
  /// patients); other levels move less (spine_motion.h).
  double breathing_m = 0.0;
  double breathing_hz = 0.0;
  /// How far it gives way under the instrument (1.55 +- 1.13 mm).
  double push_m = 0.0;
  /// The fraction of such a push by which the neighbouring vertebra, and a reference on it, moves
  /// too (0.5 to 0.9); two levels away it is the square. Estimate.
  double push_reaching_reference = 0.7;
  /// Mean number of drops of blood on a tag (0 to 2), and how wide one is. Estimates.
  double drops_per_tag = 0.0;
  double drop_m = 0.003;

  // The hand and the surgeon.

  /// SD of the tip at 8-12 Hz, the band of physiological tremor (Elble and Koller 1990); the
  /// amplitude of a hand at rest on the patient is our estimate.
  double tremor_m = 0.0003;
  double tremor_rad = 0.003;  ///< SD of the tool's rotation, likewise
  /// RMS height of the tip above the bone while stroking: soft tissue and lift-off; never below the
  /// bone. Uncertain; the published registration RMSE was matched
  /// with it (docs/accuracy.md).
  double stroke_lift_m = 0.0020;
  /// Relative SD of that height over surgeons: some press, others glide. Fitted to the SD of the
  /// published registration RMSE.
  double stroke_lift_sd = 0.18;
  /// The longest wavelength of that height along the path; the shortest is a quarter of it. A
  /// guess; measured strokes have a longer one.
  double stroke_lift_length_m = 0.030;
  /// SD of the tip's height above the bone when a single place is touched: pressed slowly through
  /// soft tissue, it is a fraction of the height while stroking; never below the bone. Estimate.
  double touch_lift_m = 0.0003;
  /// SD along each axis of the pointer's tip when it is put into the same landmark of the bone
  /// again. Estimate: the play of a 1 mm ball in the hole of an awl.
  double landmark_seating_m = 0.0002;
  /// Relative SD of the stroking speed from region to region. Estimate.
  double stroke_pace_sd = 0.05;
  /// Fraction of strokes that slip off the bone, are noticed, deleted and repeated. Estimate.
  double bad_stroke_probability = 0.1;
  /// At its worst, such a stroke leaves the bone by half to all of this: far enough to be noticed
  /// compared with the usual height of strokes. Estimate. It is always deleted, so it only costs
  /// time.
  double bad_stroke_lift_m = 0.008;
  /// How far the recognizer's mean confidence in a command is below 1, and its SD. Estimate for an
  /// offline recognizer with a small vocabulary.
  double voice_doubt = 0.10;
  double voice_doubt_sd = 0.03;
  /// SD of placing the tip on the perceived entry. Estimate.
  double entry_pick_m = 0.0004;
  /// The guide's first direction is off by half to all of this, before any reading: by eye, a tool
  /// is aligned with a line in space to several degrees. Estimate. The surgeon corrects it
  /// afterwards.
  double first_guess_rad = 0.14;
  /// SD of the pointer's tip relative to the middle of a screw head's top, which is a few
  /// millimetres wide. Estimate, the same as for picking an entry.
  double head_pick_m = 0.0008;
  /// The surgeon pierces when the deviation seen stays within this, and misreads the remainder with
  /// this SD about each direction across the axis: 0.3°, three steps of the readout's last digit.
  double angle_reading_rad = 0.005;
  /// SD of where a hologram is perceived across the line of sight, constant during one placement:
  /// vergence, focus and eye calibration (1.3 to 2.5 mm; Condino et al. 2020 measured 2.3 mm for
  /// touching a hologram with a tip, 0.9 mm for a real target).
  double overlay_perception_m = 0.0013;
  /// Factor by which that error is larger along the line of sight. Vergence alone gives 2 to 3;
  /// with a tip that rests on the bone, seen while the head moves, it is smaller. Fitted to the
  /// entry error of Liebmann 2019.
  double perception_depth_ratio = 1.25;
  /// SD of comparing model and bone when verifying: looking from more than one side reveals half of
  /// the error of a single view. Estimate.
  double overlay_comparison_m = 0.00065;
  /// SD of the direction in which a tool is held along a hologram without a number, about each
  /// direction across it. Estimate: from the perceived places of two ends 100 mm apart.
  double overlay_aligning_rad = 0.02;
  /// How often a number is misread by a degree or a millimetre. Estimate.
  double misreading_probability = 0.01;
  /// SD of the wire's axis, about each direction across it, from a hand that turns while it drills:
  /// without a number to correct by (0.015 to 0.035), and in total with one (0.008 to 0.018).
  /// drilling.h says how correction leads from the first to the second.
  double hand_drilling_rad = 0.028;
  double hand_drilling_corrected_rad = 0.014;

  // The instrument. These values are for an unsupported K-wire; `instruments.h` holds others.

  /// SD of the tip's slip along the cortex at piercing: a sharp tip, or one in a sleeve (0.2 to
  /// 0.6); a blunt one on a facet slips by 1.2 mm.
  double wire_skiving_m = 0.0004;
  /// SD of the bending about each direction across it while it is driven (0.02 to 0.04; in a
  /// cannula or as a drill in a sleeve 0.004 to 0.012).
  double wire_bending_rad = 0.03;
  /// SD of a sleeve's direction relative to that of a wire in it: the play of a long sleeve, 0.25°.
  /// Estimate.
  double sleeve_play_rad = 0.0044;
  /// SD of how far a screw deviates from the hole made for it (0.02 to 0.06); zero for an
  /// instrument that makes its own hole.
  double hole_following_rad = 0.0;
  /// Speed of the median surgeon; 1 is that of the publication (Liebmann et al. 2019: 125 s and
  /// 1,983 points per level), so it is an input here and not a finding.
  double pace = 1.0;
  /// Relative SD of the duration over surgeons; 0.2 gives the published 27 s and 404 points.
  double pace_sd = 0.2;

  static ErrorModel perfect();
  /// The documented errors up to the headset's display; the eye, the aiming hand and the wire are
  /// perfect. The remaining errors of an operation are those of navigation.
  static ErrorModel navigation_alone();
  /// Everything wrong with the numbers, one line each: name, value, limit. Empty: fine.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::sim

#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/patient_axes.h"
#include "nav/guidance/screw.h"
#include "nav/registration/check_points.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// A registration with all its inputs, for reports and drawings.
struct RegisteredLevel {
  std::string label;   ///< empty if unknown
  std::string method;  ///< empty if stated elsewhere
  std::shared_ptr<const nav::VertebraModel> model;
  std::vector<nav::ScrewPlan> screws;
  std::vector<Point<World>> points;  ///< in the order of time
  nav::Registration registration;
  double tip_radius_m = 0.0;
  std::vector<nav::CheckPoint> check_points;  ///< touched to verify it; not used in the fit
};

/// The uncertainty of a registration at one place. Infinite, without covariance, if the points
/// leave a motion of the bone undetermined.
struct PlaceError {
  double rms_m = 0.0;
  double within_95_m = 0.0;                            ///< 95 % of errors are smaller
  std::optional<std::array<double, 9>> covariance_m2;  ///< by rows, axes of Vertebra (LPS)
};

struct ScrewErrors {
  nav::Side side = nav::Side::kLeft;
  PlaceError entry;
  PlaceError target;
};

/// One for each screw, in their order.
[[nodiscard]] std::vector<ScrewErrors> errors_at_screws(const RegisteredLevel& level);
/// The worst at any entry or target; the registration's own value if no screw is known.
[[nodiscard]] double worst_rms_m(const RegisteredLevel& level);
/// Absent if unknown: `paper` without screws.
[[nodiscard]] std::optional<double> worst_within_95_m(const RegisteredLevel& level);

/// How far the next best pose is from the accepted one.
struct RunnerUpDistance {
  double apart_m = 0.0;       ///< at the worst of the entries and targets, or else of the surface
  double rotation_rad = 0.0;  ///< the angle between the two
};
/// Nothing if there was no other pose to compare with.
[[nodiscard]] std::optional<RunnerUpDistance> runner_up_distance(const RegisteredLevel& level);

/// Whether the method judges its pose and predicts errors; `paper` does neither.
[[nodiscard]] inline bool is_judged(const nav::Registration& r) { return r.noise_m > 0.0; }
/// Whether the points tell the bone from its own mirror image. If not, a model or points with left
/// and right swapped would look the same.
[[nodiscard]] bool sides_told_apart(const nav::Registration& r);
/// Whether another pose is possible, in words, and what could not be checked.
[[nodiscard]] std::string ambiguity_of(const RegisteredLevel& level);
/// The sources of expected errors in addition to the registration's own.
[[nodiscard]] std::string sources_of(const nav::CommonErrors& common);
/// How certain the registration is, in plain sentences: the error that 95 % stay below, the
/// least certain motion, and where to stroke to improve it.
[[nodiscard]] std::string certainty_of(const RegisteredLevel& level);

/// The axes and units of the numbers in a JSON file.
struct FigureFrame {
  Axes model_axes = Axes::kLps;  ///< of the model's file
  double points_unit_m = 1e-3;   ///< of the points, and of the matrices
};

/// From the model (its file's axes, the points' unit) to the points: 4x4 by rows.
[[nodiscard]] std::array<double, 16> model_to_points(const Transform<World, Vertebra>& pose,
                                                     const FigureFrame& frame);

/// All figures in the form that docs/file-formats.md describes.
[[nodiscard]] nlohmann::ordered_json registration_json(const RegisteredLevel& level,
                                                       const FigureFrame& frame);

}  // namespace orthonav::engine

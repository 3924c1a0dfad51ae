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

/// A registration with everything that it was made of, for reports and drawings.
struct RegisteredLevel {
  std::string label;   ///< empty where none is known
  std::string method;  ///< empty where that is told elsewhere
  std::shared_ptr<const nav::VertebraModel> model;
  std::vector<nav::ScrewPlan> screws;
  std::vector<Point<World>> points;  ///< in the order of time
  nav::Registration registration;
  double tip_radius_m = 0.0;
  std::vector<nav::CheckPoint> check_points;  ///< touched to verify it; not used in the fit
};

/// What a registration leaves uncertain at one place. Infinite, without covariance, where the
/// points leave a motion of the bone open.
struct PlaceError {
  double rms_m = 0.0;
  double within_95_m = 0.0;                            ///< 95 of 100 errors are smaller
  std::optional<std::array<double, 9>> covariance_m2;  ///< by rows, axes of Vertebra (LPS)
};

struct ScrewErrors {
  nav::Side side = nav::Side::kLeft;
  PlaceError entry;
  PlaceError target;
};

/// One for each screw, in their order.
[[nodiscard]] std::vector<ScrewErrors> errors_at_screws(const RegisteredLevel& level);
/// The worst at any entry or target; the registration's own value where no screw is known.
[[nodiscard]] double worst_rms_m(const RegisteredLevel& level);
/// Absent where it is not known: `paper` without screws.
[[nodiscard]] std::optional<double> worst_within_95_m(const RegisteredLevel& level);

/// How far the next best pose is from the accepted one.
struct RunnerUpDistance {
  double apart_m = 0.0;     ///< at the worst of the entries and targets, or else of the surface
  double turned_rad = 0.0;  ///< the angle between the two
};
/// Nothing when no other pose was left to compare with.
[[nodiscard]] std::optional<RunnerUpDistance> runner_up_distance(const RegisteredLevel& level);

/// Whether another pose could be meant, in words.
[[nodiscard]] std::string ambiguity_of(const RegisteredLevel& level);
/// What is in the errors to expect beside the registration's own.
[[nodiscard]] std::string sources_of(const nav::CommonErrors& common);
/// How certain the registration is, in plain sentences: what 95 of 100 errors are below, the motion
/// known worst, and where to stroke to know it better.
[[nodiscard]] std::string certainty_of(const RegisteredLevel& level);

/// How the numbers of a JSON file are to be read.
struct FigureFrame {
  Axes model_axes = Axes::kLps;  ///< of the model's file
  double points_unit_m = 1e-3;   ///< of the points, and of the matrices
};

/// From the model (its file's axes, the points' unit) to the points: 4x4 by rows.
[[nodiscard]] std::array<double, 16> model_to_points(const Transform<World, Vertebra>& pose,
                                                     const FigureFrame& frame);

/// Every figure as docs/file-formats.md describes them.
[[nodiscard]] nlohmann::ordered_json registration_json(const RegisteredLevel& level,
                                                       const FigureFrame& frame);

}  // namespace orthonav::engine

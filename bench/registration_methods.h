#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/transform.h"
#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::bench {

/// A vertebra prepared once, and the places where errors are measured.
struct BenchLevel {
  std::string case_name;
  std::string label;
  nav::TriangleMesh mesh;
  std::vector<nav::ScrewPlan> screws;
  std::shared_ptr<const nav::VertebraModel> model;
  double prepare_ms = 0.0;
  std::vector<nav::NeighbourLevel> neighbours;  ///< every other one of the same patient

  [[nodiscard]] std::string name() const { return case_name + "/" + label; }
};

/// The result of a method for one set of strokes.
struct Fitted {
  bool found = false;
  Transform<World, Vertebra> world_from_vertebra;
  bool accepted = false;
  std::string reason;  ///< why it was not accepted
  double rmse_m = 0.0;
  std::string fits_better;  ///< label of another level that the points fit as well or better
  /// For methods that predict their errors: covariance of the error at a place, by rows, m².
  std::function<Mat3(Point<Vertebra>)> covariance;
};

/// Fits one level to points and their times, which may be empty. Not thread-safe, but several may
/// run at the same time.
using Fit = std::function<Fitted(std::span<const Point<World>>, std::span<const double> times_s)>;

struct RegistrationMethod {
  std::string name;
  /// Does all the work that is possible before the strokes are known.
  std::function<Fit(const BenchLevel&)> prepare;
  /// Peers do not judge their own result: theirs count as accepted by one rule, the RMSE alone.
  bool judges = false;
};

/// Ours, then the peers found when the build was configured. `common_m`: the SD along an axis,
/// given to `best`, of a shift that all points share.
[[nodiscard]] std::vector<RegistrationMethod> registration_methods(double common_m);

}  // namespace orthonav::bench

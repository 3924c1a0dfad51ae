#include "engine/study/sensitivity_regression.h"

#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/mutex.h"
#include "base/random.h"
#include "engine/case/operation_plan.h"
#include "engine/report/report_values.h"
#include "engine/study/on_threads.h"
#include "nav/evaluation/errors.h"
#include "nav/statistics/linear_regression.h"

namespace orthonav::engine {
namespace {

constexpr double kHalfWidth = 1.96;

/// Notes the mean errors of the operation's screws; false if it has none.
bool note_errors(const OperationResult& result, RandomPoint& point) {
  const auto report = nlohmann::json::parse(report_json(result), nullptr, false);
  const auto entries = values_of(report, "entry_error_mm", true);
  const auto angles = values_of(report, "angle_error_deg", true);
  if (entries.empty() || angles.empty()) {
    return false;
  }
  point.entry_mm = nav::summarize(entries).mean;
  point.angle_deg = nav::summarize(angles).mean;
  return true;
}

/// The operations at all places, on several threads; each depends on its number alone.
class Points {
 public:
  Points(const Case& source, const Operation& planned, const SensitivityOptions& options,
         const std::function<void(int, int)>& progress)
      : source_(source),
        planned_(planned),
        options_(options),
        magnitudes_(studied_magnitudes(options.operation.sim.error_model)),
        progress_(progress),
        points_(static_cast<std::size_t>(options.points)) {}

  Status run() {
    on_threads(options_.jobs, [this] { work(); });
    const MutexLock lock(mutex_);
    return failed_;
  }
  [[nodiscard]] std::vector<RandomPoint> found() const {
    std::vector<RandomPoint> out;
    for (const auto& point : points_) {
      if (point) {
        out.push_back(*point);
      }
    }
    return out;
  }

 private:
  void work() {
    for (std::size_t i = next_++; i < points_.size(); i = next_++) {
      OperationOptions operation = options_.operation;
      operation.sim.seed = options_.seed + i;
      operation.tracker.parallel = false;
      operation.session.live_clearance = false;
      Random random = Random(options_.seed).fork("random points").fork(i);
      RandomPoint point;
      for (const sim::Magnitude* m : magnitudes_) {
        point.place.push_back(random.uniform());
        operation.sim.error_model.*m->value = m->low + point.place.back() * (m->high - m->low);
      }
      const auto result = run_operation(source_, planned_, operation);
      if (result && note_errors(*result, point)) {
        points_[i] = std::move(point);
      }
      count(result ? Status() : Status(result.error()));
    }
  }

  void count(const Status& made) {
    const MutexLock lock(mutex_);
    ++done_;
    if (!made) {
      failed_ = made;
      next_ = points_.size();
    }
    if (progress_) {
      progress_(done_, options_.points);
    }
  }

  const Case& source_;
  const Operation& planned_;
  const SensitivityOptions& options_;
  std::vector<const sim::Magnitude*> magnitudes_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_ = 0;
  Mutex mutex_;
  std::vector<std::optional<RandomPoint>> points_;  ///< each written by the thread that works on it
  Status failed_ ORTHONAV_GUARDED_BY(mutex_);
  int done_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace

std::vector<Sensitivity> regressed(std::span<const sim::Magnitude* const> magnitudes,
                                   std::span<const RandomPoint> points) {
  if (points.size() < fewest_points(magnitudes.size())) {
    return {};
  }
  std::vector<double> places;
  std::vector<double> entry_mm;
  std::vector<double> angle_deg;
  for (const RandomPoint& point : points) {
    places.push_back(1.0);
    places.insert(places.end(), point.place.begin(), point.place.end());
    entry_mm.push_back(point.entry_mm);
    angle_deg.push_back(point.angle_deg);
  }
  const nav::LinearRegression of_entry = nav::linear_regression(places, entry_mm);
  const nav::LinearRegression of_angle = nav::linear_regression(places, angle_deg);
  if (of_entry.slopes.empty() || of_angle.slopes.empty()) {
    return {};
  }
  std::vector<Sensitivity> out;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    const sim::Magnitude& m = *magnitudes[i];
    out.push_back({std::string(m.name), std::string(m.unit), m.low, m.high, of_entry.slopes[i + 1],
                   of_angle.slopes[i + 1], kHalfWidth * of_entry.standard_errors[i + 1],
                   kHalfWidth * of_angle.standard_errors[i + 1]});
  }
  sort_by_effect(out);
  return out;
}

Result<std::vector<Sensitivity>> regressed_sensitivities(
    const Case& source, const SensitivityOptions& options, std::size_t& used,
    const std::function<void(int, int)>& progress) {
  const auto magnitudes = studied_magnitudes(options.operation.sim.error_model);
  const std::size_t fewest = fewest_points(magnitudes.size());
  if (options.points < static_cast<int>(fewest)) {
    return Error{"--points " + std::to_string(options.points) + ": at least " +
                 std::to_string(fewest) + " needed, for " + std::to_string(magnitudes.size()) +
                 " magnitudes"};
  }
  ModelCache models;
  const auto planned = plan_operation(source, options.operation.levels, models);
  if (!planned) {
    return planned.error();
  }
  Points points(source, *planned, options, progress);
  if (const Status made = points.run(); !made) {
    return made.error();
  }
  const std::vector<RandomPoint> found = points.found();
  used = found.size();
  if (used < fewest) {
    return Error{"--points " + std::to_string(options.points) + ": " + std::to_string(used) +
                 " operations placed a screw, at least " + std::to_string(fewest) + " needed"};
  }
  return regressed(magnitudes, found);
}

}  // namespace orthonav::engine

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/session/method.h"
#include "engine/session/work_watch.h"
#include "nav/tracking/worker.h"

namespace orthonav::engine {

/// What a registration is computed from, as it was when it was asked for, and what was found.
struct RegistrationJob {
  OperatedLevel level;
  std::vector<Point<World>> points;
  std::vector<double> sds_m;
  std::vector<Vec3> shafts;
  nav::CommonErrors common;
  Timestamp asked{};
  std::optional<Result<nav::Registration>> found;
};

/// Computes registrations beside the frame loop, one after the other. One thread at a time.
class Registering {
 public:
  explicit Registering(Registrar registrar) : registrar_(std::move(registrar)) {}
  Registering(const Registering&) = delete;
  Registering& operator=(const Registering&) = delete;

  /// Sets the watch to be notified when a registration begins and ends; null: none. Borrowed.
  void watch(WorkWatch* watch);
  /// Computes it at once, on this thread.
  [[nodiscard]] RegistrationJob now(RegistrationJob job) const;
  /// Begins it beside this thread, once an earlier one that was forgotten has ended.
  void begin(RegistrationJob job);
  /// Its answer is no longer wanted.
  void forget();
  /// Once for each pair: the answer, when it is there. Never waits. What ended a registration by an
  /// exception is thrown here.
  [[nodiscard]] std::optional<RegistrationJob> answer();

 private:
  void start();

  Registrar registrar_;
  WorkWatch* watch_ = nullptr;
  std::optional<RegistrationJob> asked_;  ///< and not begun yet
  bool wanted_ = false;                   ///< the answer of the one under way
  bool under_way_ = false;
  RegistrationJob job_;                  ///< the worker's while under way
  std::unique_ptr<nav::Worker> worker_;  ///< from the first one on; ends first
};

}  // namespace orthonav::engine

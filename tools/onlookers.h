#pragma once

#include "tools/dashboard.h"
#include "tools/event_log.h"
#include "tools/igtl_stream.h"

namespace orthonav::tools {

/// `--log`, `--verbose`, `--web` and `--igtl`, of the commands that run an operation.
struct OnlookerArguments {
  EventLogArguments log;
  DashboardArguments web;
  IgtlArguments igtl;

  void add_to(CLI::App& command);
};

/// Whoever looks on while an operation runs, and has no part in it: the log, the dashboard, the
/// clients of OpenIGTLink.
class Onlookers {
 public:
  Status open(const OnlookerArguments& arguments);
  /// From now on they see this operation, which must outlive its run. `limits` decide what is
  /// green.
  void watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits);
  /// The run is over; null: it failed. Says on standard error who was served.
  void ended(const engine::LoopReport* report);
  [[nodiscard]] EventLog& log() { return log_; }

 private:
  EventLog log_;
  Dashboard web_;
  IgtlStream igtl_;
};

}  // namespace orthonav::tools

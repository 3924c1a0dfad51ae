#pragma once

#include <CLI/App.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "engine/live/assembled_operation.h"
#include "tools/status_changes.h"

namespace orthonav::tools {

struct DashboardArguments {
  std::optional<int> port;  ///< none: nothing is served; 0: any that is free

  void add_to(CLI::App& command);
};

/// A page in a browser that shows an operation while it runs: step, numbers, levels, tools,
/// messages and what the left camera sees. Served on this machine only, and read only: nothing that
/// a browser sends reaches the operation.
class Dashboard : public engine::LoopObserver {
 public:
  Dashboard();
  ~Dashboard() override;
  /// Serves at the port from now on, and says where on standard error.
  Status open(const DashboardArguments& arguments);
  /// From now on what happens in this operation, which must outlive the run.
  void watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits);
  void stepped(const StereoFrame& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  [[nodiscard]] int port() const;

 private:
  class Server;

  void note_changes();

  std::unique_ptr<Server> server_;  ///< null: nobody looks on
  const engine::Session* session_ = nullptr;
  engine::GradeLimits limits_;
  std::optional<Timestamp> told_at_;
  StatusChanges changes_;
  std::deque<std::string> messages_;  ///< the newest first
};

}  // namespace orthonav::tools

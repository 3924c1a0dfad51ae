#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "engine/live/assembled_operation.h"
#include "tools/orthonav/dashboard/status_changes.h"

namespace CLI {
class App;
}

namespace orthonav::tools {

struct DashboardArguments {
  std::string at;          ///< "PORT" or "ADDRESS:PORT", port 0: any; empty: nothing is served
  std::string token_file;  ///< with the token that a browser must send; empty: none

  void add_to(CLI::App& command);
};

/// A page in a browser that shows a running operation: step, numbers, levels, tools, messages and
/// the view, which is the latest picture given to `show` or else the left camera's image. Served on
/// this machine, or elsewhere with a token (`WebAccess`), and read-only: nothing that a browser
/// sends reaches the operation.
class Dashboard : public engine::LoopObserver {
 public:
  Dashboard();
  ~Dashboard() override;
  /// Starts serving at the port, and prints the address on standard error.
  Status open(const DashboardArguments& arguments);
  /// From now on shows this operation, which must outlive the run.
  void watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits);
  void watch(const engine::Session& session, const engine::GradeLimits& limits);
  /// The left camera's image is shown as these cameras see it; without them it is not.
  void look_through(const StereoCalibration& cameras);
  /// Whether the page is served, and whether someone looks at the view now. From any thread.
  [[nodiscard]] bool is_open() const { return server_ != nullptr; }
  [[nodiscard]] bool looked_at() const;
  /// Shows a picture with the holograms until it is old. `what` describes it. From any thread.
  void show(const RgbaImage& picture, const std::string& what);
  void pair_came(const StereoFrame& pair) override { left_ = &pair.left; }
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void withdrawn(const engine::Guidance& guidance) override;
  void part_stalled(engine::Part part) override;
  [[nodiscard]] int port() const;

 private:
  class Server;

  void note_changes();

  std::unique_ptr<Server> server_;  ///< null: nothing is served
  const engine::Session* session_ = nullptr;
  engine::GradeLimits limits_;
  const GreyImage* left_ = nullptr;  ///< the newest pair's; null: there are no cameras
  std::optional<Timestamp> told_at_;
  StatusChanges changes_;
  std::deque<std::string> messages_;  ///< the newest first
};

}  // namespace orthonav::tools

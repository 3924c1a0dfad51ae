#pragma once

#include <memory>

#include "tools/camera_view.h"
#include "tools/dashboard.h"
#include "tools/event_log.h"
#include "tools/igtl_stream.h"
#include "tools/surgeon_view.h"

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
  /// For a run that has no picture of its own: draws the holograms over the left camera for the
  /// dashboard. `display` is where the operation draws for the surgeon; null: nowhere.
  void draw_over_camera(engine::AssembledOperation& operation, const StereoCalibration& cameras,
                        engine::SnapshotSink* display);
  /// Whether they want snapshots.
  [[nodiscard]] bool draw() const { return web_.is_open(); }
  /// Takes pictures of what the surgeon sees, for the dashboard.
  [[nodiscard]] PictureSink* pictures() { return &pictures_; }
  /// The run is over; null: it failed. Says on standard error who was served.
  void ended(const engine::LoopReport* report);
  [[nodiscard]] EventLog& log() { return log_; }

 private:
  /// Hands pictures on while somebody looks.
  class Pictures : public PictureSink {
   public:
    explicit Pictures(Dashboard& web) : web_(web) {}
    Status picture(const RgbaImage& image, const engine::Snapshot& snapshot) override;

   private:
    Dashboard& web_;
  };

  EventLog log_;
  Dashboard web_;
  Pictures pictures_{web_};
  std::unique_ptr<CameraView> view_;
  IgtlStream igtl_{log_};
};

}  // namespace orthonav::tools

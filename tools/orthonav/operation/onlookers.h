#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "tools/orthonav/dashboard/camera_view.h"
#include "tools/orthonav/dashboard/dashboard.h"
#include "tools/orthonav/igtl/igtl_stream.h"
#include "tools/orthonav/operation/event_log.h"
#include "tools/orthonav/operation/surgeon_view.h"

namespace orthonav::tools {

/// `--log`, `--verbose`, `--web` and `--igtl`, of the commands that run an operation.
struct OnlookerArguments {
  EventLogArguments log;
  DashboardArguments web;
  IgtlArguments igtl;

  void add_to(CLI::App& command);
};

/// Observers of a running operation that have no part in it: the log, the dashboard, the
/// OpenIGTLink clients.
class Onlookers {
 public:
  Status open(const OnlookerArguments& arguments);
  /// From now on they observe this operation, which must outlive its run. `limits` decide what is
  /// green.
  void watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits);
  /// The headset's cameras, before the run.
  void look_through(const StereoCalibration& cameras) { web_.look_through(cameras); }
  /// For a run without its own picture: draws the holograms over the left camera's image for the
  /// dashboard. `display` draws for the surgeon; may be null.
  void draw_over_camera(engine::AssembledOperation& operation, const StereoCamera* cameras,
                        engine::SnapshotSink* display);
  /// Whether they want snapshots.
  [[nodiscard]] bool draw() const { return web_.is_open(); }
  /// Takes pictures of what the surgeon sees, for the dashboard.
  [[nodiscard]] PictureSink* pictures() { return &pictures_; }
  /// The run is over; null: it failed. Reports on standard error which clients were served.
  void ended(const engine::LoopReport& report);
  [[nodiscard]] EventLog& log() { return log_; }

 private:
  /// Passes on pictures while someone is looking.
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

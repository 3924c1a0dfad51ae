// How far the tracker of a method is off in a whole simulated operation, pair by pair, as CSV: from
// pixels, or from the measurement model that stands for them and was fitted to this table.
//   bench_tracking_errors --method best --seed 1 --measurement pixels > errors.csv
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

/// Passes a tracker's results on, and prints them beside the truth.
class Watched final : public nav::ToolTracker {
 public:
  Watched(std::unique_ptr<nav::ToolTracker> tracker, const sim::SimHeadset& room)
      : tracker_(std::move(tracker)), room_(room) {
    std::puts(
        "pair,time_s,tool,present,status,cameras,x_mm,y_mm,z_mm,turn_x_mrad,turn_y_mrad,"
        "turn_z_mrad,tip_x_mm,tip_y_mm,tip_z_mm,predicted_mm,predicted_mrad,facing,distance_m,"
        "speed_m_s");
  }

  std::span<const nav::ToolState> track(const StereoFrame& frame) override {
    const auto states = tracker_->track(frame);
    const sim::RoomState now = room_.state();
    for (const nav::ToolState& state : states) {
      print(frame, now, state);
    }
    before_ = now;
    return states;
  }
  [[nodiscard]] std::span<const nav::ToolGeometry> tools() const override {
    return tracker_->tools();
  }
  [[nodiscard]] std::optional<nav::StereoAlignment> alignment() const override {
    return tracker_->alignment();
  }
  [[nodiscard]] std::optional<nav::TagSize> tag_size(std::size_t tool) const override {
    return tracker_->tag_size(tool);
  }
  [[nodiscard]] double tag_size_difference_sd(std::size_t tool, std::size_t other) const override {
    return tracker_->tag_size_difference_sd(tool, other);
  }

 private:
  /// Errors are those of the pose in the rig, in the axes of the left camera.
  void print(const StereoFrame& frame, const sim::RoomState& now, const nav::ToolState& state) {
    const std::size_t i = state.tool;
    const auto left_from_rig = room_.actual_calibration().left_from_rig;
    const auto truth = now.room_from_rig.inverse() * now.room_from_marker[i];
    const Vec3 off =
        left_from_rig.rotation() * (state.rig_from_marker.translation() - truth.translation());
    const Vec3 rotation =
        left_from_rig.rotation() *
        vector_from_rotation(state.rig_from_marker.rotation() * truth.rotation().transposed());
    const Point<Marker> made = room_.room().tools[i].tip_in_marker;
    const Vec3 tip = left_from_rig.rotation() * (state.rig_from_marker * made - truth * made);
    const auto in_left = left_from_rig * truth;
    const double facing =
        -(in_left.rotation() * Vec3{0, 0, 1}).dot(in_left.translation().normalized());
    const double dt_s = seconds(now.time - before_.time);
    const double speed =
        before_.room_from_marker.size() > i && dt_s > 0.0
            ? (now.room_from_marker[i].translation() - before_.room_from_marker[i].translation())
                      .norm() /
                  dt_s
            : 0.0;
    const PoseCovariance& covariance = state.world_from_marker.covariance;
    std::printf(
        "%lld,%.4f,%zu,%d,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,"
        "%.3f,%.3f,%.3f\n",
        static_cast<long long>(frame.sequence), seconds(frame.time.time_since_epoch()), i,
        now.tool_present[i] ? 1 : 0, static_cast<int>(state.world_from_marker.status),
        state.cameras, off.x * 1e3, off.y * 1e3, off.z * 1e3, rotation.x * 1e3, rotation.y * 1e3,
        rotation.z * 1e3, tip.x * 1e3, tip.y * 1e3, tip.z * 1e3,
        translation_sigma_m(covariance) * 1e3, rotation_sigma_rad(covariance) * 1e3, facing,
        in_left.translation().norm(), speed);
  }

  std::unique_ptr<nav::ToolTracker> tracker_;
  const sim::SimHeadset& room_;
  sim::RoomState before_;
};

int run(const engine::OperationOptions& options) {
  engine::OperationHooks hooks;
  hooks.adapt = [](const sim::SimHeadset& room, engine::Method& method) {
    method.create_tracker = [make = method.create_tracker, &room](
                                const auto&... given) -> Result<std::unique_ptr<nav::ToolTracker>> {
      auto tracker = make(given...);
      if (!tracker) {
        return tracker.error();
      }
      return std::unique_ptr<nav::ToolTracker>(
          std::make_unique<Watched>(std::move(*tracker), room));
    };
  };
  const auto result = engine::run_operation(engine::phantom(), options, hooks);
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return 2;
  }
  std::fprintf(stderr, "completed %d, %lld pairs %s\n", result->completed ? 1 : 0,
               static_cast<long long>(result->loop.displayed), result->why_not.c_str());
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  CLI::App app("Errors of a tracker in a simulated operation, as CSV");
  orthonav::engine::OperationOptions options;
  std::string measurement = "pixels";
  app.add_option("--method", options.method, "best or paper");
  app.add_option("--seed", options.sim.seed, "of the room");
  app.add_option("--levels", options.levels, "levels to operate")->delimiter(',');
  app.add_option("--measurement", measurement, "pixels or model")
      ->check(CLI::IsMember({"pixels", "model"}));
  CLI11_PARSE(app, argc, argv);
  options.tools = orthonav::engine::built_in_tools();
  options.loop.draw_every = 0;
  if (measurement == "model") {
    options.measurement = orthonav::engine::Measurement::kModel;
  }
  return orthonav::run(options);
}

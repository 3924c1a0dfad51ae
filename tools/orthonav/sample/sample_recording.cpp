#include "tools/orthonav/sample/sample_recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/case/tool_file.h"
#include "hal/replay/recording_writer.h"
#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/stereo_renderer.h"
#include "hal/sim/surgeon/grip.h"

namespace orthonav::tools {
namespace {

constexpr double kRate_hz = 10.0;
constexpr const char* kPointer = "pointer";
/// Of the tip in the tool file.
const Vec3 kTipError_m{0.0010, -0.0010, 0.0005};
const Vec3 kEyes_m{0.05, 0.45, 0.35};  ///< of the wearer, in Room: the table is at y = 0
const Vec3 kDimple_m{0.10, 0.02, 0.0};
const Vec3 kBoard_m{-0.12, 0.0, 0.08};  ///< its origin, flat on the table

sim::RoomTool built_in_pointer() {
  const nav::ToolGeometry pointer = engine::tool_named(engine::built_in_tools(), kPointer).value();
  sim::RoomTool tool;
  tool.name = pointer.name;
  tool.family = pointer.marker.family;
  tool.id = pointer.marker.id;
  tool.size_m = pointer.marker.size_m;
  tool.tip_in_marker = pointer.tip_in_marker;
  tool.axis_in_marker = pointer.axis_in_marker.v;
  return tool;
}

/// Moves the pointer before the cameras, pair by pair.
class Recorder {
 public:
  static Result<Recorder> create(const std::string& folder) {
    auto writer = replay::RecordingWriter::create(folder, sim::hololens2_calibration(), {},
                                                  engine::tools_text(sample_tools()));
    return writer ? Result<Recorder>(Recorder(std::move(*writer)))
                  : Result<Recorder>(writer.error());
  }

  void rest(Vec3 tip_m, double duration_s) {
    for (int i = 0; i < pairs_in(duration_s); ++i) {
      pair(tip_m, kUpright, 0.0);
    }
  }
  /// Leans the pointer by 25° and more to every side, and twists it.
  void turn(double duration_s) {
    const int pairs = pairs_in(duration_s);
    for (int i = 0; i < pairs; ++i) {
      const double t = double(i) / pairs;
      const double around = 8.0 * std::numbers::pi * t;
      const double lean = 0.5 * std::sin(std::numbers::pi * t);
      const Mat3 leaned =
          rotation_from_vector({lean * std::cos(around), 0.0, lean * std::sin(around)});
      pair(kDimple_m, leaned * kUpright, 0.4 * std::sin(0.7 * around));
    }
  }
  void move_to(Vec3 to_m) {
    const Vec3 from_m = tip_m_;
    const int pairs = pairs_in(0.6);
    for (int i = 1; i <= pairs; ++i) {
      const double t = double(i) / pairs;
      pair(from_m + t * (to_m - from_m) + Vec3{0, 0.03 * std::sin(std::numbers::pi * t), 0},
           kUpright, 0.0);
    }
  }
  Status close() { return status_ ? writer_->close() : status_; }

 private:
  static constexpr Vec3 kUpright{0.0, 1.0, 0.0};

  explicit Recorder(std::unique_ptr<replay::RecordingWriter> writer)
      : writer_(std::move(writer)), pointer_(built_in_pointer()) {
    sim::RoomDescription room;
    room.tools = {pointer_};
    renderer_ = std::make_unique<sim::StereoRenderer>(room, sim::ErrorModel{},
                                                      sim::hololens2_calibration(), 1);
  }

  static int pairs_in(double duration_s) {
    return static_cast<int>(std::lround(duration_s * kRate_hz));
  }

  /// The head, which never stands quite still.
  [[nodiscard]] Transform<sim::Room, Rig> room_from_rig() const {
    const double t = static_cast<double>(frame_.sequence) / kRate_hz;
    const Vec3 eyes_m = kEyes_m + Vec3{0.006 * std::sin(0.9 * t), 0.004 * std::sin(1.3 * t + 1.0),
                                       0.005 * std::sin(0.7 * t + 2.0)};
    const Vec3 back = (eyes_m - Vec3{0.0, 0.08, 0.03}).normalized();
    const Vec3 right = Vec3{0, 1, 0}.cross(back).normalized();
    return {Mat3::from_columns(right, back.cross(right), back), eyes_m};
  }

  void pair(Vec3 tip_m, Vec3 axis, double roll_rad) {
    tip_m_ = tip_m;
    if (!status_) {
      return;
    }
    sim::RoomState state;
    state.room_from_rig = room_from_rig();
    state.room_from_marker = {
        sim::held(pointer_, {{tip_m}, axis, roll_rad}, state.room_from_rig.translation() - tip_m)};
    state.tool_present = {true};
    frame_.time = Timestamp(from_seconds(1.0 + static_cast<double>(frame_.sequence) / kRate_hz));
    const auto& pose = state.room_from_rig;
    frame_.world_from_rig = Transform<World, Rig>(pose.rotation(), pose.translation());
    renderer_->render({&state, 1}, frame_.sequence, frame_);
    status_ = writer_->frame(frame_, frame_.time);
    ++frame_.sequence;
  }

  std::unique_ptr<replay::RecordingWriter> writer_;
  sim::RoomTool pointer_;
  std::unique_ptr<sim::StereoRenderer> renderer_;
  StereoFrame frame_;
  Vec3 tip_m_ = kDimple_m;
  Status status_;
};

}  // namespace

std::vector<nav::ToolGeometry> sample_tools() {
  auto tools = engine::built_in_tools();
  for (nav::ToolGeometry& tool : tools) {
    if (tool.name == kPointer) {
      tool.tip_in_marker = {tool.tip_in_marker.v + kTipError_m};
    }
  }
  return tools;
}

Status record_pivoting(const std::string& folder) {
  auto recorder = Recorder::create(folder);
  if (!recorder) {
    return recorder.error();
  }
  recorder->turn(8.0);
  return recorder->close();
}

Status record_accuracy_test(const std::string& folder, const std::vector<Vec2>& points_m) {
  auto recorder = Recorder::create(folder);
  if (!recorder) {
    return recorder.error();
  }
  recorder->rest(kDimple_m, 3.0);
  recorder->turn(6.0);
  for (const Vec2& point_m : points_m) {
    // The board's z points up: its y lies along -z of Room.
    const Vec3 at_m = kBoard_m + Vec3{point_m.x, 0.0, -point_m.y};
    recorder->move_to(at_m);
    recorder->rest(at_m, 1.0);
  }
  return recorder->close();
}

}  // namespace orthonav::tools

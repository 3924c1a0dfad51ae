#include <pybind11/stl.h>
#include <cmath>
#include <optional>

#include "base/joined.h"
#include "base/length_text.h"
#include "base/pose_status_name.h"
#include "base/printed.h"
#include "engine/session/method.h"
#include "hal/replay/replay_headset.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/values.h"

namespace orthonav::python {
namespace {

/// The largest time that nanoseconds can hold.
constexpr double kLongest_s = 9e9;

CameraModel camera_from_lookup(const py::object& unit_plane) {
  const auto numbers = numbers_from(unit_plane, "unit_plane", {-1, -1, 2}, Nan::kMeansNothing);
  const auto array = py::array::ensure(unit_plane);
  std::vector<Vec2> directions;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    directions.push_back({numbers[i], numbers[i + 1]});
  }
  return value_of(CameraModel::from_lookup(
      static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), std::move(directions)));
}

StereoCalibration rig_from(const CameraModel& left, const CameraModel& right,
                           const py::object& left_from_rig, const py::object& right_from_rig) {
  return {left, right,
          transform_from<LeftCamera, Rig>(left_from_rig, "left_from_rig", kFarthestOnRig_m),
          transform_from<RightCamera, Rig>(right_from_rig, "right_from_rig", kFarthestOnRig_m)};
}

/// Pairs as Python gives them. They pass the contract of all devices, so that a tracker gets only
/// pairs that it expects.
class GivenPairs : public StereoCamera {
 public:
  explicit GivenPairs(StereoCalibration rig) : rig_(std::move(rig)) {}
  void give(StereoFrame frame) { given_ = std::move(frame); }

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return rig_; }
  /// The caller's own pairs: a test picture, cameras on a stand.
  [[nodiscard]] MayRepeat do_may_repeat() const override { return {true, true}; }
  Result<Next> do_next(StereoFrame& frame) override {
    frame = std::move(given_);
    frame.sequence = ++sequence_;
    return Next::kFrame;
  }

  StereoCalibration rig_;
  StereoFrame given_;
  std::int64_t sequence_ = 0;
};

/// Keeps Python's lock while it works: one thread at a time.
class Tracker {
 public:
  Tracker(const StereoCalibration& rig, std::vector<nav::ToolGeometry> tools,
          const std::string& method)
      : pairs_(rig),
        tracker_(value_of(
            value_of(engine::method_named(method)).create_tracker(rig, std::move(tools), {}))) {}

  [[nodiscard]] std::vector<std::string> tools() const {
    std::vector<std::string> names;
    for (const nav::ToolGeometry& tool : tracker_->tools()) {
      names.push_back(tool.name);
    }
    return names;
  }
  std::vector<TrackedTool> track(const py::object& left, const py::object& right, double time_s,
                                 const py::object& world_from_rig) {
    if (!(std::abs(time_s) < kLongest_s)) {
      throw Refused("time_s: is " + std::to_string(time_s) + ", must lie within 9e9 s");
    }
    StereoFrame frame;
    frame.time = Timestamp(from_seconds(time_s));
    frame.left = grey_from(left, "left");
    frame.right = grey_from(right, "right");
    if (!world_from_rig.is_none()) {
      frame.world_from_rig = transform_from<World, Rig>(world_from_rig, "world_from_rig");
    }
    pairs_.give(std::move(frame));
    (void)value_of(pairs_.next(pair_));
    std::vector<TrackedTool> tracked;
    for (const nav::ToolState& state : tracker_->track(pair_)) {
      tracked.push_back({tracker_->tools()[state.tool].name, state});
    }
    return tracked;
  }

 private:
  GivenPairs pairs_;
  StereoFrame pair_;
  std::unique_ptr<nav::ToolTracker> tracker_;
};

class Recording {
 public:
  explicit Recording(const std::string& folder)
      : folder_(folder), headset_(value_of(replay::ReplayHeadset::open(folder))) {}
  [[nodiscard]] const std::string& folder() const { return folder_; }
  [[nodiscard]] const StereoCalibration& rig() const { return headset_->cameras()->calibration(); }
  StereoFrame next() {
    StereoFrame frame;
    auto next = headset_->cameras()->next(frame);
    while (!next && frame.repeats) {  // old pictures under new times are left out
      next = headset_->cameras()->next(frame);
    }
    if (value_of(std::move(next)) != Next::kFrame) {
      throw py::stop_iteration();
    }
    return frame;
  }

 private:
  std::string folder_;
  std::unique_ptr<replay::ReplayHeadset> headset_;
};

}  // namespace

template <>
inline constexpr bool kIsBound<Tracker> = true;
template <>
inline constexpr bool kIsBound<Recording> = true;

namespace {

/// None if the tool is lost, since its last pose is not its present one.
template <class Read>
auto unless_lost(Read read) {
  return [read](const TrackedTool& tool) -> py::object {
    return tool.lost() ? py::none() : py::object(read(tool));
  };
}

std::string size_of(const CameraModel& camera) {
  return printed("%d x %d px", camera.width_px(), camera.height_px());
}

void bind_cameras(py::module_& module) {
  py::class_<CameraModel>(module, "Camera",
                          "A camera: the direction of each pixel. x right, y down, z forward.")
      .def_static(
          "from_brown_conrady",
          [](int width_px, int height_px, double fx_px, double fy_px, double cx_px, double cy_px,
             double k1, double k2, double p1, double p2, double k3) {
            return value_of(CameraModel::from_brown_conrady(
                {width_px, height_px, fx_px, fy_px, cx_px, cy_px, k1, k2, p1, p2, k3}));
          },
          py::arg("width_px"), py::arg("height_px"), py::arg("fx_px"), py::arg("fy_px"),
          py::arg("cx_px"), py::arg("cy_px"), py::arg("k1") = 0.0, py::arg("k2") = 0.0,
          py::arg("p1") = 0.0, py::arg("p2") = 0.0, py::arg("k3") = 0.0,
          "Parameters as OpenCV's; the centre of the first pixel is at (0.5, 0.5).")
      .def_static(
          "from_lookup", &camera_from_lookup, py::arg("unit_plane"),
          "unit_plane: rows x columns x 2, the direction (x/z, y/z) of each pixel's centre;\n"
          "NaN where a pixel sees nothing.")
      .def_property_readonly("width_px", &CameraModel::width_px)
      .def_property_readonly("height_px", &CameraModel::height_px)
      .def("__repr__", [](const CameraModel& c) { return "<Camera: " + size_of(c) + ">"; });
  py::class_<StereoCalibration>(module, "Rig", "A stereo pair of cameras.")
      .def(py::init(&rig_from), py::arg("left"), py::arg("right"), py::arg("left_from_rig"),
           py::arg("right_from_rig"))
      .def_readonly("left", &StereoCalibration::left)
      .def_readonly("right", &StereoCalibration::right)
      .def_property_readonly("left_from_rig",
                             [](const StereoCalibration& r) { return array_of(r.left_from_rig); })
      .def_property_readonly("right_from_rig",
                             [](const StereoCalibration& r) { return array_of(r.right_from_rig); })
      .def("__repr__", [](const StereoCalibration& r) {
        const Vec3 apart_m =
            r.left_from_rig.inverse().translation() - r.right_from_rig.inverse().translation();
        return "<Rig: " + size_of(r.left) + ", baseline " + in_mm(apart_m.norm()) + ">";
      });
}

void bind_pairs(py::module_& module) {
  py::class_<StereoFrame>(module, "Pair", "Two images of the same moment.")
      .def("__repr__",
           [](const StereoFrame& f) {
             return printed("<Pair: %.3f s, %d x %d px>", seconds(f.time.time_since_epoch()),
                            f.left.width_px, f.left.height_px);
           })
      .def_property_readonly("left", [](const StereoFrame& f) { return array_of(f.left); })
      .def_property_readonly("right", [](const StereoFrame& f) { return array_of(f.right); })
      .def_property_readonly(
          "time_s", [](const StereoFrame& f) { return seconds(f.time.time_since_epoch()); },
          "mid-exposure, by the headset's own clock")
      .def_property_readonly(
          "world_from_rig",
          [](const StereoFrame& f) {
            return f.world_from_rig ? py::object(array_of(*f.world_from_rig)) : py::none();
          },
          "None while the headset is not located");
  py::class_<Recording>(module, "Recording",
                        "A recorded session (docs/recordings.md). Its pairs, one after another.")
      .def(py::init<const std::string&>(), py::arg("folder"))
      .def_property_readonly("rig", &Recording::rig)
      .def("__repr__", [](const Recording& r) { return "<Recording " + r.folder() + ">"; })
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &Recording::next);
}

void bind_tracker(py::module_& module) {
  py::class_<TrackedTool>(module, "TrackedTool", "A tool after one pair.")
      .def_readonly("tool", &TrackedTool::tool)
      .def("__repr__",
           [](const TrackedTool& t) {
             return "<TrackedTool " + t.tool + ": " + name_of(t.pose().status) + ">";
           })
      .def_property_readonly(
          "status", [](const TrackedTool& tool) { return name_of(tool.pose().status); },
          "\"measured\", \"predicted\" or \"lost\"")
      .def_property_readonly("world_from_marker", unless_lost([](const TrackedTool& t) {
                               return array_of(t.pose().value);
                             }),
                             "None where the tool is lost")
      .def_property_readonly("rig_from_marker", unless_lost([](const TrackedTool& t) {
                               return array_of(t.state.rig_from_marker);
                             }))
      .def_property_readonly("covariance", unless_lost([](const TrackedTool& t) {
                               return array_of(t.pose().covariance);
                             }),
                             "6x6, of (translation m, rotation vector rad) in World")
      .def_property_readonly(
          "cameras", [](const TrackedTool& t) { return t.state.cameras; },
          "how many a measured pose comes from; of 1 it is less certain");
  py::class_<Tracker>(module, "Tracker", "Follows tools through stereo pairs.")
      .def(py::init<const StereoCalibration&, std::vector<nav::ToolGeometry>, const std::string&>(),
           py::arg("rig"), py::arg("tools"), py::arg("method") = "best",
           "method: \"best\", or \"paper\" for the published one.")
      .def("track", &Tracker::track, py::arg("left"), py::arg("right"), py::arg("time_s"),
           py::arg("world_from_rig"),
           "One state for each tool, in their order. left, right: uint8, rows x columns; time_s "
           "has\n"
           "to increase from pair to pair; world_from_rig: where the headset was, an identity for\n"
           "cameras that stand still, None while unknown.")
      .def("__repr__",
           [](const Tracker& t) { return "<Tracker: " + joined(t.tools(), ", ") + ">"; });
}

}  // namespace

void bind_tracking(py::module_& module) {
  bind_cameras(module);
  bind_pairs(module);
  bind_tracker(module);
}

}  // namespace orthonav::python

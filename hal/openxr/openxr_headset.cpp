#include "hal/openxr/openxr_headset.h"

#include <utility>

#include "hal/openxr/shared_clicker.h"
#include "hal/openxr/xr_display.h"

namespace orthonav::openxr {
namespace {

Mount mount_of(const RigOnHead& rig) {
  const auto rig_from_view = rig.view_from_rig.inverse();
  return {rig.mounted ? Placement::kMounted : Placement::kElsewhere,
          {rig_from_view.rotation(), rig_from_view.translation()}};
}

/// The other headset's pairs; with the display's poses and maps if the cameras are mounted on it.
class Cameras : public StereoCamera, private PairTap {
 public:
  Cameras(StereoCamera& inner, const XrDisplay& display, bool mounted)
      : inner_(inner), display_(display), mounted_(mounted) {}

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return inner_.calibration();
  }
  [[nodiscard]] MayRepeat do_may_repeat() const override { return inner_.may_repeat(); }
  Result<Next> do_next(StereoFrame& frame) override {
    // The frame is reused, and a device whose map never moves does not write this field.
    frame.map_epoch = 0;
    auto answer = inner_.next(frame);
    if (!answer || *answer != Next::kFrame) {
      return answer;
    }
    place(frame);
    return answer;
  }
  bool do_tap(PairTap* tap) override {
    inner_.tap(nullptr);
    tap_ = tap;
    return inner_.tap(tap != nullptr ? this : nullptr);
  }
  void received(const StereoFrame& pair) override {
    placed_ = pair;
    place(placed_);
    tap_->received(placed_);
  }
  void place(StereoFrame& frame) const {
    if (mounted_) {
      const auto pose = display_.world_from_rig(frame.time);
      frame.world_from_rig.reset();
      if (pose.status == PoseStatus::kMeasured) {
        frame.world_from_rig = pose.value;
      }
    }
    frame.map_epoch += display_.map_epoch(frame.time);
  }

  PairTap* tap_ = nullptr;
  StereoFrame placed_;  ///< for the tap, on its thread
  StereoCamera& inner_;
  const XrDisplay& display_;
  bool mounted_;
};

class Head : public HeadTracker {
 public:
  Head(const HeadTracker& inner, const XrDisplay& display, bool mounted)
      : inner_(inner), display_(display), mounted_(mounted) {}

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    return mounted_ ? display_.world_from_rig(at) : inner_.world_from_rig(at);
  }

  const HeadTracker& inner_;
  const XrDisplay& display_;
  bool mounted_;
};

/// The described frames also go to the other headset, where a simulated wearer reads them.
class Words : public Display {
 public:
  Words(Display& inner, const Clock& clock, const XrDisplay& display, bool mounted)
      : inner_(inner), clock_(clock), display_(display), mounted_(mounted) {}

 private:
  [[nodiscard]] Duration do_latency() const override {
    if (mounted_) {
      return display_.latency();
    }
    const Timestamp now = clock_.now();
    return inner_.predicted_display_time(now) - now;
  }
  Status do_shown(const ShownFrame& frame) override { return inner_.shown(frame); }

  Display& inner_;
  const Clock& clock_;
  const XrDisplay& display_;
  bool mounted_;
};

class Composite : public OpenxrHeadset {
 public:
  Composite(std::unique_ptr<Headset> cameras, const RigOnHead& rig)
      : OpenxrHeadset(*cameras),
        inner_(std::move(cameras)),
        pixels_(mount_of(rig), inner_->clock(), inner_->head()),
        cameras_(inner_->cameras(), pixels_, rig.mounted),
        head_(inner_->head(), pixels_, rig.mounted),
        clicker_(pixels_, inner_->clicker()),
        words_(inner_->display(), inner_->clock(), pixels_, rig.mounted) {}

  [[nodiscard]] std::string name() const override {
    const std::string runtime = pixels_.name();
    return "openxr (" + (runtime.empty() ? "" : runtime + ", ") + "cameras: " + inner_->name() +
           ")";
  }
  [[nodiscard]] StereoCamera& cameras() override { return cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Display& display() override { return words_; }
  [[nodiscard]] PixelDisplay* pixels() override { return &pixels_; }

 private:
  std::unique_ptr<Headset> inner_;
  XrDisplay pixels_;
  Cameras cameras_;
  Head head_;
  SharedClicker clicker_;
  Words words_;
};

}  // namespace

std::unique_ptr<OpenxrHeadset> OpenxrHeadset::around(std::unique_ptr<Headset> cameras,
                                                     const RigOnHead& rig) {
  return std::make_unique<Composite>(std::move(cameras), rig);
}

Result<std::string> describe_runtime() {
  auto runtime = Runtime::connect();
  if (!runtime) {
    return runtime.error();
  }
  if (const Status found = (*runtime)->find_headset(); !found) {
    return found.error();
  }
  const auto headset = (*runtime)->headset_traits();
  if (!headset) {
    return headset.error();
  }
  return (*runtime)->name() + ", " + headset->name;
}

}  // namespace orthonav::openxr

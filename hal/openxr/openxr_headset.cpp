#include "hal/openxr/openxr_headset.h"

#include <atomic>
#include <utility>

#include "hal/api/map_watch.h"
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
/// Not every runtime tells when its map moves, so the poses are watched as well.
class Cameras : public ForwardingCamera, private PairTap {
 public:
  Cameras(StereoCamera& inner, const XrDisplay& display, bool mounted)
      : ForwardingCamera(inner), display_(display), mounted_(mounted) {}
  /// When the newest map began that the runtime did not tell of. From any thread.
  [[nodiscard]] Timestamp jumped() const { return jumped_.load(); }

 private:
  /// The maps of one run of pairs: those that `next` returns, or those that the tap sees.
  struct Maps {
    MapWatch watch;
    std::int64_t told_epoch = 0;
    std::int64_t jumps = 0;  ///< that the runtime did not tell of
  };

  Result<Next> do_next(StereoFrame& frame) override {
    // The frame is reused, and a device whose map never moves does not write this field.
    frame.map_epoch = 0;
    auto answer = ForwardingCamera::do_next(frame);
    if (!answer || *answer != Next::kFrame) {
      return answer;
    }
    if (place(frame, next_)) {
      jumped_ = frame.time;
    }
    return answer;
  }
  bool do_tap(PairTap* tap) override {
    ForwardingCamera::do_tap(nullptr);
    tap_ = tap;
    return ForwardingCamera::do_tap(tap != nullptr ? this : nullptr);
  }
  void received(const StereoFrame& pair) override {
    placed_ = pair;
    static_cast<void>(place(placed_, received_));
    tap_->received(placed_);
  }
  /// Whether the map jumped there untold.
  bool place(StereoFrame& frame, Maps& maps) const {
    const std::int64_t told_epoch = display_.map_epoch(frame.time);
    bool jumped = false;
    if (mounted_) {
      const auto pose = display_.world_from_rig(frame.time);
      frame.world_from_rig.reset();
      if (pose.status == PoseStatus::kMeasured) {
        frame.world_from_rig = pose.value;
        const bool is_told = std::exchange(maps.told_epoch, told_epoch) != told_epoch;
        if (is_told) {
          maps.watch.break_off();
        }
        jumped = maps.watch.moved(frame.time, pose.value) && !is_told;
      }
    }
    maps.jumps += jumped ? 1 : 0;
    frame.map_epoch += told_epoch + maps.jumps;
    return jumped;
  }

  const XrDisplay& display_;
  bool mounted_;
  Maps next_;
  std::atomic<Timestamp> jumped_{Timestamp::min()};
  // On the thread that receives pairs.
  PairTap* tap_ = nullptr;
  StereoFrame placed_;
  Maps received_;
};

class Head : public HeadTracker {
 public:
  Head(const HeadTracker& inner, const XrDisplay& display, const Cameras& cameras, bool mounted)
      : inner_(inner), display_(display), cameras_(cameras), mounted_(mounted) {}

 private:
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    if (!mounted_) {
      return inner_.world_from_rig(at);
    }
    if (at < cameras_.jumped()) {
      return {{}, at, PoseStatus::kLost, {}};
    }
    return display_.world_from_rig(at);
  }

  const HeadTracker& inner_;
  const XrDisplay& display_;
  const Cameras& cameras_;
  bool mounted_;
};

class Composite : public OpenxrHeadset {
 public:
  Composite(std::unique_ptr<Headset> cameras, const RigOnHead& rig)
      : OpenxrHeadset(*cameras),
        inner_(std::move(cameras)),
        pixels_(mount_of(rig), inner_->clock(), inner_->head()),
        cameras_(*inner_->cameras(), pixels_, rig.mounted),
        head_(inner_->head(), pixels_, cameras_, rig.mounted),
        clicker_(pixels_, inner_->clicker()),
        mounted_(rig.mounted) {}

  [[nodiscard]] std::string name() const override {
    const std::string runtime = pixels_.name();
    return "openxr (" + (runtime.empty() ? "" : runtime + ", ") + "cameras: " + inner_->name() +
           ")";
  }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Duration display_latency() const override {
    return mounted_ ? pixels_.latency() : inner_->display_latency();
  }
  [[nodiscard]] PixelDisplay* pixels() override { return &pixels_; }

 private:
  std::unique_ptr<Headset> inner_;
  XrDisplay pixels_;
  Cameras cameras_;
  Head head_;
  SharedClicker clicker_;
  bool mounted_;
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

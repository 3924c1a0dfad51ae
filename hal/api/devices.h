#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/time.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "hal/api/camera_model.h"
#include "hal/api/connection_statistics.h"
#include "hal/api/described_tools.h"
#include "hal/api/frame_order.h"
#include "hal/api/repeat_watch.h"

namespace orthonav {

/// The two front cameras as the device reports them.
struct StereoCalibration {
  CameraModel left;
  CameraModel right;
  Transform<LeftCamera, Rig> left_from_rig;
  Transform<RightCamera, Rig> right_from_rig;

  [[nodiscard]] Transform<RightCamera, LeftCamera> right_from_left() const {
    return right_from_rig * left_from_rig.inverse();
  }
};

/// Two images taken at the same moment. The buffers are reused from frame to frame, or exchanged
/// for some that were used before.
struct StereoFrame : FrameHeader {
  GreyImage left;
  GreyImage right;
  /// Covariance of the head's pose, without drift of the map, if the device states it: of
  /// (translation m, rotation vector rad about the rig's origin), in World.
  std::optional<PoseCovariance> head_covariance;
  /// Why a pair came back empty: it repeats what came before. Set with the Error, and absent with
  /// any other; a device that decodes its pictures sets it where only it can tell.
  std::optional<Repeated> repeats;

  /// Empties it and keeps the buffers, so that the next frame allocates nothing.
  void clear();
};

/// Sees pairs as a device receives them.
class PairTap {
 public:
  virtual ~PairTap() = default;
  /// Called on the thread that receives them, in order, before `next` can return the pair. Must not
  /// wait.
  virtual void received(const StereoFrame& pair) = 0;
};

/// Pull interface of the camera pair. Contract, kept by the public call for every device: times
/// strictly increase, both images have the calibration's size, sequence numbers increase, the map's
/// epoch never decreases, a pose is a rigid motion, neither a picture nor, while pictures change,
/// the head's pose repeats under a new time; after kEnd there is only kEnd. A frame that breaks the
/// contract results in an Error and is not passed on (`frame` comes back empty, and `repeats` says
/// whether it is an old one); the stream continues with the next good frame.
class StereoCamera {
 public:
  virtual ~StereoCamera() = default;
  [[nodiscard]] const StereoCalibration& calibration() const { return do_calibration(); }
  /// What may repeat at this device; nothing where sensors are behind it.
  [[nodiscard]] MayRepeat may_repeat() const { return do_may_repeat(); }
  /// Fills `frame` with the next pair, never the same one twice. Does not block.
  Result<Next> next(StereoFrame& frame);
  /// From now on `tap`, which is borrowed, sees every pair that arrives, also those for which
  /// `next` is asked too late; unlike next's, they are not checked. Null: none does, and once this
  /// returns, none is being called. False: there is nothing to see before `next` returns it.
  bool tap(PairTap* tap) { return do_tap(tap); }

 private:
  [[nodiscard]] virtual const StereoCalibration& do_calibration() const = 0;
  virtual bool do_tap(PairTap* /*tap*/) { return false; }
  [[nodiscard]] virtual MayRepeat do_may_repeat() const { return {}; }
  virtual Result<Next> do_next(StereoFrame& frame) = 0;

  FrameOrder order_;
  RepeatWatch repeats_;
};

/// Where the head is, was or will be. Contract: the answer has the requested time; more than
/// `kMaxHeadPrediction` past the newest measurement, it is lost. A pose that is not rigid, or has
/// another time, is returned as lost. So is any pose from before the map moved
/// (`StereoFrame::map_epoch`): answers are in the newest map. Thread-safe.
class HeadTracker {
 public:
  static constexpr Duration kMaxHeadPrediction = std::chrono::milliseconds(100);
  virtual ~HeadTracker() = default;
  [[nodiscard]] Tracked<Transform<World, Rig>> world_from_rig(Timestamp at) const;

 private:
  [[nodiscard]] virtual Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const = 0;
  /// Time of the newest measurement; a device that provides it need not check the limit itself.
  [[nodiscard]] virtual std::optional<Timestamp> do_newest_measurement() const {
    return std::nullopt;
  }
};

enum class ClickerAction { kPress, kRelease, kClick, kDoubleClick, kHold };

struct ClickerEvent {
  ClickerAction action = ClickerAction::kPress;
  Timestamp time{};
  friend bool operator==(const ClickerEvent&, const ClickerEvent&) = default;
};

/// Where a button is in its sequence of events.
struct ButtonState {
  bool pressed = false;
  bool clickable = false;    ///< released, and not reported as a click or a double click yet
  bool clicked = false;      ///< released, and reported as a click
  bool after_click = false;  ///< the release before the newest press was reported as a click

  /// Takes the next event, or says why it is not allowed now.
  Status take(ClickerAction action);
};

/// One button. Contract: times never decrease, press and release alternate, a click follows its
/// release, and a double click the second of two releases, of which the first is reported as a
/// click and the second as a double click only. A hold falls between press and release.
class Clicker {
 public:
  virtual ~Clicker() = default;
  /// Appends every event up to and including `until`; each event is delivered once. When one of
  /// them breaks the contract, the answer is an Error and none of this call's events is passed on.
  Status poll(Timestamp until, std::vector<ClickerEvent>& events);

 private:
  virtual Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) = 0;

  std::optional<Timestamp> last_time_;
  ButtonState state_;
};

/// Derives clicks, double clicks and holds from raw presses and releases; for devices that only see
/// a button. Click: released within `hold_after`; double click: two clicks whose presses lie within
/// `double_within`. The first click is delivered as a click too, the second as a double click only;
/// a third in a row starts anew. A repeated report of the same position (a keyboard's repeat) is
/// ignored.
class ClickTimer {
 public:
  Duration double_within = std::chrono::milliseconds(300);
  Duration hold_after = std::chrono::milliseconds(500);
  void button(bool down, Timestamp time, std::vector<ClickerEvent>& events);
  /// Emits the hold of a button that stays down.
  void advance(Timestamp now, std::vector<ClickerEvent>& events);

 private:
  std::optional<Timestamp> pressed_at_;
  std::optional<Timestamp> last_click_pressed_at_;
  bool held_ = false;
};

/// A recognized phrase, lower case, with a confidence in [0, 1].
struct Phrase {
  std::string text;
  double confidence = 0.0;
  Timestamp time{};
  friend bool operator==(const Phrase&, const Phrase&) = default;
};

/// Contract: times never decrease, text is not empty, confidence lies in [0, 1].
class Voice {
 public:
  virtual ~Voice() = default;
  /// Appends every phrase up to and including `until`; each is delivered once. When one of them
  /// breaks the contract, the answer is an Error and none of this call's phrases is passed on.
  Status poll(Timestamp until, std::vector<Phrase>& phrases);

 private:
  virtual Status do_poll(Timestamp until, std::vector<Phrase>& phrases) = 0;

  std::optional<Timestamp> last_time_;
};

class DepthCamera;     // hal/api/depth_camera.h
class Microphone;      // hal/api/microphone.h
class ObjectDisplay;   // hal/api/object_display.h
class PixelDisplay;    // hal/api/pixel_display.h
class ToolPoseSource;  // hal/api/tool_pose_source.h
class Wearer;          // hal/api/wearer.h

/// A headset and its parts, each of which lives as long as the headset.
class Headset {
 public:
  virtual ~Headset() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual const Clock& clock() const = 0;
  /// This device's time zero as stored in files, in ticks of 100 ns. A HoloLens counts from the
  /// year 1601; in nanoseconds, such times would not fit into 64 bits.
  [[nodiscard]] virtual std::int64_t epoch_ticks_100ns() const { return 0; }
  /// A time as stored in files.
  [[nodiscard]] std::int64_t file_ticks_100ns(Timestamp t) const {
    return epoch_ticks_100ns() + ticks_100ns(t);
  }
  /// Its two front cameras; null: it has none. The same at every call.
  [[nodiscard]] virtual StereoCamera* cameras() = 0;
  /// Poses of tools, if it measures them itself; null otherwise: it has cameras, and tools are
  /// found in their pictures. The same at every call.
  [[nodiscard]] virtual ToolPoseSource* tool_poses() { return nullptr; }
  [[nodiscard]] virtual HeadTracker& head() = 0;
  [[nodiscard]] virtual Clicker& clicker() = 0;
  [[nodiscard]] virtual Voice& voice() = 0;
  /// How long after its submission a frame lights up. Called on the thread that takes the pairs,
  /// and on no other.
  [[nodiscard]] virtual Duration display_latency() const = 0;
  /// Its depth cameras, one per stream; may be empty. The same ones at every call.
  [[nodiscard]] virtual std::vector<DepthCamera*> depth_cameras() { return {}; }
  /// Its microphone, if it lets others listen; null otherwise. Listening starts with the first
  /// call.
  [[nodiscard]] virtual Microphone* microphone() { return nullptr; }
  /// The display, if it takes pixels; null otherwise.
  [[nodiscard]] virtual PixelDisplay* pixels() { return nullptr; }
  /// The display, if it draws objects on its own; null otherwise.
  [[nodiscard]] virtual ObjectDisplay* objects() { return nullptr; }
  /// Who wears the display, if they are simulated; null otherwise.
  [[nodiscard]] virtual Wearer* wearer() { return nullptr; }
  /// The tools in the pairs, as their source describes them.
  [[nodiscard]] virtual DescribedTools described_tools() const { return {}; }
  /// Statistics of the connection that delivers the pairs; absent if there is none.
  [[nodiscard]] virtual std::optional<ConnectionStatistics> connection() const {
    return std::nullopt;
  }
};

}  // namespace orthonav

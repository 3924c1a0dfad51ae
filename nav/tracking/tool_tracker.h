#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "hal/api/devices.h"
#include "hal/api/tool_pose_source.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/online_calibration.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// Where a patient reference lies in the anchored World.
struct ReferencePlace {
  std::size_t tool = 0;
  Transform<World, Marker> anchored_from_marker;
};

/// The state of the patient references to which an anchored tracker's poses are relative.
///
/// With a reference, a session's World is the *anchored* World: it coincides with the headset's map
/// at the moment when a reference was first seen, and moves with the reference from then on.
/// Anything clamped to the patient is at rest in it, regardless of motion of the patient, the map
/// or the head's noise.
struct Anchor {
  bool in_sight = false;               ///< at least one reference was measured in the newest pair
  std::optional<Timestamp> last_seen;  ///< mid-exposure of the newest pair that measured one
  /// From the anchored World to the headset's map, from the pair at `last_seen`.
  Transform<World, World> world_from_anchored;
  /// How often references were found to have moved relative to each other; each time, everything
  /// measured before becomes invalid.
  std::int64_t moves = 0;
  /// Where the references in use lie. A tracker created with them anchors to the same World.
  std::vector<ReferencePlace> places;
  std::int64_t places_changed = 0;  ///< how many times

  /// Whether no reference was seen within `stale_after` before `at`: then nothing may be shown on
  /// the patient.
  [[nodiscard]] bool stale(Timestamp at, Duration stale_after) const {
    return !last_seen || at - *last_seen > stale_after;
  }
};

using TrackedPose = Tracked<Transform<World, Marker>>;

/// Where a tool is relative to the headset, from one stereo pair alone. The head's pose, its noise
/// and the map do not affect the relative pose of two tools in the same pair.
struct PairPose {
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance{};  ///< in Rig
  double exposure_s = 0.0;      ///< over which the pose is a mean
};

/// The state of one tool after one stereo pair.
struct ToolState {
  std::size_t tool = 0;  ///< index into the tools given at creation
  TrackedPose world_from_marker;
  /// The same relative to the headset, for quantities in which head pose and map drift cancel.
  Transform<Rig, Marker> rig_from_marker;
  double residual_px = 0.0;  ///< RMS reprojection residual of the corners; 0 with `best`
  /// How many cameras a measured pose comes from; with 1 it is less certain, above all along the
  /// line of sight.
  int cameras = 0;
  /// Absent if this pair does not measure the tool, or if the method has no pose from a single
  /// pair.
  std::optional<PairPose> pair = {};
};

/// Adds the head's own error, as the device states it, to the covariance in World, over the lever
/// arm from the rig to the tag. Without a stated error, nothing is added.
void add_head(ToolState& state, const StereoFrame& frame);

/// Whether the pairs' two pictures are of the same moment. Where one camera's stamps are off, the
/// pose of a moving tag is centimetres off with a covariance of a millimetre.
struct PictureAgreement {
  std::int64_t refused = 0;           ///< pairs whose pictures contradict each other
  std::int64_t refused_in_a_row = 0;  ///< up to the newest pair in which that can be told
};

struct TrackerOptions {
  /// 1: search the whole of both images in every pair. n: only around predictions, and the whole
  /// image every n-th pair while something is missing.
  int full_search_interval = 1;
  double decimate = 1.0;
  /// Two threads detect left and right concurrently; the result is the same.
  bool parallel = true;
  /// How long a tool that is not seen is predicted before it is lost.
  Duration coast = std::chrono::milliseconds(100);
};

/// Tracks every tool through stereo pairs. One thread at a time.
class ToolTracker {
 public:
  virtual ~ToolTracker() = default;
  /// One state for each tool, in the order of the tools, after a stereo pair.
  virtual std::span<const ToolState> track(const StereoFrame& frame) = 0;
  /// The same after poses that a device measured itself, which are neither filtered nor predicted.
  /// Only a tracker made for them takes them, and no pairs; anything else is a bug of the caller.
  virtual std::span<const ToolState> take(const ToolPoses& poses);
  [[nodiscard]] virtual std::span<const ToolGeometry> tools() const = 0;
  /// How the two cameras appear to be rotated relative to their reported calibration; nothing from
  /// a method that does not estimate it, or before it is known.
  [[nodiscard]] virtual std::optional<StereoAlignment> alignment() const { return std::nullopt; }
  /// How many pairs were refused because their two pictures can't be of the same moment; none by a
  /// method that does not look.
  [[nodiscard]] virtual PictureAgreement picture_agreement() const { return {}; }
  /// How large the tags of a tool appear, relative to its definition; nothing from a method that
  /// does not estimate it, or before it is known.
  [[nodiscard]] virtual std::optional<TagSize> tag_size(std::size_t /*tool*/) const {
    return std::nullopt;
  }
  /// SD of how much larger one tool's tags are than another's, as a fraction, after the corrections
  /// that poses take into account; a method that does not estimate it returns the usual SD of
  /// printers.
  [[nodiscard]] virtual double tag_size_difference_sd(std::size_t /*tool*/,
                                                      std::size_t /*other*/) const {
    constexpr double kOfTwoPrints = 0.0042;
    return kOfTwoPrints;
  }
  /// The tags that searches of whole images found, those of no tool as well; null: none are made.
  [[nodiscard]] virtual const SeenTags* seen_tags() const { return nullptr; }
  /// The patient references to which its poses are relative (`create_anchored_tracker`); null:
  /// poses are in the headset's map.
  [[nodiscard]] virtual const Anchor* anchor() const { return nullptr; }
};

/// Finds the pose at which the tool's printed tags explain both images at once, starting from a
/// prediction (docs/tracking.md). Whole images are searched only for lost tools.
Result<std::unique_ptr<ToolTracker>> create_photometric_tracker(
    const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
    const TrackerOptions& options = {});

/// Everything that keeps a tracker from being created, in one line.
Status check(const StereoCalibration& calibration, const std::vector<ToolGeometry>& tools,
             const TrackerOptions& options);

/// Where the tool will be at `time`, from its two newest measured states (constant velocity,
/// covariance grown accordingly); lost when `time` is more than `coast` past the newest one.
[[nodiscard]] TrackedPose predicted(const TrackedPose& older, const TrackedPose& newer,
                                    Timestamp time, Duration coast);

}  // namespace orthonav::nav

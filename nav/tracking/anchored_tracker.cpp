#include "nav/tracking/anchored_tracker.h"

#include <algorithm>
#include <utility>

#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

/// One reference, as it lies in the anchored World.
struct Reference {
  std::size_t tool = 0;
  /// Absent until it counts.
  std::optional<Transform<World, Marker>> anchored_from_marker;
  PoseFilter learning;  ///< where it lies, relative to references that count
  int pairs_learnt = 0;
  int pairs_elsewhere = 0;  ///< in a row in which it was not where it should be
};

constexpr double kReferenceMoved_rad = 0.0105;  ///< 0.6°
/// A further reference counts once it was seen in this many pairs together with one that already
/// counts.
constexpr int kLearntFromPairs = 30;

class AnchoredTracker final : public ToolTracker {
 public:
  AnchoredTracker(std::unique_ptr<ToolTracker> tracker, Duration coast,
                  std::vector<Reference> references)
      : tracker_(std::move(tracker)),
        coast_(coast),
        references_(std::move(references)),
        filters_(tracker_->tools().size()) {
    publish_reference_poses();
  }

  std::span<const ToolState> track(const StereoFrame& frame) override {
    return anchored(tracker_->track(frame), frame.time, frame.world_from_rig, true);
  }
  std::span<const ToolState> take(const ToolPoses& poses) override {
    // What they have in common is World itself.
    return anchored(tracker_->take(poses), poses.time, Transform<World, Rig>{}, false);
  }

  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tracker_->tools(); }
  [[nodiscard]] std::optional<StereoAlignment> alignment() const override {
    return tracker_->alignment();
  }
  [[nodiscard]] PictureAgreement picture_agreement() const override {
    return tracker_->picture_agreement();
  }
  [[nodiscard]] std::optional<TagSize> tag_size(std::size_t tool) const override {
    return tracker_->tag_size(tool);
  }
  [[nodiscard]] double tag_size_difference_sd(std::size_t tool, std::size_t other) const override {
    return tracker_->tag_size_difference_sd(tool, other);
  }
  [[nodiscard]] const SeenTags* seen_tags() const override { return tracker_->seen_tags(); }
  [[nodiscard]] const Anchor* anchor() const override { return &anchor_; }

 private:
  /// `filters`: whether poses are filtered over moments.
  std::span<const ToolState> anchored(std::span<const ToolState> seen, Timestamp time,
                                      const std::optional<Transform<World, Rig>>& world_from_rig,
                                      bool filters) {
    states_.assign(seen.begin(), seen.end());
    const Reference* best = world_from_rig ? best_in_sight(seen) : nullptr;
    anchor_.in_sight = best != nullptr;
    if (best != nullptr) {
      const PairPose& reference = *seen[best->tool].pair;
      const Transform<World, Rig> anchored_from_rig =
          *best->anchored_from_marker * reference.rig_from_marker.inverse();
      anchor_.last_seen = time;
      anchor_.world_from_anchored = *world_from_rig * anchored_from_rig.inverse();
      watch(seen, *best, anchored_from_rig, time);
      measure(seen, *best, anchored_from_rig, time, filters);
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (best == nullptr || !seen[i].pair) {
        predict(i, time);
      }
    }
    return states_;
  }

  /// The most certain of those that count; the very first one seen counts at once and defines the
  /// anchored World.
  const Reference* best_in_sight(std::span<const ToolState> seen) {
    const Reference* best = nullptr;
    for (const Reference& reference : references_) {
      const auto& pair = seen[reference.tool].pair;
      if (pair && reference.anchored_from_marker &&
          (best == nullptr || rotation_sigma_rad(pair->covariance) <
                                  rotation_sigma_rad(seen[best->tool].pair->covariance))) {
        best = &reference;
      }
    }
    if (best != nullptr || !anchor_.places.empty()) {
      return best;
    }
    for (Reference& reference : references_) {
      if (seen[reference.tool].pair) {
        reference.anchored_from_marker = seen[reference.tool].world_from_marker.value;
        publish_reference_poses();
        return &reference;
      }
    }
    return nullptr;
  }

  /// Checks the other visible references: those that count must be where they were; the others are
  /// learnt.
  void watch(std::span<const ToolState> seen, const Reference& best,
             const Transform<World, Rig>& anchored_from_rig, Timestamp time) {
    bool moved = false;
    for (Reference& other : references_) {
      const auto& pair = seen[other.tool].pair;
      if (&other == &best || !pair) {
        continue;
      }
      const Transform<World, Marker> here = anchored_from_rig * pair->rig_from_marker;
      if (!other.anchored_from_marker) {
        learn(other,
              {here, time, PoseStatus::kMeasured,
               rotated(relative_covariance(*pair, *seen[best.tool].pair),
                       anchored_from_rig.rotation())},
              pair->exposure_s);
        continue;
      }
      const bool elsewhere =
          (here.translation() - other.anchored_from_marker->translation()).norm() >
              kReferenceMoved_m ||
          rotation_angle_rad(here.rotation(), other.anchored_from_marker->rotation()) >
              kReferenceMoved_rad;
      other.pairs_elsewhere = elsewhere ? other.pairs_elsewhere + 1 : 0;
      moved = moved || other.pairs_elsewhere >= kReferenceMovedPairs;
    }
    if (moved) {
      ++anchor_.moves;
      forget_all_but(best);
    }
  }

  void learn(Reference& reference, const TrackedPose& here, double exposure_s) {
    reference.learning.update(here, exposure_s);
    if (++reference.pairs_learnt >= kLearntFromPairs) {
      reference.anchored_from_marker = reference.learning.state().value;
      publish_reference_poses();
    }
  }

  /// It is unknown which of two moved: one of them defines the anchored World from now on.
  void forget_all_but(const Reference& kept) {
    for (Reference& reference : references_) {
      if (&reference != &kept) {
        reference = Reference{reference.tool, std::nullopt, PoseFilter(), 0, 0};
      }
    }
    publish_reference_poses();
  }

  void publish_reference_poses() {
    anchor_.places.clear();
    for (const Reference& reference : references_) {
      if (reference.anchored_from_marker) {
        anchor_.places.push_back({reference.tool, *reference.anchored_from_marker});
      }
    }
    ++anchor_.places_changed;
  }

  void measure(std::span<const ToolState> seen, const Reference& best,
               const Transform<World, Rig>& anchored_from_rig, Timestamp time, bool filters) {
    const PairPose& reference = *seen[best.tool].pair;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const auto& pair = seen[i].pair;
      if (!pair) {
        continue;
      }
      const bool is_anchor = i == best.tool;
      const PoseCovariance in_rig =
          is_anchor ? pair->covariance : relative_covariance(*pair, reference);
      const TrackedPose measured{anchored_from_rig * pair->rig_from_marker, time,
                                 PoseStatus::kMeasured,
                                 rotated(in_rig, anchored_from_rig.rotation())};
      if (is_anchor || !filters) {
        states_[i].world_from_marker = measured;
        continue;
      }
      if (!filters_[i].follows(time, coast_)) {
        filters_[i].stop();
      }
      filters_[i].update(measured, pair->exposure_s);
      states_[i].world_from_marker = filters_[i].state();
    }
  }

  void predict(std::size_t i, Timestamp time) {
    TrackedPose& state = states_[i].world_from_marker;
    state = {};
    state.time = time;
    if (filters_[i].follows(time, coast_)) {
      state = filters_[i].predicted(time);
    }
  }

  std::unique_ptr<ToolTracker> tracker_;
  Duration coast_;
  std::vector<Reference> references_;
  std::vector<PoseFilter> filters_;  ///< of all tools, in the anchored World
  std::vector<ToolState> states_;
  Anchor anchor_;
};

}  // namespace

PoseCovariance relative_covariance(const PairPose& tool, const PairPose& reference) {
  const Vec3 lever_arm_m =
      tool.rig_from_marker.translation() - reference.rig_from_marker.translation();
  return plus_carried(tool.covariance, reference.covariance, lever_arm_m);
}

Result<std::unique_ptr<ToolTracker>> create_anchored_tracker(
    std::unique_ptr<ToolTracker> tracker, Duration coast, std::span<const ReferencePlace> known) {
  std::vector<Reference> references;
  const auto tools = tracker->tools();
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (tools[i].role == ToolRole::kReference) {
      references.emplace_back().tool = i;
    }
  }
  if (references.empty()) {
    return Error{"tools: no reference, at least 1 needed to anchor to the patient"};
  }
  for (const ReferencePlace& place : known) {
    const auto reference =
        std::find_if(references.begin(), references.end(),
                     [&](const Reference& each) { return each.tool == place.tool; });
    if (reference == references.end()) {
      return Error{"tools: tool " + std::to_string(place.tool) + " is not a patient reference"};
    }
    reference->anchored_from_marker = place.anchored_from_marker;
  }
  return std::unique_ptr<ToolTracker>(
      std::make_unique<AnchoredTracker>(std::move(tracker), coast, std::move(references)));
}

}  // namespace orthonav::nav

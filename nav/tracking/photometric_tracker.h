#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "nav/tracking/full_image_search.h"
#include "nav/tracking/pair_detector.h"
#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tag_matching.h"
#include "nav/tracking/tool_follower.h"
#include "nav/tracking/tool_tracker.h"
#include "nav/tracking/worker.h"

namespace orthonav::nav {

/// What `create_photometric_tracker` makes. A recently seen tool is followed in the pixels of both
/// images. A lost one is searched for where it was last seen, and in the whole image while the next
/// pair is awaited.
class PhotometricTracker final : public ToolTracker {
 public:
  PhotometricTracker(const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
                     std::vector<ToolFollower> followers, const TrackerOptions& options,
                     std::unique_ptr<PairDetector> near, std::unique_ptr<FullImageSearch> whole);

  std::span<const ToolState> track(const StereoFrame& frame) override;

  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] const SeenTags* seen_tags() const override { return &seen_; }
  [[nodiscard]] std::optional<StereoAlignment> alignment() const override;
  [[nodiscard]] std::optional<TagSize> tag_size(std::size_t tool) const override {
    return calibration_.tag_size(tool);
  }
  [[nodiscard]] PictureAgreement picture_agreement() const override { return agreement_; }
  [[nodiscard]] double tag_size_difference_sd(std::size_t tool, std::size_t other) const override {
    return calibration_.size_difference_sd(tool, other);
  }

 private:
  struct Trail {
    ToolFollower follower;
    PoseFilter filter;
    Transform<World, Marker> last_seen;
    std::optional<Timestamp> last_time;
  };

  /// Forgets where the tools were: positions in another map mean nothing in this one.
  void forget_map();
  /// Applies an estimated correction of camera alignment or tag sizes to the poses once it is
  /// certain.
  void calibrate();
  [[nodiscard]] bool is_measured(std::size_t i) const;
  [[nodiscard]] bool is_turn() const { return pairs_ % options_.full_search_interval == 0; }
  [[nodiscard]] bool any_recent(Timestamp time) const;
  /// The length that `kFewestDoubtPx` covers at the tool's distance.
  [[nodiscard]] double pixel_m(const Transform<Rig, Marker>& pose) const;

  /// For fits by both cameras that can be of one moment, and for those that can't.
  void accept(std::span<const ToolEquations> pair);
  void refuse(std::span<const ToolEquations> pair);
  /// Measures the tools that are followed. False: the pair was refused.
  bool follow_all(const StereoFrame& frame);
  /// Fits every tool that was seen recently, on two threads if there are two such tools.
  void fit_all(const StereoFrame& frame);
  static void fit_beside(void* self);
  void fit_waiting(PhotometricSolver& solver, TagSearch& search);
  void find_lost(const StereoFrame& frame);

  // For tool `i`, in a frame whose `world_from_rig` is known.
  /// Fits the pose of a tool that was seen recently.
  [[nodiscard]] std::optional<ToolFit> follow(std::size_t i, const StereoFrame& frame,
                                              PhotometricSolver& solver, TagSearch& search);
  /// Fits the pose, starting from `expected`, and measures it if the pictures agree. `by_both`: it
  /// counts only if both cameras saw it.
  bool take(std::size_t i, const StereoFrame& frame, const Transform<Rig, Marker>& expected,
            double doubt_m, bool by_both = false);
  void measure(std::size_t i, const StereoFrame& frame, const ToolFit& fit);
  bool find(std::size_t i, const StereoFrame& frame);
  bool find(std::size_t i, const MarkerDefinition& marker,
            const Transform<Tag, Marker>& tag_from_marker, const StereoFrame& frame);
  bool find_by_both(std::size_t i, const MarkerDefinition& marker,
                    const Transform<Tag, Marker>& tag_from_marker, const TagMatch& match,
                    const StereoFrame& frame);
  /// For a tool whose corners were found in only one image. The other image may still show enough
  /// of the tag to decide which of the two possible poses is right.
  bool find_by_one(std::size_t i, const MarkerDefinition& marker,
                   const Transform<Tag, Marker>& tag_from_marker, const TagMatch& match,
                   const StereoFrame& frame);
  void predict(std::size_t i, const StereoFrame& frame);

  void look_for_lost(const StereoFrame& frame, bool others_tracked);
  void add_boxes(std::size_t i, const StereoFrame& frame);
  void add_boxes(std::size_t i, const MarkerDefinition& marker,
                 const Transform<Marker, Tag>& marker_from_tag, const StereoFrame& frame);

  TagGeometry geometry_;
  PhotometricSolver solver_;
  TagSearch search_;
  std::vector<ToolGeometry> tools_;
  TrackerOptions options_;
  std::unique_ptr<PairDetector> near_;
  std::unique_ptr<FullImageSearch> full_search_;
  SeenTags seen_;
  std::vector<Trail> trails_;
  std::vector<ToolState> states_;
  OnlineCalibration calibration_;
  /// Of refused pairs that agree with one another, from this one on.
  OnlineCalibration other_calibration_;
  std::int64_t other_since_ = 0;
  PictureAgreement agreement_;
  std::int64_t last_refused_ = 0;  ///< pair
  // Of the newest pair.
  bool is_refused_ = false;
  bool is_accepted_ = false;
  std::optional<ToolEquations> contradiction_;  ///< of the tool that is being looked for
  std::vector<std::optional<ToolFit>> fits_;
  std::vector<std::size_t> waiting_;    ///< tools to be fitted
  std::atomic<std::size_t> taken_ = 0;  ///< of these, by either thread
  const StereoFrame* frame_ = nullptr;
  std::vector<ToolEquations> equations_;
  std::int64_t pairs_ = -1;
  std::int64_t map_epoch_ = 0;
  /// A second thread, and what it fits with. A fit depends on its tool alone, so that the poses are
  /// the same with it and without.
  struct Beside {
    explicit Beside(const PhotometricSolver& like) : solver(like) {}
    PhotometricSolver solver;
    TagSearch search;
    Worker worker;
  };
  std::unique_ptr<Beside> beside_;
};

}  // namespace orthonav::nav

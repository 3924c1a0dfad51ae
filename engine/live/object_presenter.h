#pragma once

#include <optional>

#include "base/transform.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/live/frame_loop.h"
#include "engine/live/scene_objects.h"
#include "hal/api/object_display.h"

namespace orthonav::engine {

/// Passes every snapshot, as objects, to a display that draws them itself. Called on the drawing
/// thread; never waits. Until the head is first located, only items fixed to the head are shown.
class ObjectPresenter : public SnapshotSink {
 public:
  /// Both must outlive it. `rig_from_eyes` is where the point between the wearer's eyes is.
  ObjectPresenter(ObjectDisplay& display, const HeadTracker& head,
                  const Transform<Rig, Eye>& rig_from_eyes, const SceneObjectOptions& options = {})
      : display_(display), head_(head), rig_from_eyes_(rig_from_eyes), objects_(options) {}

  Status draw(const Snapshot& snapshot) override;

 private:
  void locate(const Snapshot& snapshot);

  ObjectDisplay& display_;
  const HeadTracker& head_;
  Transform<Rig, Eye> rig_from_eyes_;
  SceneObjects objects_;
  LabelLayout labels_;
  std::optional<render::View> view_;  ///< of the head when it was last located in this map
  // Reused from snapshot to snapshot.
  render::Scene scene_;
  ObjectList list_;
};

}  // namespace orthonav::engine

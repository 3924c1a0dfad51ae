#include "engine/live/object_presenter.h"

#include "engine/holograms/shapes/render_values.h"
#include "render/projection.h"

namespace orthonav::engine {

void ObjectPresenter::locate(const Snapshot& snapshot) {
  if (list_.map_epoch != snapshot.map_epoch) {
    view_.reset();
  }
  const auto world_from_rig = head_.world_from_rig(snapshot.display_time);
  if (world_from_rig.status == PoseStatus::kLost) {
    return;
  }
  view_ = hololens2_view(world_from_rig.value * rig_from_eyes_);
}

Status ObjectPresenter::draw(const Snapshot& snapshot) {
  locate(snapshot);
  list_.map_epoch = snapshot.map_epoch;
  list_.tool_time = snapshot.tool_time;
  if (!view_) {
    write_head_lost(snapshot.scene, scene_);
    objects_.write(scene_, {}, snapshot.display_time, list_);
  } else {
    scene_ = snapshot.scene;
    const std::vector<render::View> views = {*view_};
    labels_.lay_out(scene_, views, snapshot.patches, snapshot.display_time);
    objects_.write(scene_, render::head_of(views), snapshot.display_time, list_);
  }
  display_.show(list_);
  return {};
}

}  // namespace orthonav::engine

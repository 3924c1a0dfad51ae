#include <algorithm>

#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {

Script ScriptedSurgeon::touch_heads(Side side) {
  const StepOnDisplay step = step_now();
  std::vector<StandingHead> heads = metal_.heads(side);
  const Vec3 superior = (layout_->room_from_spine() * Direction<Spine>{{0, 0, 1}}).v;
  std::stable_sort(heads.begin(), heads.end(),
                   [superior](const StandingHead& a, const StandingHead& b) {
                     return a.position.v.dot(superior) > b.position.v.dot(superior);
                   });
  if (!heads.empty()) {
    co_await body_.take(ToolKind::kPointer, heads.front().position);
  }
  for (const StandingHead& standing : heads) {
    if (!in_step(step)) {
      co_return;
    }
    body_.posture().level = layout_->find(standing.level).value_or(body_.posture().level);
    const Point<Room> head = standing.position;
    const Point<Room> touched = head + normal_vector(body_.random(), error_model_->head_pick_m);
    body_.look(head);
    co_await body_.move({touched, body_.pointer_axis({0, 1, 0}), 0.0}, 1.5, 0.02);
    body_.posture().contact_normal = Vec3{0, 1, 0};
    co_await click_until_taken(step, 1.0, 0.5);
    body_.posture().contact_normal.reset();
  }
  co_await body_.rest(1.0);
  body_.say(words().finish_rod);
}

}  // namespace orthonav::sim

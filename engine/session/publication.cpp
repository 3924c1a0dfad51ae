#include "engine/session/publication.h"

#include <utility>

#include "engine/session/numbers_wording.h"

namespace orthonav::engine {
namespace {

bool at_work(Step step) { return step != Step::kSetup && step != Step::kDone; }

}  // namespace

const Guidance& Publication::publish(const StereoFrame& frame, Timestamp display_time,
                                     OperationInWork& work, SessionSteps& steps,
                                     const Watching& watching) {
  Guidance& out = guidance_;
  out.frame_time = frame.time;
  out.display_time = display_time;
  const auto tool = steps.tool(work);
  out.pose_time = tool ? work.tools.watch(*tool).last_measured().value_or(Timestamp{}) : frame.time;
  out.step = work.step;
  out.levels = work.state.levels;
  out.level = work.level_in_work;
  out.stale_after = work.options.stale_after;
  out.fade = work.options.fade;
  out.blank = work.stalled.has_value();
  out.tools = work.tools.sights();
  out.anchor = work.tools.tracker().anchor();
  if (frame.world_from_rig) {
    out.head = out.anchor ? out.anchor->world_from_anchored.inverse() * *frame.world_from_rig
                          : *frame.world_from_rig;
  }
  steps.write(work, watching.guidance_hidden() || work.stalled, out);
  publish_status(work, steps, watching);
  return out;
}

void Publication::publish_status(OperationInWork& work, SessionSteps& steps,
                                 const Watching& watching) {
  work.messages.expire(guidance_.frame_time);
  StatusLine& line = guidance_.status;
  line.at = steps.on_display(work);
  line.stalled = work.stalled;
  line.no_clicker = work.no_clicker;
  publish_tool(work, steps, watching);
  publish_instruments(work, steps);
  steps.replanning.show(guidance_.display_time);
  line.message = work.messages.message();
  line.heard = work.messages.heard();
  line.state = steps.state(work);
  line.saved = saved(work);
  if (work.step == Step::kVerify) {
    steps.verifying.note_shown(line);
  }
}

void Publication::publish_tool(const OperationInWork& work, const SessionSteps& steps,
                               const Watching& watching) {
  StatusLine& line = guidance_.status;
  line.tool = {};
  line.tool_lost = false;
  line.pictures_apart = work.tools.pictures_apart();
  line.tag_size_off.reset();
  if (const auto tool = steps.tool(work)) {
    line.tool = work.tools.geometry(*tool).name;
    line.tool_lost = watching.tool_lost();
    line.tag_size_off = work.tools.tag_size_off(*tool);
  }
  // The first of the references, while none is seen in a step that needs one.
  const auto reference = at_work(work.step) && watching.reference_hidden(work)
                             ? work.tools.first_reference()
                             : std::nullopt;
  if (reference) {
    line.tool = work.tools.geometry(*reference).name;
    line.tool_lost = true;
  }
}

/// Tools in hand that the step does not use, and a depth stop that is set too deep.
void Publication::publish_instruments(const OperationInWork& work, const SessionSteps& steps) {
  StatusLine& line = guidance_.status;
  in_hand_.look(work.tools, work.step, steps.tool(work),
                at_work(work.step) && !work.rods_alone() ? &work.level() : nullptr,
                guidance_.frame_time);
  const auto unused = in_hand_.unused();
  line.unused_tool =
      unused ? std::string_view(work.tools.geometry(*unused).name) : std::string_view();
  line.stop_past_target_m.reset();
  if (stop_too_deep(guidance_.drill)) {
    line.stop_past_target_m = guidance_.drill.stop_past_target_m;
  }
}

Saved Publication::saved(const OperationInWork& work) const {
  return saving_ ? saving_->saved(guidance_.frame_time, work.options.heard_for)
                 : Saved::kNothingNew;
}

const Guidance& Publication::expire(Timestamp display_time, Message why, OperationInWork& work,
                                    SessionSteps& steps) {
  guidance_.display_time = display_time;
  guidance_.tool.reset();
  steps.guiding.lose_measurement();
  guidance_.drill = work.step == Step::kGuide ? steps.guiding.drill() : nav::DrillView{};
  work.tools.lose_sight();
  guidance_.status = {};
  guidance_.status.at = steps.on_display(work);
  guidance_.status.saved = saved(work);
  why_no_guidance_ = std::move(why);
  guidance_.status.message = &why_no_guidance_;
  return guidance_;
}

const Guidance& Publication::end(Timestamp display_time, OperationInWork& work,
                                 SessionSteps& steps) {
  expire(display_time, Ended{}, work, steps);
  guidance_.blank = true;
  return guidance_;
}

}  // namespace orthonav::engine

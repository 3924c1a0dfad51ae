#include "engine/holograms/next_act.h"

#include "base/translation.h"
#include "engine/session/steps/guiding.h"

namespace orthonav::engine {
namespace {

constexpr const char* kSayNext = translatable("say go to next");

const char* act_on_plan(const nav::DrillView& drill, bool was_set) {
  switch (drill.phase) {
    case nav::DrillPhase::kAway:
      return was_set ? kSayNext : translatable("advance");
    case nav::DrillPhase::kSet:
      return translatable("drill");
    case nav::DrillPhase::kDrilling:
      return translatable("drilling");
  }
  return "";
}

const char* act_at_screw(const Visibility& visible, bool was_set) {
  if (visible.sizes == nullptr) {
    return "";  // lost, or as published
  }
  switch (visible.verdict.worst) {
    case Worst::kNothing:
      return act_on_plan(visible.drill, was_set);
    case Worst::kCertainty:
      return translatable("not sure: check by eye");
    case Worst::kAngle:
      return translatable("turn the tool");
    case Worst::kOffset:
      return translatable("move the tip");
    case Worst::kClearance:
      return translatable("aim away from the wall");
    case Worst::kDepth:
      return translatable("past the target: withdraw");
  }
  return "";
}

}  // namespace

void append_next_act(std::string& out, const Guidance& guidance, const Visibility& visible) {
  if (guidance.step != Step::kGuide || !visible.trajectory ||
      visible.drill.alarm == nav::DrillAlarm::kStop) {
    return;
  }
  if (visible.triangle != nullptr) {
    const char* act = act_at_screw(visible, guidance.was_set);
    out += *act != '\0' ? translated(act) : "";
  } else if (!guidance.tool || !guidance.tool->measured) {
    out += translated("take the guide");
  } else {
    out += translated(guidance.was_set ? kSayNext : translatable("tip to the entry"));
  }
}

void append_cross_word(std::string& out, const Visibility& visible) {
  if (visible.drill.alarm == nav::DrillAlarm::kStop) {
    append_drill(out, visible.drill);
  } else if (visible.clearance != nullptr && visible.clearance->may_break()) {
    append_breach(out, *visible.clearance);
  } else if (visible.drill.phase == nav::DrillPhase::kDrilling && !visible.drill.watched) {
    append_drill(out, visible.drill);
  }
}

}  // namespace orthonav::engine

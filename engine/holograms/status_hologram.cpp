#include "engine/holograms/hologram.h"

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "engine/session/coach.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"
#include "engine/session/tools_in_hand.h"

namespace orthonav::engine {
namespace {

// The next act is from what a frame shows: a frame that lost its tool does not ask for what only a
// measured one allows.

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

/// What to do next: "tip to the entry", "turn the tool", "drill". Nothing in other steps, whose
/// status line says it, and while a stop is shown.
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

/// H11, with the next act and a stop.
class StatusLineHologram : public Hologram {
 public:
  void draw(const Guidance& guidance, const Visibility& visible, render::Scene& scene) override {
    dots_.clear();
    for (const ToolSight& tool : guidance.tools) {
      // A red dot for a tool that nobody needs now would be a false alarm.
      if (guidance.step != Step::kSetup && !used_in(tool.role, guidance.step)) {
        continue;
      }
      const ToolState state = tool.status == PoseStatus::kMeasured    ? ToolState::kMeasured
                              : tool.status == PoseStatus::kPredicted ? ToolState::kPredicted
                                                                      : ToolState::kLost;
      dots_.push_back({state});
    }
    text_.clear();
    append_step(text_, guidance.status.at);
    detail_.clear();
    parts_of_detail_.clear();
    append_detail(detail_, guidance.status, &parts_of_detail_);
    const bool acts = detail_.empty();
    detail_.clear();
    parts_of_detail_.clear();
    append_beside_step(detail_, guidance.status, &parts_of_detail_);
    add_status_line(scene, StatusWords{text_, detail_, &parts_of_detail_}, dots_,
                    label_of(HologramKind::kStatus, 1));
    if (acts) {
      text_.clear();
      append_next_act(text_, guidance, visible);
      add_next_act(scene, text_, detail_.empty() ? 1 : 2, labels::kNextAct);
    }
    if (visible.drill.alarm == nav::DrillAlarm::kStop) {
      text_.clear();
      append_drill(text_, visible.drill);
      add_stop_row(scene, text_, labels::kStop);
    }
  }

  void tell(const Guidance& guidance, const Visibility& visible, ShownHolograms& told) override {
    const StatusLine& line = guidance.status;
    if (!told.frame().status) {
      told.frame().status.emplace();
    }
    ShownStatus& status = *told.frame().status;
    status.at = line.at;
    status.notice = line.message ? notice_of(*line.message) : Notice::kNone;
    status.checks = checks_asked(line);
    const auto* strokes = std::get_if<StrokesSoFar>(&line.state);
    status.strokes_enough = strokes != nullptr && strokes->coaching && strokes->coaching->enough;
    status.text.clear();
    append_without_heard(status.text, line);
    constexpr std::string_view kSeparator = " | ";
    if (status.text.find(kSeparator) == std::string::npos) {
      const std::size_t end = status.text.size();
      status.text += kSeparator;
      append_next_act(status.text, guidance, visible);
      if (status.text.size() == end + kSeparator.size()) {
        status.text.resize(end);
      }
    }
    status.heard.clear();
    if (line.heard) {
      append_heard(status.heard, *line.heard);
    }
  }

 private:
  std::string text_;
  std::string detail_;
  StatusParts parts_of_detail_;
  std::vector<ToolDot> dots_;
};

}  // namespace

std::unique_ptr<Hologram> status_hologram() { return std::make_unique<StatusLineHologram>(); }

}  // namespace orthonav::engine

#include "tools/orthonav/plan/received_plans.h"

#include <algorithm>
#include <utility>

#include "engine/case/operation_plan.h"
#include "engine/case/plan_file.h"

namespace orthonav::tools {
namespace {

/// What a refusal calls the text.
constexpr const char* kPlanText = "Plan";

}  // namespace

Result<JudgedLevel> ReceivedPlans::take(const std::string& text) {
  const auto plan = engine::parse_plan(text, kPlanText);
  if (!plan) {
    return plan.error();
  }
  if (plan->level.empty()) {
    return Error{std::string(kPlanText) + ": must name its level"};
  }
  if (Status s = engine::check_level(subject_, plan->level); !s) {
    return Error{std::string(kPlanText) + ": " + s.error().message};
  }
  const auto level =
      std::find_if(subject_.levels.begin(), subject_.levels.end(),
                   [&](const engine::CaseLevel& each) { return each.label == plan->level; });
  auto screws = engine::screws_on(level->mesh, *plan);
  if (!screws) {
    return screws.error();
  }
  auto before = std::exchange(level->screws, *std::move(screws));
  JudgedLevel out = judged(*level, sizes_);
  for (const JudgedScrew& screw : out.screws) {
    if (screw.breaks_through()) {
      level->screws = std::move(before);
      return Error{std::string(kPlanText) + ": " + breach_text(out.label, screw) +
                   "; accept_breach says why it may"};
    }
  }
  received_.insert(level->label);
  return out;
}

}  // namespace orthonav::tools

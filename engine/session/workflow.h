#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/session/event.h"
#include "engine/session/method_steps.h"
#include "engine/session/workflow_rules.h"
#include "hal/api/shown_status.h"

namespace orthonav::engine {

using orthonav::kStepCount;

struct Cell {
  Step next = Step::kSetup;
  Action action = Action::kRefuse;
  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

namespace workflow_detail {
using enum Step;
using enum Action;

using Table = std::array<std::array<Cell, kEventCount>, kStepCount>;

/// Whether this step is done by eye alone, without touching.
constexpr bool is_by_eye(Step step, const MethodSteps& steps) {
  return (step == kDigitize && !steps.landmark) || (step == kVerify && !steps.check_points) ||
         (step == kAccepted && !steps.dimple()) || (step == kGuide && !steps.wire);
}

/// Every cell starts as a refusal that stays in its step; the rules overwrite their cells.
constexpr Table make_table(const MethodSteps& steps, bool rods_alone) {
  Table table{};
  for (std::size_t step = 0; step < kStepCount; ++step) {
    for (Cell& cell : table[step]) {
      cell = {static_cast<Step>(step), kRefuse};
    }
  }
  const auto write = [&table](const Rule& rule) {
    table[static_cast<std::size_t>(rule.step)][static_cast<std::size_t>(rule.event)] = {
        rule.next, rule.action};
  };
  std::for_each(kRules.begin(), kRules.end(), write);
  for (const Rule& rule : kRulesByEye) {
    if (is_by_eye(rule.step, steps)) {
      write(rule);
    }
  }
  if (!steps.landmark && steps.wire) {
    std::for_each(kRulesTouchedOnce.begin(), kRulesTouchedOnce.end(), write);
  } else if (steps.landmark && !steps.wire) {
    std::for_each(kRulesWireUnmeasured.begin(), kRulesWireUnmeasured.end(), write);
  }
  if (rods_alone) {
    std::for_each(kRulesRodsAlone.begin(), kRulesRodsAlone.end(), write);
  }
  return table;
}

/// Two rules for one cell would silently hide the first.
consteval bool rules_are_unique(const auto& rules) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    for (std::size_t j = i + 1; j < rules.size(); ++j) {
      if (rules[i].step == rules[j].step && rules[i].event == rules[j].event) {
        return false;
      }
    }
  }
  return true;
}
static_assert(rules_are_unique(kRules) && rules_are_unique(kRulesByEye) &&
                  rules_are_unique(kRulesTouchedOnce) && rules_are_unique(kRulesWireUnmeasured) &&
                  rules_are_unique(kRulesRodsAlone),
              "two rules of the workflow share a cell");
}  // namespace workflow_detail

/// How a registration whose numbers passed is verified before anything is guided on it.
enum class Verification : std::uint8_t {
  kByTouch,  ///< by eye and by touching places of the bone
  kByEye,    ///< by eye alone, as in the published method
};

using Workflow = workflow_detail::Table;

/// The table with only these steps of the method; with `rods_alone` it goes from setup to the rods.
[[nodiscard]] constexpr Workflow workflow_of(const MethodSteps& steps, bool rods_alone = false) {
  return workflow_detail::make_table(steps, rods_alone);
}
inline constexpr Workflow kWorkflow = workflow_of(MethodSteps{});
inline constexpr Workflow kWorkflowRodsAlone = workflow_of(MethodSteps{}, true);
inline constexpr Workflow kWorkflowByEye = workflow_of(MethodSteps::none());

/// A table's answer: every step answers every event.
[[nodiscard]] constexpr Cell answer(const Workflow& table, Step step, Event event) {
  return table[static_cast<std::size_t>(step)][static_cast<std::size_t>(event)];
}
[[nodiscard]] constexpr Cell answer(Step step, Event event,
                                    Verification verification = Verification::kByTouch) {
  return answer(verification == Verification::kByEye ? kWorkflowByEye : kWorkflow, step, event);
}

using orthonav::name_of;
[[nodiscard]] std::string_view name_of(Event event);
[[nodiscard]] std::string_view name_of(Action action);

}  // namespace orthonav::engine

#include "tools/orthonav/igtl/igtl_requests.h"

#include <algorithm>

#include "engine/case/plan_file.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/workflow/commands.h"

namespace orthonav::tools {
namespace {

constexpr std::size_t kLongestCommand = 80;

Result<engine::Request> command_of(const std::string& text) {
  const bool plain =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= 0x20 && c < 0x7f; });
  if (!plain || text.size() > kLongestCommand) {
    return Error{"is not a command: one line of at most " + std::to_string(kLongestCommand) +
                 " letters is"};
  }
  engine::Request request;
  request.text = text;
  if (engine::command_event(text)) {
    return request;
  }
  const auto replan = engine::replan_from(text);
  if (!replan) {
    return Error{"\"" + text + "\" is not a command"};
  }
  return *replan ? Result<engine::Request>(request) : replan->error();
}

Result<engine::Request> plan_of(const std::string& text) {
  const auto plan = engine::parse_plan(text, "Plan");
  if (!plan) {
    return plan.error();
  }
  if (plan->level.empty()) {
    return Error{"Plan: must name its level"};
  }
  if (plan->screws.size() != 1) {
    return Error{"Plan: holds " + std::to_string(plan->screws.size()) +
                 " screws, must be 1: that in work"};
  }
  const engine::StatedScrew& screw = plan->screws.front();
  if (!screw.accepted_breach.empty()) {
    return Error{"Plan: accept_breach is not taken from outside: the surgeon is asked"};
  }
  if (!screw.side) {
    return Error{"Plan: must say left or right"};
  }
  engine::Request request;
  request.change =
      engine::PlaceScrew{plan->level, *screw.side, screw.entry, screw.target, screw.radius_m};
  request.text = engine::text_of(*request.change);
  return request;
}

}  // namespace

Result<engine::Request> request_of(const std::string& device, const std::string& text) {
  return device == "Plan" ? plan_of(text) : command_of(text);
}

}  // namespace orthonav::tools

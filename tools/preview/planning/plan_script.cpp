#include "tools/preview/planning/plan_script.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace orthonav::preview {
namespace {

constexpr auto kPlanWords = std::to_array<ScriptWord>({
    {"key", Follows::kKey},
    {"say", Follows::kText},     // a change, as typed in the panel
    {"select", Follows::kText},  // "L4 left"
    {"drag", Follows::kText},    // "axial target 2 -1.5": mm to the right and up
    kResize,
    {"screenshot", Follows::kText},
});

struct NamedPart {
  std::string_view name;
  nav::ScrewPart part;
};
constexpr std::array<NamedPart, 3> kParts = {{{"screw", nav::ScrewPart::kWhole},
                                              {"entry", nav::ScrewPart::kEntry},
                                              {"target", nav::ScrewPart::kTarget}}};
constexpr std::array<Pane, 3> kSlices = {Pane::kAxial, Pane::kSagittal, Pane::kAcross};

Status select(const std::string& rest, PlanModel& model) {
  std::istringstream in(rest);
  std::string label, side, more;
  const bool two = (in >> label >> side) && !(in >> more);
  if (!two || (side != "left" && side != "right")) {
    return Error{"needs a level and left or right"};
  }
  const auto& levels = model.editor().subject().levels;
  const auto level = std::find_if(levels.begin(), levels.end(),
                                  [&](const auto& known) { return known.label == label; });
  if (level == levels.end()) {
    return Error{"the case has no level \"" + label + "\""};
  }
  model.select({static_cast<std::size_t>(level - levels.begin()),
                side == "left" ? nav::Side::kLeft : nav::Side::kRight});
  return {};
}

Status drag(const std::string& rest, PlanModel& model) {
  std::istringstream in(rest);
  std::string slice_name, part_name, numbers;
  in >> slice_name >> part_name;
  std::getline(in, numbers);
  const auto by_mm = numbers_in(numbers, 2);
  const auto slice = std::find_if(kSlices.begin(), kSlices.end(),
                                  [&](Pane known) { return name_of(known) == slice_name; });
  const auto part = std::find_if(kParts.begin(), kParts.end(),
                                 [&](const NamedPart& known) { return known.name == part_name; });
  if (!by_mm || slice == kSlices.end() || part == kParts.end()) {
    return Error{
        "needs axial, sagittal or across, then screw, entry or target, then mm to the right and "
        "up"};
  }
  const Vec2 by_m{1e-3 * (*by_mm)[0], 1e-3 * (*by_mm)[1]};
  return model.drag(*slice, part->part, by_m) ? Status{} : Error{"no screw can lie there"};
}

}  // namespace

std::span<const ScriptWord> plan_script_words() { return kPlanWords; }

Status perform(const ScriptLine& line, PlanModel& model, const ScriptStage& stage) {
  if (line.word == "key") {
    const auto key = key_named(line.rest);
    if (!key || plan_binding_of(*key) == nullptr) {
      return Error{"\"" + line.rest + "\" does nothing while a plan is edited"};
    }
    model.key(*key, true);
  } else if (line.word == "say") {
    model.say(line.rest);
    return model.note().empty() ? Status{} : Error{model.note()};
  } else if (line.word == "select") {
    return select(line.rest, model);
  } else if (line.word == "drag") {
    return drag(line.rest, model);
  } else if (line.word == "resize") {
    const auto size = numbers_in(line.rest, 2).value_or(std::array<double, 2>{});
    stage.resize(static_cast<int>(size[0]), static_cast<int>(size[1]));
  } else if (line.word == "screenshot") {
    stage.screenshot(line.rest);
  }
  return {};
}

}  // namespace orthonav::preview

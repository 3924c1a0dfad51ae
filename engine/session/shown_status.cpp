#include "engine/session/shown_status.h"

#include <array>

namespace orthonav::engine {

std::string_view name_of(Step step) {
  constexpr std::array<std::string_view, kStepCount> kNames = {
      "setup", "digitize", "registering", "verify", "landmark", "guide", "measure", "rod", "done"};
  // A name forgotten at the end would be empty.
  static_assert(!kNames.back().empty());
  return kNames[static_cast<std::size_t>(step)];
}

std::string name_of(const StepOnDisplay& at) {
  std::string name(name_of(at.step));
  if (!at.level.empty()) {
    name += " " + at.level;
  }
  if (at.side) {
    name += std::string(" ") + name_of(*at.side);
  }
  return name;
}

}  // namespace orthonav::engine

#include "engine/session/shown_status.h"

namespace orthonav::engine {

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

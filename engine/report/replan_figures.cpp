#include "engine/report/replan_figures.h"

#include <nlohmann/json.hpp>

#include "engine/session/journal_lines.h"
#include "engine/session/replan_wording.h"

namespace orthonav::engine {

void put_planned_in_surgery(nlohmann::ordered_json& screw_json,
                            const std::optional<nav::ScrewDifference>& difference) {
  if (!difference) {
    return;
  }
  screw_json["planned_in_surgery"] = difference_line(*difference);
  screw_json["planned_in_surgery"]["text"] = text_of(*difference);
}

}  // namespace orthonav::engine

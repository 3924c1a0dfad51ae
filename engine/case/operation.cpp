#include "engine/case/operation.h"

#include <set>

#include "base/how_many.h"

namespace orthonav::engine {

std::vector<std::string> Operation::check() const {
  std::vector<std::string> problems;
  if (levels.empty() && !rods_alone) {
    problems.push_back("operation: no level, at least 1 needed, unless it is of rods alone");
  } else if (rods_alone && !levels.empty()) {
    problems.push_back("operation: of rods alone, but has " + how_many(levels.size(), "level"));
  }
  std::set<std::string> labels;
  for (const OperatedLevel& level : levels) {
    const std::string where = "operation: level '" + level.label + "': ";
    if (level.label.empty()) {
      problems.push_back(where + "has no label");
    }
    if (!labels.insert(level.label).second) {
      problems.push_back(where + "named twice");
    }
    if (!level.model) {
      problems.push_back(where + "has no model");
    }
    if (level.screws.empty()) {
      problems.push_back(where + "has no screw, at least 1 needed");
    }
  }
  return problems;
}

}  // namespace orthonav::engine

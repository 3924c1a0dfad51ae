#include "engine/case/operation.h"

#include <set>

namespace orthonav::engine {

std::vector<std::string> Operation::check() const {
  std::vector<std::string> problems;
  if (levels.empty()) {
    problems.push_back("operation: no level, at least 1 needed");
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

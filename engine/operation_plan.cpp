#include "engine/operation_plan.h"

#include <algorithm>
#include <set>

namespace orthonav::engine {
namespace {

std::string known_labels(const Case& source) {
  std::string out;
  for (const CaseLevel& level : source.levels) out += (out.empty() ? "" : ", ") + level.label;
  return out;
}

std::vector<std::string> two_lowest(const Case& source) {
  std::vector<const CaseLevel*> levels;
  for (const CaseLevel& level : source.levels) levels.push_back(&level);
  // Height along the spine (+z superior), not the name: a case may call its levels anything.
  std::stable_sort(levels.begin(), levels.end(), [](const CaseLevel* a, const CaseLevel* b) {
    return a->centre_in_spine().v.z < b->centre_in_spine().v.z;
  });
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, levels.size()); ++i)
    labels.push_back(levels[i]->label);
  return labels;
}

}  // namespace

Result<std::vector<std::string>> levels_to_operate(const Case& source,
                                                   const std::vector<std::string>& labels) {
  const std::vector<std::string> wanted = labels.empty() ? two_lowest(source) : labels;
  std::set<std::string> open;
  for (const std::string& label : wanted) {
    if (!source.find(label))
      return Error{"case '" + source.name + "' has no level '" + label +
                   "' (it has: " + known_labels(source) + ")"};
    if (!open.insert(label).second) return Error{"level '" + label + "' is named twice"};
  }
  std::vector<std::string> ordered;
  for (const CaseLevel& level : source.levels)
    if (open.contains(level.label)) ordered.push_back(level.label);
  return ordered;
}

Result<Operation> plan_operation(const Case& source, const std::vector<std::string>& labels) {
  const auto ordered = levels_to_operate(source, labels);
  if (!ordered) return ordered.error();
  Operation operation;
  operation.case_name = source.name;
  for (const std::string& label : *ordered) {
    const CaseLevel& level = *source.find(label);
    auto model = nav::VertebraModel::prepare(level.mesh);
    if (!model)
      return Error{"case '" + source.name + "', level '" + label + "': " + model.error().message};
    operation.levels.push_back({label, *model, level.screws});
  }
  return operation;
}

}  // namespace orthonav::engine

#include "engine/case/operation_plan.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "engine/case/screw_breach.h"

namespace orthonav::engine {
namespace {

std::string known_labels(const Case& source) {
  std::string out;
  for (const CaseLevel& level : source.levels) {
    out += (out.empty() ? "" : ", ") + level.label;
  }
  return out;
}

/// By height along the spine (+z superior), not by name: a case may call its levels anything.
std::vector<const CaseLevel*> from_the_lowest(const Case& source) {
  std::vector<const CaseLevel*> levels;
  for (const CaseLevel& level : source.levels) {
    levels.push_back(&level);
  }
  std::stable_sort(levels.begin(), levels.end(), [](const CaseLevel* a, const CaseLevel* b) {
    return a->centre_in_spine().v.z < b->centre_in_spine().v.z;
  });
  return levels;
}

std::vector<std::string> other_levels(const Case& source, const std::string& label) {
  std::vector<std::string> out;
  for (const CaseLevel* level : from_the_lowest(source)) {
    if (level->label != label) {
      out.push_back(level->label);
    }
  }
  return out;
}

/// Prepares each level once.
class PreparedLevels {
 public:
  explicit PreparedLevels(const Case& source) : source_(source) {}

  Result<std::shared_ptr<const nav::VertebraModel>> model(const std::string& label) {
    if (const auto known = models_.find(label); known != models_.end()) {
      return known->second;
    }
    auto model = nav::VertebraModel::prepare(source_.find(label)->mesh);
    if (!model) {
      return Error{"case '" + source_.name + "', level '" + label + "': " + model.error().message};
    }
    return models_[label] = *model;
  }

 private:
  const Case& source_;
  std::map<std::string, std::shared_ptr<const nav::VertebraModel>> models_;
};

std::vector<std::string> two_lowest(const Case& source) {
  const auto levels = from_the_lowest(source);
  std::vector<std::string> labels;
  for (const CaseLevel* level : levels) {
    if (!level->screws.empty() && labels.size() < 2) {
      labels.push_back(level->label);
    }
  }
  return labels;
}

Operation without_levels(const Case& source) {
  Operation operation;
  operation.case_name = source.name;
  for (const CaseLevel* level : from_the_lowest(source)) {
    operation.spine.push_back({level->label, level->centre_in_spine().v.z});
  }
  return operation;
}

}  // namespace

Status check_level(const Case& source, const std::string& label) {
  if (source.find(label) != nullptr) {
    return {};
  }
  return Error{"case '" + source.name + "' has no level '" + label +
               "' (it has: " + known_labels(source) + ")"};
}

Result<std::vector<std::string>> levels_to_operate(const Case& source,
                                                   const std::vector<std::string>& labels) {
  const std::vector<std::string> wanted = labels.empty() ? two_lowest(source) : labels;
  std::set<std::string> open;
  for (const std::string& label : wanted) {
    if (Status s = check_level(source, label); !s) {
      return s.error();
    }
    if (source.find(label)->screws.empty()) {
      return Error{"level '" + label + "' of case '" + source.name + "' has no screws"};
    }
    if (!open.insert(label).second) {
      return Error{"level '" + label + "' is named twice"};
    }
  }
  std::vector<std::string> ordered;
  for (const CaseLevel& level : source.levels) {
    if (open.contains(level.label)) {
      ordered.push_back(level.label);
    }
  }
  return ordered;
}

Result<Operation> plan_without_models(const Case& source, const std::vector<std::string>& labels) {
  const auto ordered = levels_to_operate(source, labels);
  if (!ordered) {
    return ordered.error();
  }
  Operation operation = without_levels(source);
  for (const std::string& label : *ordered) {
    operation.levels.push_back({label, nullptr, source.find(label)->screws, {}});
  }
  return operation;
}

Result<Operation> plan_operation(const Case& source, const std::vector<std::string>& labels) {
  auto operation = plan_without_models(source, labels);
  if (!operation) {
    return operation;
  }
  PreparedLevels prepared(source);
  for (OperatedLevel& level : operation->levels) {
    const auto model = prepared.model(level.label);
    if (!model) {
      return model.error();
    }
    level.model = *model;
    for (const nav::ScrewPlan& screw : level.screws) {
      if (const auto problem = breach_problem(**model, screw)) {
        return Error{"case '" + source.name + "': " + level.label + " " + *problem};
      }
    }
    for (const std::string& other : other_levels(source, level.label)) {
      const auto other_model = prepared.model(other);
      if (!other_model) {
        return other_model.error();
      }
      level.neighbours.push_back({other, *other_model});
    }
  }
  return operation;
}

Operation plan_rods_alone(const Case& source) {
  Operation operation = without_levels(source);
  operation.rods_alone = true;
  return operation;
}

}  // namespace orthonav::engine

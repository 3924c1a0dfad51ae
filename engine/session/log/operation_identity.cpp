#include "engine/session/log/operation_identity.h"

#include "base/joined.h"
#include "engine/case/case.h"
#include "engine/case/tool_file.h"

namespace orthonav::engine {
namespace {

/// Hashes the models of the levels to be operated, then of the others.
std::string models_hash(std::span<const LevelState> levels) {
  BitHash hash;
  for (const LevelState& level : levels) {
    hash.add(level.plan.label);
    add(hash, level.plan.model->mesh());
  }
  if (!levels.empty()) {
    for (const NeighbouringLevel& neighbour : levels.front().plan.neighbours) {
      hash.add(neighbour.label);
      add(hash, neighbour.model->mesh());
    }
  }
  return hash.text();
}

std::string plan_hash(std::span<const LevelState> levels) {
  BitHash hash;
  for (const LevelState& level : levels) {
    hash.add(level.plan.label);
    for (const ScrewState& screw : level.screws) {
      const nav::ScrewPlan& plan = screw.preoperative;
      hash.add(static_cast<std::uint64_t>(plan.side));
      hash.add(plan.entry.v);
      hash.add(plan.target.v);
      hash.add(plan.radius_m);
      hash.add(plan.accepted_breach);
    }
  }
  return hash.text();
}

/// "NAME: WHAT".
Error refused(const std::string& name, const std::string& what) {
  return Error{name + ": " + what};
}

std::string with_or_without(bool reference) {
  return reference ? "with a patient reference" : "without a patient reference";
}

}  // namespace

std::string levels_text(const OperationIdentity& identity) {
  return identity.levels.empty() ? "rods alone" : "levels " + joined(identity.levels, ", ");
}

OperationIdentity identity_of(const std::string& case_name, std::span<const LevelState> levels,
                              std::span<const nav::ToolGeometry> tools, const std::string& method,
                              bool patient_reference) {
  OperationIdentity identity;
  identity.case_name = case_name;
  for (const LevelState& level : levels) {
    identity.levels.push_back(level.plan.label);
  }
  identity.models_hash = models_hash(levels);
  identity.plan_hash = plan_hash(levels);
  BitHash tools_hash;
  tools_hash.add(tools_text({tools.begin(), tools.end()}));
  identity.tools_hash = tools_hash.text();
  identity.method = method;
  identity.patient_reference = patient_reference;
  return identity;
}

Status check_same(const OperationIdentity& recorded, const OperationIdentity& now,
                  const std::string& name) {
  if (recorded.case_name != now.case_name) {
    return refused(name, "is of case '" + recorded.case_name + "', not of '" + now.case_name + "'");
  }
  if (recorded.levels != now.levels) {
    return refused(name, "is of " + levels_text(recorded) + ", not of " + levels_text(now));
  }
  if (recorded.models_hash != now.models_hash) {
    return refused(name, "is of another patient: the models of case '" + now.case_name + "' were " +
                             recorded.models_hash + ", are " + now.models_hash);
  }
  if (recorded.room != now.room) {
    return refused(
        name, "is of the simulated patient '" + recorded.room + "', not of '" + now.room + "'");
  }
  if (recorded.plan_hash != now.plan_hash) {
    return refused(name, "has another plan: that of case '" + now.case_name + "' was " +
                             recorded.plan_hash + ", is " + now.plan_hash);
  }
  if (recorded.tools_hash != now.tools_hash) {
    return refused(name, "has other tools: their definition was " + recorded.tools_hash + ", is " +
                             now.tools_hash);
  }
  if (recorded.method != now.method) {
    return refused(name,
                   "was begun with method '" + recorded.method + "', not '" + now.method + "'");
  }
  if (recorded.patient_reference != now.patient_reference) {
    return refused(name, "was begun " + with_or_without(recorded.patient_reference) + ", not " +
                             with_or_without(now.patient_reference));
  }
  return {};
}

}  // namespace orthonav::engine

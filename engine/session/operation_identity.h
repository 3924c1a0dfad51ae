#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/session/guidance.h"
#include "nav/registration/tre.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// What an operation is: enough to tell whether another program continues the same one.
struct OperationIdentity {
  std::string case_name;
  std::vector<std::string> levels;  ///< to be operated, in their order
  std::string models_hash;          ///< of every model of the case (BitHash)
  std::string plan_hash;            ///< of the screws as planned before surgery
  std::string tools_hash;
  std::string method;
  bool patient_reference = false;
  std::string room;   ///< of a simulated patient, what makes it another one; empty: a real one
  std::string begun;  ///< when, on the wall; for people alone
  /// As they were taken to be; a registration holds its own.
  nav::CommonErrors common;
};

/// Fills in all but `room`, `begun` and `common`; the plan is that before surgery.
[[nodiscard]] OperationIdentity identity_of(const std::string& case_name,
                                            std::span<const LevelState> levels,
                                            std::span<const nav::ToolGeometry> tools,
                                            const std::string& method, bool patient_reference);

/// Refuses, in one line, to go on with `recorded` as `now`: another patient, plan, tool or method.
/// `name` is the file that `recorded` was read from.
Status check_same(const OperationIdentity& recorded, const OperationIdentity& now,
                  const std::string& name);

}  // namespace orthonav::engine

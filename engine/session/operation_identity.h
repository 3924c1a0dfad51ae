#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/session/guidance.h"
#include "nav/registration/tre.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// Identifies an operation well enough to tell whether another program continues the same one.
struct OperationIdentity {
  std::string case_name;
  std::vector<std::string> levels;  ///< to be operated, in order
  std::string models_hash;          ///< of every model of the case (BitHash)
  std::string plan_hash;            ///< of the screws as planned before surgery
  std::string tools_hash;
  std::string method;
  bool patient_reference = false;
  std::string room;   ///< identifies a simulated patient; empty: a real one
  std::string begun;  ///< wall-clock time of the start, for human readers only
  /// As assumed at the start; a registration holds its own.
  nav::CommonErrors common;
};

/// Fills in all but `room`, `begun` and `common`; uses the preoperative plan.
[[nodiscard]] OperationIdentity identity_of(const std::string& case_name,
                                            std::span<const LevelState> levels,
                                            std::span<const nav::ToolGeometry> tools,
                                            const std::string& method, bool patient_reference);

/// "levels L4, L5", or "rods alone".
[[nodiscard]] std::string levels_text(const OperationIdentity& identity);

/// Refuses, in one line, to continue `recorded` as `now` if patient, plan, tools or method differ.
/// `name` is the file that `recorded` was read from.
Status check_same(const OperationIdentity& recorded, const OperationIdentity& now,
                  const std::string& name);

}  // namespace orthonav::engine

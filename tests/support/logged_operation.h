#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/session/log/operation_log.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::test {

inline const std::string kLogFolder = "out";
inline const std::string kLogPath = "out/operation.resume";

inline engine::OperationIdentity identity_of(ScriptedOperation& s, bool reference = false) {
  const engine::Session& session = s.session();
  return engine::identity_of("boxes", session.levels(), session.tracker().tools(), "scripted",
                             reference);
}

/// Begins the log of a scripted operation, whose status line then shows when it is saved.
inline std::unique_ptr<engine::OperationLog> log_of(ScriptedOperation& s, engine::Env& env,
                                                    bool reference = false) {
  auto log = engine::OperationLog::begin(
                 env, kLogFolder, identity_of(s, reference), s.session().levels(),
                 engine::RecordWriter::Waits::kUntilDurable, engine::RecordLog::Earlier::kKept)
                 .value();
  s.session().observe(log.get());
  s.session().show_saving(log.get());
  return log;
}

}  // namespace orthonav::test

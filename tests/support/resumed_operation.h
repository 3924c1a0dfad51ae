#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"

namespace orthonav::test {

/// The scripted operations that are resumed: two levels, verified by touch. The clearance in every
/// pair, which no log keeps, is left out.
inline std::unique_ptr<ScriptedOperation> touched_operation(bool reference) {
  engine::SessionOptions options = three_places();
  options.live_clearance = false;
  auto s = std::make_unique<ScriptedOperation>(std::vector<std::string>{"L4", "L5"}, options,
                                               engine::Verification::kByTouch, false, reference);
  s->registers_within(0.0003);
  if (reference) {
    s->tracker().reference.places = {{2, Transform<World, Marker>(Mat3::identity(), {0, 0, 0.1})}};
    s->tracker().reference.places_changed = 1;
  }
  return s;
}

/// The same operation in another program, from the log that a crash left.
struct ResumedOperation {
  explicit ResumedOperation(engine::Env& env, bool reference,
                            const std::string& folder = kLogFolder)
      : operation(touched_operation(reference)) {
    auto found = engine::OperationLog::find(env, folder).value();
    engine::LoggedOperation logged = found.operation;
    before = found.operation;
    logged.reopen();
    if (reference) {
      operation->tracker().reference.places = logged.references;
    }
    resumed = operation->session().resume(logged);
    log = engine::OperationLog::reopen(env, std::move(found),
                                       engine::RecordWriter::Waits::kUntilDurable);
    operation->session().observe(log.get());
    operation->session().show_saving(log.get());
  }

  std::unique_ptr<ScriptedOperation> operation;
  engine::LoggedOperation before;  ///< according to the log
  Status resumed;
  std::unique_ptr<engine::OperationLog> log;
};

}  // namespace orthonav::test

#pragma once

#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "tools/stop_signals.h"

namespace orthonav::tools {

/// Notes in the result of an operation that did not complete that a signal stopped it, if one did.
void explain_stop(const StopSignals& signals, engine::OperationResult& result);

/// Where a signal stopped the run: says on standard error in which folders its results are; empty
/// names are none.
void tell_what_is_kept(const StopSignals& signals, const std::vector<std::string>& folders);

}  // namespace orthonav::tools

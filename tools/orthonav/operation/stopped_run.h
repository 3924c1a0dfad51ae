#pragma once

#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {

/// If a signal stopped the operation before its end, says so in the result.
void explain_stop(const StopSignals& signals, engine::OperationResult& result);

/// If a signal stopped the run, names on standard error the folders that hold its results. Empty
/// names are skipped.
void tell_what_is_kept(const StopSignals& signals, const std::vector<std::string>& folders);

}  // namespace orthonav::tools

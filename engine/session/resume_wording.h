#pragma once

#include <string>
#include <vector>

#include "engine/session/operation_log.h"

namespace orthonav::engine {

/// What an operation was that is about to be resumed, what of it stands, what must be verified and
/// what is lost, line by line, for whoever starts the program.
[[nodiscard]] std::vector<std::string> resume_lines(const OperationLog::Found& found);

}  // namespace orthonav::engine

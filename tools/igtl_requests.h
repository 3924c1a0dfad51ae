#pragma once

#include <string>

#include "base/result.h"
#include "engine/session/request.h"

namespace orthonav::tools {

/// What a client's text asks for, by the device that it is of: `Command` or `Plan`; still without
/// time and client. An Error in one line where it is neither.
[[nodiscard]] Result<engine::Request> request_of(const std::string& device,
                                                 const std::string& text);

}  // namespace orthonav::tools

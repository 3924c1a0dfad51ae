#pragma once

#include <string>

#include "base/result.h"
#include "engine/session/workflow/commands.h"

namespace orthonav::tools {

/// The request in a client's text, by its device: `Command` or `Plan`; without time and client. An
/// Error in one line for any other device.
[[nodiscard]] Result<engine::Request> request_of(const std::string& device,
                                                 const std::string& text);

}  // namespace orthonav::tools

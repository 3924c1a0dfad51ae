#pragma once

#include <optional>
#include <string>

#include "engine/session/request.h"
#include "engine/session/session_steps.h"

namespace orthonav::engine {

// What is said, and what other programs ask. Returns the event that the table answers; none where
// it was not understood, or can't be meant, which the surgeon is told here.

/// `from`: who asked, where nobody in the room said it.
[[nodiscard]] std::optional<Event> hear(OperationInWork& work, SessionSteps& steps,
                                        const Phrase& phrase, const std::string& from = {});
/// Another program is sure of what it asks.
[[nodiscard]] std::optional<Event> hear(OperationInWork& work, SessionSteps& steps,
                                        const Request& request);

}  // namespace orthonav::engine

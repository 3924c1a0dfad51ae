#pragma once

#include <optional>
#include <string>

#include "engine/session/request.h"
#include "engine/session/session_steps.h"

namespace orthonav::engine {

// Interprets what is said and what other programs ask. Returns the event for the table to answer;
// none if it was not understood or can't be meant, which the surgeon is told here.

/// `from`: who asked, unless it was said in the room.
[[nodiscard]] std::optional<Event> hear(OperationInWork& work, SessionSteps& steps,
                                        const Phrase& phrase, const std::string& from = {});
/// Requests of other programs always count as understood.
[[nodiscard]] std::optional<Event> hear(OperationInWork& work, SessionSteps& steps,
                                        const Request& request);

}  // namespace orthonav::engine

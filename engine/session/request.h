#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "engine/session/replan.h"

namespace orthonav::engine {

/// A request of another program: the words that would be said in the room, or a new plan of a
/// screw. It is answered as if it had been said at `time`.
struct Request {
  std::string text;  ///< "next"; with a change, its description: "plan L4 left"
  std::string from;  ///< who asks, for the surgeon and the journal
  Timestamp time{};
  std::optional<Replan> change;  ///< of the current screw
};

class Requests {
 public:
  virtual ~Requests() = default;
  /// Appends the requests up to `until`, in order of time, each once. Does not block.
  virtual void take(Timestamp until, std::vector<Request>& requests) = 0;
};

}  // namespace orthonav::engine

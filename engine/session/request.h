#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.h"
#include "engine/session/replan.h"

namespace orthonav::engine {

/// What somebody asks who is not in the room: another program, by the words that one would say, or
/// a screw as it is to be. It is answered as if it had been said then.
struct Request {
  std::string text;  ///< "next"; with a change, what that is: "plan L4 left"
  std::string from;  ///< who asks, as the surgeon and the journal are told
  Timestamp time{};
  std::optional<Replan> change;  ///< of the screw in work
};

class Requests {
 public:
  virtual ~Requests() = default;
  /// Appends what was asked up to `until`, in order of time, each once. Does not block.
  virtual void take(Timestamp until, std::vector<Request>& requests) = 0;
};

}  // namespace orthonav::engine

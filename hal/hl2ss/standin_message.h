#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "hal/api/devices.h"
#include "hal/api/wearer.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

// The side channel between our client and our own server: it carries what a real headset's wearer
// would see and press. It is not part of hl2ss. Times are nanoseconds of the server's clock.

/// Server: the first message.
struct StandinHello {
  bool paced = false;  ///< the next pair is sent when the client is done with the last one
  Duration display_latency{};
  Timestamp clock{};
  MayRepeat may_repeat{};  ///< as the served headset says of itself
};
/// Server: events of the button.
struct StandinClicks {
  std::vector<ClickerEvent> events;
};
/// Server: all clicks up to the pair of this time have been sent; also its clock when the pair was
/// available.
struct StandinUpTo {
  Timestamp pair_time{};
  Timestamp clock{};
};
/// Server: there are no more pairs.
struct StandinEnd {};
/// Client: what is shown.
struct StandinShown {
  WornFrame frame;
};
/// Client: it is done with the pair of this time.
struct StandinTook {
  Timestamp pair_time{};
};
using StandinMessage =
    std::variant<StandinHello, StandinClicks, StandinUpTo, StandinEnd, StandinShown, StandinTook>;

void append(std::vector<std::uint8_t>& bytes, const StandinMessage& message);

/// The next message with its size in bytes; nothing while bytes are missing; an Error for an
/// invalid message.
struct ReadStandinMessage {
  StandinMessage message;
  std::size_t bytes = 0;
};
Result<std::optional<ReadStandinMessage>> read_standin_message(Bytes bytes);

inline constexpr std::size_t kMaxStandinBytes = std::size_t{1} << 20;

}  // namespace orthonav::hl2ss

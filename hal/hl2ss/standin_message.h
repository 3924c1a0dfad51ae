#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "hal/api/devices.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

// The side channel between our client and our own server: what a real headset's wearer would see
// and press goes over it. It is no part of hl2ss. Times are nanoseconds of the server's clock.

/// Server, first of all.
struct StandinHello {
  bool paced = false;  ///< the next pair comes when the last one was done with
  Duration display_latency{};
  Timestamp clock{};
};
/// Server: what the button did.
struct StandinClicks {
  std::vector<ClickerEvent> events;
};
/// Server: clicks up to the pair of this time were sent; its clock when the pair was there.
struct StandinUpTo {
  Timestamp pair_time{};
  Timestamp clock{};
};
/// Server: no pair will come any more.
struct StandinEnd {};
/// Client: what is shown.
struct StandinShown {
  ShownFrame frame;
};
/// Client: it is done with the pair of this time.
struct StandinTook {
  Timestamp pair_time{};
};
using StandinMessage =
    std::variant<StandinHello, StandinClicks, StandinUpTo, StandinEnd, StandinShown, StandinTook>;

void append(std::vector<std::uint8_t>& bytes, const StandinMessage& message);

/// The next message with the bytes it took; nothing while bytes are missing; an Error for what is
/// none.
struct ReadStandinMessage {
  StandinMessage message;
  std::size_t bytes = 0;
};
Result<std::optional<ReadStandinMessage>> read_standin_message(Bytes bytes);

inline constexpr std::size_t kMaxStandinBytes = std::size_t{1} << 20;

}  // namespace orthonav::hl2ss

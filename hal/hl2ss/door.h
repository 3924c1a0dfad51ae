#pragma once

#include <string_view>

#include "hal/hl2ss/options.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// hl2ss has no place for a token. Our own server can ask for one at a further port, its door: who
/// sends the token and a newline there is answered `kWelcome` and may then use the other ports. A
/// headset has no such port.
inline constexpr int kDoorOffset = 20;
inline constexpr std::string_view kWelcome = "welcome\n";

/// Brings the token of `options.token_file` to the door; nothing to do without one. Blocks until
/// `deadline` at most.
Status open_door(const net::Endpoint& host, const Hl2ssOptions& options, HostTime deadline);

}  // namespace orthonav::hl2ss

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::net {

inline constexpr int kMaxPort = 65535;

/// Where to connect to or to listen, as it is written in a URI or on the command line.
struct HostPort {
  std::string host;  ///< a name or an address; of version 6 without its brackets
  std::optional<int> port;
};

/// From `HOST`, `HOST:PORT`, `[ADDRESS]` or `[ADDRESS]:PORT`, where the brackets hold an address of
/// version 6. An Error names what is neither a name nor an address, and a port below `least_port`.
Result<HostPort> host_and_port(std::string_view text, int least_port = 1);

/// A whole number from `least` to `most`; `what` begins an Error.
Result<int> port_from(std::string_view what, std::string_view text, int least = 1,
                      int most = kMaxPort);

/// The host as it is written in front of a port.
[[nodiscard]] std::string before_port(const std::string& host);

}  // namespace orthonav::net

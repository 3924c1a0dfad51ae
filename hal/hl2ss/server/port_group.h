#pragma once

#include <poll.h>

#include <functional>
#include <utility>
#include <vector>

#include "hal/hl2ss/server/port.h"

namespace orthonav::hl2ss {

/// The ports of a server, at fixed distances from the first. Runs on the network thread.
class PortGroup {
 public:
  struct Member {
    Port* port = nullptr;
    int offset = 0;
    std::function<bool()> is_free = [] { return true; };  ///< a client may come
  };
  explicit PortGroup(std::vector<Member> members) : members_(std::move(members)) {}

  /// From `first` on; 0: from the first free range. Returns where it begins.
  Result<int> listen(const net::Endpoint& host, int first, const net::Allowed& allowed);
  /// Waits 5 ms at most, and does what is due.
  void turn();

 private:
  Status listen_from(const net::Endpoint& host, int first, const net::Allowed& allowed);

  std::vector<Member> members_;
  std::vector<pollfd> watched_;
};

}  // namespace orthonav::hl2ss

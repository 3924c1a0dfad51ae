#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/server.h"
#include "hal/sim/sim_headset.h"
#include "tests/support/bare_room.h"
#include "tests/support/wait_until.h"

namespace orthonav::test {

/// The server over a simulated room on free ports.
class ServedRoom {
 public:
  explicit ServedRoom(const sim::SimOptions& sim, hl2ss::ServerOptions options = {},
                      sim::RoomDescription room = bare_room());
  /// Opens a headset that is connected to it.
  [[nodiscard]] std::unique_ptr<hl2ss::Hl2ssHeadset> connect(
      hl2ss::VideoProfile profile = hl2ss::VideoProfile::kRaw) const;
  [[nodiscard]] hl2ss::Server& server() { return *server_; }
  [[nodiscard]] hl2ss::Hl2ssOptions client_options() const;

 private:
  std::unique_ptr<hl2ss::Server> server_;
};

/// A room without a surgeon, whose images are black.
inline sim::SimOptions black_session(double limit_s) {
  sim::SimOptions sim;
  sim.seed = 5;
  sim.render = false;
  sim.limit_s = limit_s;
  return sim;
}

/// Waits for its client.
inline hl2ss::ServerOptions paced() {
  hl2ss::ServerOptions options;
  options.paced = true;
  return options;
}

/// Asks until a pair or the end comes; kNone only after `kLongestWait`. Errors are counted and
/// passed over.
Next next_pair(Headset& headset, StereoFrame& frame, int* errors = nullptr);

}  // namespace orthonav::test

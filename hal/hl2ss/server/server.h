#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hal/api/devices.h"
#include "hal/hl2ss/options.h"
#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/server/faults.h"
#include "hal/hl2ss/server/scene_port.h"

namespace orthonav::hl2ss {

struct ServerOptions {
  std::string host = "127.0.0.1";  ///< the address to listen at
  /// Networks that may connect in addition to this machine, as in "192.168.1.0/24,10.0.0.7"; must
  /// be named unless the address is loopback.
  std::string allow;
  int first_port = kFirstPort;  ///< 0: the first free range from 20000 on
  /// A side channel for our own client at first_port + 19 (docs/hl2ss.md).
  bool standin = true;
  /// The next pair is sent when the client is done with the last one; needs the side channel.
  /// False: at the headset's own pace.
  bool paced = false;
  Faults faults;
  std::uint64_t seed = 1;  ///< of the faults
  int slices = 1;          ///< of each H.264 picture
  /// Width in pixels of the images' edges where the calibration has no directions: (0, 0).
  int unmapped_edge_px = 0;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// What a server has done so far.
struct ServerReport {
  std::int64_t sessions = 0;
  std::int64_t pairs = 0;   ///< taken from the served headset
  std::int64_t faults = 0;  ///< done on purpose, of any kind
  bool is_streaming = false;
  std::string last_trouble;
  /// Pose of the newest pair, in the client's World; absent while the head is not located.
  std::optional<Transform<World, Rig>> world_from_rig;
};

/// Serves any headset with the hl2ss protocol, so that developers and tests can do without a real
/// HoloLens 2. A session begins when both front cameras are requested (and, if paced, our own
/// client is connected): then a headset is opened, and it is closed when its stream ends.
class Server {
 public:
  using OpenHeadset = std::function<Result<std::unique_ptr<Headset>>()>;
  /// An Error names the port that is taken. `open` is called once at the start, for the
  /// calibration, and for each session after the first.
  static Result<std::unique_ptr<Server>> start(const ServerOptions& options, OpenHeadset open);
  virtual ~Server() = default;
  [[nodiscard]] virtual int first_port() const = 0;
  [[nodiscard]] virtual int standin_port() const = 0;
  /// Options for a client on this machine.
  [[nodiscard]] virtual Hl2ssOptions client_options() const = 0;
  [[nodiscard]] virtual ServerReport report() const = 0;
  /// The headset's own scene, with faults on request.
  [[nodiscard]] virtual ScenePort& scene() = 0;
};

inline constexpr int kStandinOffset = 19;

}  // namespace orthonav::hl2ss

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hal/api/devices.h"
#include "hal/sim/sim_headset.h"

namespace orthonav {

struct OpenOptions {
  sim::RoomDescription room;  ///< for `sim:`; empty: a table and a pointer
  sim::SimOptions sim;
};

/// What was opened.
struct OpenedHeadset {
  std::unique_ptr<Headset> headset;
  /// The room that its cameras see, if it is simulated; null otherwise. Lives as long as the
  /// headset. Gives access to the truth, which no headset reveals.
  sim::SimHeadset* room = nullptr;
  /// In one line, what was amiss and did not keep it from opening; empty: nothing.
  std::string warning;
};

/// Opens a headset by URI: `sim:` (the simulated operating room;
/// `sim:?seed=3&perfect&realtime&depth`), `replay:PATH` (a recording; `replay:PATH?pace=fast`,
/// `realtime` or `step`; `?stamps=exact`), `hl2ss://HOST` (a HoloLens 2 over the network;
/// `hl2ss://HOST?profile=h264`, docs/hl2ss.md), `openxr:+URI` (an OpenXR headset that takes the
/// cameras of another one). An unknown scheme or key is refused with the known ones named.
Result<std::unique_ptr<Headset>> open_headset(const std::string& uri,
                                              const OpenOptions& options = {});

/// Refuses what can't be opened by its text alone (scheme, keys, values), at once and without
/// looking at any device; what follows `openxr:` is only read when it is opened.
Status check_headset_uri(const std::string& uri);

/// A device that lives outside of this library, opened by URIs of its own scheme.
struct HeadsetScheme {
  std::string name;   ///< "mine" of "mine:REST": lower-case letters and digits
  std::string usage;  ///< as refusals name it: "mine:SERIAL"
  /// Refuses what can't be opened by its text alone, given what follows the colon. Null: nothing
  /// is.
  std::function<Status(const std::string& rest)> check;
  std::function<Result<std::unique_ptr<Headset>>(const std::string& rest)> open;
};

/// Everything above knows the scheme from now on. Refuses a name that is taken or malformed, and
/// one without `open`. Thread-safe.
Status register_scheme(HeadsetScheme scheme);

/// The same as `open_headset`, with the simulated room beside it.
Result<OpenedHeadset> open_with_room(const std::string& uri, const OpenOptions& options = {});

}  // namespace orthonav

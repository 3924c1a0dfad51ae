#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "hal/api/depth_camera.h"
#include "hal/api/research_mode.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// The depth stream to request: raw, AHaT as H.264, or long throw as PNG.
struct DepthWish {
  DepthStream stream = DepthStream::kAhat;  ///< kAhat or kLongThrow
  DepthCoding coding = DepthCoding::kRaw;
};

struct Hl2ssOptions {
  std::string host;
  VideoProfile profile = VideoProfile::kRaw;
  int first_port = kFirstPort;
  int standin_port = 0;  ///< of our own server's side channel; 0: none
  std::uint32_t bitrate = 12'000'000;
  /// What its speech recognition listens for; none: it is not asked to listen.
  std::vector<std::string> phrases;
  /// The server is asked to stamp, and to take poses, earlier by this; zero for a server with
  /// correct stamps.
  Duration stamps_late = kResearchModeStampsLate;
  bool scene = true;  ///< holograms are shown in the headset's own scene
  /// Research mode runs AHaT or long throw, not both; absent: neither is requested.
  std::optional<DepthWish> depth;
  /// The longest wait for calibrations and the first image when opening.
  Duration open_within = std::chrono::seconds(8);
  /// The longest part of `open_within` spent waiting for the depth camera's calibration (4 MB, a
  /// fifth of a second at the images' data rate); after that, the headset opens without depth.
  Duration depth_within = std::chrono::seconds(2);
};

/// What follows `hl2ss:` in a URI:
/// `//HOST[:PORT][?profile=raw|h264&stamps=late|exact&scene=on|off&depth=ahat|ahat-h264|`
/// `long-throw|long-throw-png&port=BASE&standin=PORT]`; PORT is BASE. An Error says what
/// is wrong and names the known keys.
Result<Hl2ssOptions> options_of(std::string_view after_scheme);

}  // namespace orthonav::hl2ss

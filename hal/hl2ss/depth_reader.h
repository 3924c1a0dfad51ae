#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hal/hl2ss/depth_calibration.h"
#include "hal/hl2ss/depth_format.h"
#include "hal/hl2ss/depth_mailbox.h"
#include "hal/hl2ss/packet_stream.h"
#include "hal/hl2ss/png_decoder.h"
#include "hal/hl2ss/units_underway.h"
#include "hal/hl2ss/video_decoder.h"

namespace orthonav::hl2ss {

/// Converts stamps to times with the clock that the other streams established. Depth stamps never
/// change that clock: a depth stream must not affect an operation.
class StampTeller {
 public:
  virtual ~StampTeller() = default;
  /// An Error says why the stamp, in ticks of 100 ns, is implausible.
  [[nodiscard]] virtual Result<Timestamp> told(std::uint64_t ticks, HostTime at) const = 0;
};

/// A port that sends pictures of a depth camera, with poses.
class DepthReader final : public PacketPort {
 public:
  static Result<std::unique_ptr<DepthReader>> create(const DepthWish& wish, std::uint32_t bitrate,
                                                     const DepthDescription& camera,
                                                     const StampTeller& stamps, ArrivalMeter& meter,
                                                     DepthMailbox& pictures);
  [[nodiscard]] std::vector<std::uint8_t> opening() override;

 private:
  /// The data of an access unit that is still in the decoder.
  struct Underway {
    Timestamp time{};
    std::optional<Transform<World, Rig>> world_from_rig;
  };
  DepthReader(const DepthWish& wish, std::uint32_t bitrate, const DepthDescription& camera,
              const StampTeller& stamps, ArrivalMeter& meter, DepthMailbox& pictures);
  void heard(const Packet& packet, HostTime at) override;
  /// An Error says what was wrong with this packet; the stream continues.
  Status take(const Packet& packet, Timestamp time);
  Status take_picture(Bytes picture);
  Status take_raw(Bytes picture);
  Status take_png(Bytes picture);
  /// Whether a picture came out, in `picture_` with its own time and pose.
  Result<bool> take_video(Bytes picture);
  void publish();

  DepthWish wish_;
  DepthFormat format_;
  std::uint32_t bitrate_;
  std::vector<std::uint16_t> millimetres_;
  const StampTeller& stamps_;
  ArrivalMeter& meter_;
  DepthMailbox& pictures_;
  std::unique_ptr<VideoDecoder> video_;
  std::unique_ptr<PngDecoder> png_;

  DepthFrame picture_;
  GreyImage luma_;
  std::vector<std::uint8_t> bytes_;
  UnitsUnderway<Underway> underway_;
};

}  // namespace orthonav::hl2ss

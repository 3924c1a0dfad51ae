#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hal/hl2ss/depth_calibration.h"
#include "hal/hl2ss/depth_format.h"
#include "hal/hl2ss/depth_mailbox.h"
#include "hal/hl2ss/h264_decoder.h"
#include "hal/hl2ss/packet_port.h"
#include "hal/hl2ss/png_decoder.h"
#include "hal/hl2ss/units_underway.h"

namespace orthonav::hl2ss {

/// Converts stamps to times by the clock that the other streams established. Stamps of depth never
/// change that clock: nothing that a depth stream sends may change an operation.
class StampTeller {
 public:
  virtual ~StampTeller() = default;
  /// An Error says why the stamp, in ticks of 100 ns, can't be believed.
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
  /// What is known of an access unit that the decoder has not given back yet.
  struct Underway {
    Timestamp time{};
    std::optional<Transform<World, Rig>> world_from_rig;
  };
  DepthReader(const DepthWish& wish, std::uint32_t bitrate, const DepthDescription& camera,
              const StampTeller& stamps, ArrivalMeter& meter, DepthMailbox& pictures);
  void heard(const Packet& packet, HostTime at) override;
  /// An Error says what was wrong with this packet; the stream goes on.
  Status take(const Packet& packet, Timestamp time);
  Status take_picture(Bytes picture);
  Status take_raw(Bytes picture);
  Status take_png(Bytes picture);
  /// Whether a picture came out, in `picture_` with its own time and pose.
  Result<bool> take_h264(Bytes picture);
  void publish();

  DepthWish wish_;
  DepthFormat format_;
  std::uint32_t bitrate_;
  std::vector<std::uint16_t> millimetres_;
  const StampTeller& stamps_;
  ArrivalMeter& meter_;
  DepthMailbox& pictures_;
  std::unique_ptr<H264Decoder> h264_;
  std::unique_ptr<PngDecoder> png_;

  DepthFrame picture_;
  GreyImage luma_;
  std::vector<std::uint8_t> bytes_;
  UnitsUnderway<Underway> underway_;
  std::optional<Timestamp> published_;
};

}  // namespace orthonav::hl2ss

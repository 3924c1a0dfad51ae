#pragma once

#include <memory>

#include "hal/hl2ss/packet_stream.h"
#include "hal/hl2ss/pairer.h"
#include "hal/hl2ss/stamp_check.h"
#include "hal/hl2ss/units_underway.h"
#include "hal/hl2ss/video.h"
#include "hal/hl2ss/video_decoder.h"

namespace orthonav::hl2ss {

/// Receives the pictures of the front cameras.
class ImageSink {
 public:
  virtual ~ImageSink() = default;
  /// May swap the image's buffers for others.
  virtual void take(CameraSide side, CameraImage& image) = 0;
  virtual void lost(CameraSide side) = 0;
  /// From this camera's next picture on, its stamps are believed to have leapt by this.
  virtual void leapt(CameraSide side, Duration by) = 0;
};

/// One front camera with poses, raw or decoded.
class VideoStream final : public PacketStream {
 public:
  /// `decoder` is null for raw images.
  VideoStream(CameraSide side, const VideoRequest& request, std::unique_ptr<VideoDecoder> decoder,
              ArrivalMeter& meter, HeadsetTime& time, ImageSink& sink)
      : PacketStream(side == CameraSide::kLeft ? "left camera" : "right camera",
                     {kMaxImagePayload, true}, meter, time),
        side_(side),
        request_(request),
        decoder_(std::move(decoder)),
        sink_(sink) {}
  [[nodiscard]] std::vector<std::uint8_t> opening() override;
  void disconnected() override;

 private:
  /// The data of an access unit that is still in the decoder.
  struct Underway {
    std::uint64_t sensor_ticks = 0;
    Timestamp time{};
    std::optional<Transform<World, Rig>> world_from_rig;
    bool is_trusted = true;
  };
  Status check_stamp(const Packet& packet, Timestamp stamp) override;
  void left_out() override;
  Status take(const Packet& packet, const Stamped& stamped) override;
  Status take_raw(Bytes picture);
  Result<bool> take_h264(Bytes access_unit, std::int64_t unit);

  CameraSide side_;
  VideoRequest request_;
  std::unique_ptr<VideoDecoder> decoder_;
  ImageSink& sink_;
  StampCheck stamps_;
  CameraImage image_;
  GreyImage last_picture_;  ///< decoded before it
  UnitsUnderway<Underway> underway_;
};

}  // namespace orthonav::hl2ss

#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/mutex.h"
#include "base/random.h"
#include "hal/hl2ss/server/faults.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/server/video_encoder.h"
#include "hal/hl2ss/video.h"

namespace orthonav::hl2ss {

/// Options of one front camera's port.
struct CameraPortOptions {
  std::vector<std::uint8_t> calibration;  ///< the whole answer in mode 2
  Faults faults;
  Random random;
  int slices = 1;  ///< of an H.264 picture
};

/// A front camera's port: answers with the calibration, or streams the images it is given, with
/// faults as configured. It stamps late, as research mode does, and corrects that as its client
/// requests.
class CameraPort {
 public:
  explicit CameraPort(CameraPortOptions options)
      : calibration_(std::move(options.calibration)),
        faults_(options.faults),
        random_(options.random),
        slices_(options.slices) {}
  [[nodiscard]] Port& port() { return port_; }
  [[nodiscard]] bool is_streaming() const;

  struct Image {
    std::int64_t ticks = 0;          ///< when it was taken
    std::uint64_t sensor_ticks = 0;  ///< of 1 ns
    const GreyImage* picture = nullptr;
    /// Where the headset was this long after the image.
    std::function<std::optional<Transform<World, Rig>>(Duration)> world_from_rig_after;
    bool spoil = true;  ///< faults may be applied to it
  };
  /// Sends it to the client that asked for images, unless it has left meanwhile; returns whether it
  /// will arrive whole and rightly stamped.
  Result<bool> send(const Image& image);
  [[nodiscard]] std::int64_t faults_done() const { return faults_done_; }
  /// Exposure time sent with each image.
  static constexpr std::uint64_t kExposureNs = 4'000'000;

 private:
  Result<std::size_t> understand(Bytes said);
  Result<std::vector<std::uint8_t>> pictured(const VideoRequest& request, std::int64_t stream,
                                             const GreyImage& picture);
  bool strikes(double probability);
  enum class Fate { kUntouched, kLate, kBroken };
  Fate spoil(std::vector<std::uint8_t>& packet, std::vector<Chunk>& chunks);
  void corrupt(std::vector<std::uint8_t>& packet);

  std::vector<std::uint8_t> calibration_;
  Faults faults_;
  Random random_;
  int slices_;
  mutable Mutex mutex_;
  std::optional<VideoRequest> request_ ORTHONAV_GUARDED_BY(mutex_);
  std::int64_t stream_ ORTHONAV_GUARDED_BY(mutex_) = 0;  ///< counts the requests
  std::int64_t encoded_stream_ = -1;
  std::int64_t images_ = 0;
  std::unique_ptr<VideoEncoder> encoder_;
  std::int64_t faults_done_ = 0;
  Port port_{{[this](Bytes said) { return understand(said); }, [] {},
              [this] {
                const MutexLock lock(mutex_);
                request_.reset();
              }}};
};

}  // namespace orthonav::hl2ss

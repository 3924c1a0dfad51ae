#pragma once

#include <memory>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::engine {

struct VideoOptions {
  int width_px = 960;   ///< even
  int height_px = 540;  ///< even
  int frames_per_second = 30;
  int quality = 23;  ///< x264's constant rate factor, 0 (best) to 51
  int threads = 1;
};

/// H.264 in an MP4 that browsers play, by libavcodec. `finish` gives the file its name; until then
/// it lies in the same folder as STEM.part-PROCESS-N.mp4. That file stays and plays up to its end
/// where the disk is full (the Error names it) or the process is killed. A writer destroyed in any
/// other way leaves nothing behind.
class VideoWriter {
 public:
  static Result<std::unique_ptr<VideoWriter>> create(const std::string& path,
                                                     const VideoOptions& options);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  /// Appends one picture of the agreed size; its alpha is ignored.
  Status write(const RgbaImage& picture);
  /// Flushes the encoder, completes the file and gives it its name.
  Status finish();
  [[nodiscard]] std::int64_t frames() const;

 private:
  struct Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace orthonav::engine

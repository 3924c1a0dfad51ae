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

/// H.264 in an MP4 that browsers play, by libavcodec. It gets its name from `finish`; until then it
/// lies beside it, as STEM.part-PROCESS-N.mp4, and plays up to wherever it is cut: by a full disk,
/// of which the Error says where it lies, or by the end of the process. A writer that is merely
/// dropped leaves nothing behind.
class VideoWriter {
 public:
  static Result<std::unique_ptr<VideoWriter>> create(const std::string& path,
                                                     const VideoOptions& options);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  /// Appends one picture of the agreed size; its alpha is ignored.
  Status write(const RgbaImage& picture);
  /// Flushes the encoder, completes the file and puts it in place.
  Status finish();
  [[nodiscard]] std::int64_t frames() const;

 private:
  struct Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace orthonav::engine

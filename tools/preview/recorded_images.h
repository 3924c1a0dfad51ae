#pragma once

#include <filesystem>
#include <memory>

#include "base/image.h"
#include "base/result.h"
#include "base/vec.h"
#include "render/renderer.h"

namespace orthonav::preview {

/// The left camera's images of a recording, rectified: as seen by an eye at the camera's place with
/// the headset's axes. Each is read when it is asked for, in any order. One thread.
class RecordedImages {
 public:
  static Result<RecordedImages> open(const std::filesystem::path& folder);
  RecordedImages(RecordedImages&& other) noexcept;
  RecordedImages& operator=(RecordedImages&& other) noexcept;
  ~RecordedImages();

  /// How many pairs there are.
  [[nodiscard]] std::int64_t pairs() const;
  /// Where the left camera is in the headset.
  [[nodiscard]] Vec3 eye_in_rig() const;
  /// Draws the image with this sequence number into the picture; where the camera sees nothing, or
  /// when the image cannot be read, the picture stays as it is.
  void draw(std::int64_t sequence, const render::View& view, RgbaImage& picture);

 private:
  struct Source;
  explicit RecordedImages(std::unique_ptr<Source> source);

  std::unique_ptr<Source> source_;
  std::int64_t read_ = -1;  ///< sequence number of `image_`
  GreyImage image_;
};

}  // namespace orthonav::preview

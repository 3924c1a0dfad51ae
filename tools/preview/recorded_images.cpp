#include "tools/preview/recorded_images.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/replay/recording.h"
#include "nav/tracking/bilinear.h"

namespace orthonav::preview {
struct RecordedImages::Source {
  replay::Recording recording;
};

Result<RecordedImages> RecordedImages::open(const std::filesystem::path& folder) {
  auto recording = replay::read_recording(folder);
  if (!recording) {
    return recording.error();
  }
  return RecordedImages(std::make_unique<Source>(Source{std::move(*recording)}));
}

RecordedImages::RecordedImages(std::unique_ptr<Source> source) : source_(std::move(source)) {}
RecordedImages::RecordedImages(RecordedImages&& other) noexcept = default;
RecordedImages& RecordedImages::operator=(RecordedImages&& other) noexcept = default;
RecordedImages::~RecordedImages() = default;

std::int64_t RecordedImages::pairs() const {
  return static_cast<std::int64_t>(source_->recording.pairs.size());
}

Vec3 RecordedImages::eye_in_rig() const {
  return source_->recording.calibration.left_from_rig.inverse().translation();
}

void RecordedImages::make_map(const render::View& view, const RgbaImage& picture) {
  const StereoCalibration& cameras = source_->recording.calibration;
  const Mat3& camera_from_eye = cameras.left_from_rig.rotation();
  map_tan_ = view.tan_left;
  map_.resize(picture.pixels.size() / 4);
  const double across = static_cast<double>(view.tan_left + view.tan_right);
  const double down = static_cast<double>(view.tan_up + view.tan_down);
  std::size_t pixel = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const Vec3 ray{across * (x + 0.5) / picture.width_px - static_cast<double>(view.tan_left),
                     static_cast<double>(view.tan_up) - down * (y + 0.5) / picture.height_px, -1.0};
      map_[pixel++] = cameras.left.project(camera_from_eye * ray).value_or(Vec2{-1.0, -1.0});
    }
  }
}

void RecordedImages::draw(std::int64_t sequence, const render::View& view, RgbaImage& picture) {
  auto& pairs = source_->recording.pairs;
  const auto found =
      std::lower_bound(pairs.begin(), pairs.end(), sequence,
                       [](const auto& pair, std::int64_t s) { return pair.sequence < s; });
  if (found == pairs.end() || found->sequence != sequence) {
    return;
  }
  if (read_ != sequence) {
    read_ = -1;
    if (!source_->recording.left.read(found->left, image_)) {
      return;
    }
    read_ = sequence;
  }
  if (map_.size() * 4 != picture.pixels.size() || map_tan_ != view.tan_left) {
    make_map(view, picture);
  }
  for (std::size_t i = 0; i < map_.size(); ++i) {
    if (map_[i].x < 0.0) {
      continue;
    }
    const std::uint8_t grey = static_cast<std::uint8_t>(nav::grey_at(image_, map_[i]) + 0.5);
    std::fill_n(picture.pixels.begin() + static_cast<long>(4 * i), 3, grey);
  }
}

}  // namespace orthonav::preview

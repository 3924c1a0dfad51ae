#include "tools/preview/recorded_images.h"

#include <algorithm>
#include <utility>

#include "engine/live/rectified_camera.h"
#include "hal/replay/recording.h"

namespace orthonav::preview {
struct RecordedImages::Source {
  replay::Recording recording;
  engine::RectifiedCamera camera;
};

Result<RecordedImages> RecordedImages::open(const std::filesystem::path& folder) {
  auto recording = replay::read_recording(folder);
  if (!recording) {
    return recording.error();
  }
  const engine::RectifiedCamera camera(recording->calibration);
  return RecordedImages(std::make_unique<Source>(Source{std::move(*recording), camera}));
}

RecordedImages::RecordedImages(std::unique_ptr<Source> source) : source_(std::move(source)) {}
RecordedImages::RecordedImages(RecordedImages&& other) noexcept = default;
RecordedImages& RecordedImages::operator=(RecordedImages&& other) noexcept = default;
RecordedImages::~RecordedImages() = default;

std::int64_t RecordedImages::pairs() const {
  return static_cast<std::int64_t>(source_->recording.pairs.size());
}

Vec3 RecordedImages::eye_in_rig() const { return source_->camera.rig_from_eye().translation(); }

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
  source_->camera.draw(image_, view, picture);
}

}  // namespace orthonav::preview

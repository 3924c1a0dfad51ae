#include "tools/orthonav/operation/step_pictures.h"

#include "base/printed.h"
#include "engine/io/image_file.h"

namespace orthonav::tools {
Status StepPictures::picture(const RgbaImage& image, const engine::Snapshot& snapshot) {
  if (snapshot.blank) {
    return {};
  }
  if (held_step_ != snapshot.step) {
    if (const Status finished = finish(); !finished) {
      return finished;
    }
    held_step_ = snapshot.step;
    held_shows_site_ = false;
    held_tip_to_entry_m_.reset();
  }
  const bool shows_site = !snapshot.scene.lines.empty() || !snapshot.scene.meshes.empty();
  const std::optional<double> tip_to_entry_m = snapshot.tip_to_entry_m;
  if ((held_shows_site_ && !shows_site) ||
      (held_tip_to_entry_m_ && !(tip_to_entry_m && *tip_to_entry_m < *held_tip_to_entry_m_))) {
    return {};
  }
  held_shows_site_ = shows_site;
  held_tip_to_entry_m_ = tip_to_entry_m;
  held_ = image;
  return {};
}

Status StepPictures::finish() {
  if (!held_step_) {
    return failure_;
  }
  const engine::StepOnDisplay at = *held_step_;
  std::string name = engine::name_of(at);
  for (char& c : name) {
    if (c == ' ' || c == '/') {
      c = '-';
    }
  }
  const auto path = folder_ / (printed("%02zu-", written_.size() + 1) + name + ".png");
  held_step_.reset();
  if (Status saved = engine::write_png(path, held_); !saved) {
    failure_ = saved;
    return saved;
  }
  written_.push_back({at, path});
  return failure_;
}

Status VideoPictures::picture(const RgbaImage& image, const engine::Snapshot& /*snapshot*/) {
  frame_.width_px = image.width_px;
  frame_.height_px = image.height_px;
  frame_.pixels = image.pixels;
  return writer_.write(frame_);
}

}  // namespace orthonav::tools

#include <filesystem>
#include <utility>

#include "engine/io/folders.h"
#include "tools/preview/preview_app.h"
#include "tools/preview/screenshot.h"

namespace orthonav::preview {

namespace fs = std::filesystem;

Status PreviewApp::make_out() {
  const auto made = engine::make_folders(options_.out);
  return made ? Status{} : Error{"--out " + made.error().message, made.error().code};
}

std::string PreviewApp::next_name(const std::string& ending) const {
  return numbered_name(options_.out, "preview", ending);
}

Status PreviewApp::take_screenshot(const std::string& name) {
  const fs::path path = png_path(options_.out, name);
  const Status taken = write_screenshot(*window_, path);
  facts_.note = taken ? "wrote " + path.string() : taken.error().message;
  // A script that gets no picture has failed; a person reads the reason.
  return script_ ? taken : Status{};
}

Status PreviewApp::toggle_video() {
  if (video_) {
    return stop_video();
  }
  if (const Status made = make_out(); !made) {
    return made;
  }
  video_name_ = (fs::path(options_.out) / next_name(".mp4")).string();
  engine::VideoOptions video_options;
  video_options.width_px = options_.stage.width_px;
  video_options.height_px = options_.stage.height_px;
  auto video = engine::VideoWriter::create(video_name_, video_options);
  if (!video) {
    return video.error();
  }
  video_ = std::move(*video);
  facts_.video = true;
  drawn_.reset();
  facts_.note = "records " + video_name_;
  return {};
}

Status PreviewApp::stop_video() {
  if (!video_) {
    return {};
  }
  const auto video = std::exchange(video_, nullptr);
  facts_.video = false;
  if (const Status finished = video->finish(); !finished) {
    return finished;
  }
  facts_.note = "wrote " + video_name_;
  return {};
}

}  // namespace orthonav::preview

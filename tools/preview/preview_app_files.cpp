#include <cstdio>
#include <filesystem>
#include <utility>

#include "engine/io/folders.h"
#include "engine/io/image_file.h"
#include "tools/preview/preview_app.h"

namespace orthonav::preview {

namespace fs = std::filesystem;

Status PreviewApp::make_out() {
  const auto made = engine::make_folders(options_.out);
  return made ? Status{} : Error{"--out " + made.error().message, made.error().code};
}

std::string PreviewApp::next_name(const std::string& ending) {
  for (int number = 1;; ++number) {
    char name[32];
    std::snprintf(name, sizeof name, "preview-%03d", number);
    std::error_code code;
    if (!fs::exists(fs::path(options_.out) / (name + ending), code)) {
      return name + ending;
    }
  }
}

Status PreviewApp::take_screenshot(const std::string& name) {
  const RgbaImage image = window_->screenshot();
  const fs::path path = fs::path(options_.out) / name;
  Status taken = image.pixels.empty()
                     ? Status(Error{"screenshot: nothing of the window can be seen"})
                     : make_out();
  if (taken) {
    taken = engine::write_png(path, image);
  }
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

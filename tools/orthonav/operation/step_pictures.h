#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/video_writer.h"
#include "tools/orthonav/operation/surgeon_view.h"

namespace orthonav::tools {

/// The surgeon's view at one step, as a file.
struct StepPicture {
  engine::StepOnDisplay at;
  std::filesystem::path path;
};

/// Keeps one picture of every step: the last one that shows more than the status line; for guiding,
/// the one with the tip nearest to the entry.
class StepPictures : public PictureSink {
 public:
  explicit StepPictures(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Status picture(const RgbaImage& image, const engine::Snapshot& snapshot) override;
  /// Writes the last picture.
  Status finish();
  [[nodiscard]] const std::vector<StepPicture>& written() const { return written_; }

 private:
  std::filesystem::path folder_;
  std::vector<StepPicture> written_;
  RgbaImage held_;
  std::optional<engine::StepOnDisplay> held_step_;
  bool held_shows_site_ = false;  ///< more than the status line
  std::optional<double> held_tip_to_entry_m_;
  Status failure_;  ///< the first picture that could not be written
};

/// Writes every picture into the video.
class VideoPictures : public PictureSink {
 public:
  explicit VideoPictures(engine::VideoWriter& writer) : writer_(writer) {}
  Status picture(const RgbaImage& image, const engine::Snapshot& snapshot) override;

 private:
  engine::VideoWriter& writer_;
  RgbaImage frame_;
};

}  // namespace orthonav::tools

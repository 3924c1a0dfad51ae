#pragma once

#include <string>
#include <vector>

#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {

/// The arguments of `calibrate stereo`: images of a chessboard, or a recording of a board of tags.
struct StereoArguments {
  std::string chessboard;
  double square_mm = 25.0;
  std::vector<std::string> left;
  std::vector<std::string> right;
  std::string recording;
  std::string board;
  JsonOutput json;
};

int run_stereo_images(const StereoArguments& arguments);
int run_stereo_recording(const StereoArguments& arguments);

}  // namespace orthonav::tools

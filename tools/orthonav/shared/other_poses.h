#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/orthonav/shared/recorded_pairs.h"

namespace orthonav::tools {

/// Options for poses by another tracker, from a file or over OpenIGTLink, in the place of a
/// recording of ours.
struct OtherPosesArguments {
  std::string pose;
  std::string units;
  std::string columns;
  double rate_hz = 0.0;  ///< 0: not given
  double seconds = 60.0;

  void add_to(CLI::App& command);
};

inline constexpr const char* kOtherPosesFooter =
    "\nRECORDING may be a file of poses: a sequence of Plus or 3D Slicer (.igs.mha, .seq.nrrd), "
    "NDI's CSV,\n"
    "the CSV of `orthonav track`, another table of positions with quaternions, or matrices; or\n"
    "igtl://HOST?TOOL=TRANSFORM: poses that another program now sends over OpenIGTLink.";

/// Whether RECORDING is no folder, as ours are, but a file of poses or an OpenIGTLink server.
[[nodiscard]] bool has_other_poses(const std::string& recording);

/// The tool's poses by the other tracker.
Result<MeasuredPoses> other_poses(const std::string& recording,
                                  const OtherPosesArguments& arguments,
                                  const nav::ToolGeometry& tool);

}  // namespace orthonav::tools

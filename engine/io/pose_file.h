#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"

namespace orthonav::engine {

/// What a file of poses may leave open. None of it may contradict the file.
struct PoseFileOptions {
  /// Which poses, where a file has several: a transform ("StylusToReference"), a port, an id.
  std::string pose;
  int tag = -1;  ///< the id that is meant if `pose` is empty and the file has ids; -1: none
  std::optional<double> metres_per_unit;
  std::vector<std::string> columns;  ///< the names of columns without a heading
  std::optional<double> rate_hz;     ///< the rows' rate, where they have no times
};

/// The poses of one tool as a tracker recorded them.
struct PoseFile {
  std::string format;  ///< "NDI CSV"
  std::string pose;    ///< which of the file; empty: the only one
  /// World: the frame that the tracker measures in.
  std::vector<Transform<World, Marker>> world_from_marker;
  std::vector<double> times_s;  ///< of each pose; empty: neither file nor options state them
  std::size_t missing = 0;      ///< rows in which the tool was not seen
};

/// Reads, as their content shows:
/// - sequences of Plus and 3D Slicer (`.igs.mha`, `.seq.nrrd`, mm): transforms AToB take A to B;
///   AToB may also follow from AToC and BToC;
/// - NDI's CSV (mm), that of `orthonav track` (metres), and others whose heading names position
///   (x y z, px py pz or tx ty tz) and unit quaternion (qx qy qz and qw or q0), or a matrix (m00 to
///   m23); units stand behind a name (tx_mm, m03_m, time_s), or are given;
/// - the same without a heading, whose columns are given; rows of 16 numbers, and 4 rows of 4, are
///   matrices. Numbers may have decimal commas where semicolons or tabs separate them; UTF-8 with a
///   mark and UTF-16 are read.
/// Times in other columns than time_s, time_ms and timestamp_100ns are not read. Refuses anything
/// else in one line.
[[nodiscard]] Result<PoseFile> load_poses(const std::string& path,
                                          const PoseFileOptions& options = {});

}  // namespace orthonav::engine

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/orthonav/depth/depth_cloud.h"
#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {

inline constexpr int kMaxRangeMm = 65535;

/// The arguments of `depth`.
struct DepthArguments {
  std::string source;  ///< a recording's folder, or a headset's URI
  std::string stream;
  std::string out;
  std::optional<std::int64_t> frame;
  std::optional<std::int64_t> frames;
  bool all = false;
  std::optional<double> cell_mm;
  int max_mm = kMaxRangeMm;
  JsonOutput json;

  [[nodiscard]] bool wants_picture() const { return out.ends_with(".png"); }
  /// Side of the cubes, each of which keeps one point.
  [[nodiscard]] double cell_or_default_mm() const;
};

/// Writes one frame as a picture, or a cloud, and reports it; returns the command's exit code.
int write_picture(const DepthArguments& arguments, DepthStream stream, std::int64_t index,
                  const DepthImage& range_mm);
int write_cloud(const DepthArguments& arguments, DepthStream stream,
                const engine::PointCloud& cloud, const CloudReport& report);

}  // namespace orthonav::tools

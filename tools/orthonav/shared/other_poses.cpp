#include "tools/orthonav/shared/other_poses.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>

#include "base/stopwatch.h"
#include "engine/io/pose_file.h"
#include "engine/io/text_fields.h"
#include "hal/open/open.h"
#include "nav/tracking/tools_measured_elsewhere.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

engine::PoseFileOptions options_of(const OtherPosesArguments& arguments) {
  engine::PoseFileOptions options;
  options.pose = arguments.pose;
  if (!arguments.columns.empty()) {
    options.columns = engine::split(arguments.columns, ',');
  }
  if (!arguments.units.empty()) {
    options.metres_per_unit = arguments.units == "m" ? 1.0 : 1e-3;
  }
  if (arguments.rate_hz > 0.0) {
    options.rate_hz = arguments.rate_hz;
  }
  return options;
}

bool is_live(const std::string& recording) { return recording.starts_with("igtl:"); }

Result<MeasuredPoses> filed_poses(const std::string& path, const engine::PoseFileOptions& options) {
  const auto file = engine::load_poses(path, options);
  if (!file) {
    return file.error();
  }
  MeasuredPoses out;
  out.format = file->format;
  out.timed = !file->times_s.empty();
  out.pairs = static_cast<std::int64_t>(file->world_from_marker.size() + file->missing);
  for (std::size_t i = 0; i < file->world_from_marker.size(); ++i) {
    nav::TrackedPose pose;
    pose.value = file->world_from_marker[i];
    pose.status = PoseStatus::kMeasured;
    if (out.timed) {
      pose.time = Timestamp(from_seconds(file->times_s[i] - file->times_s.front()));
    }
    out.world_from_marker.push_back(pose);
  }
  return out;
}

Result<MeasuredPoses> live_poses(const std::string& uri, const nav::ToolGeometry& tool,
                                 double length_s) {
  if (tool.name.empty()) {
    return Error{"--tools is required"};
  }
  constexpr auto kPause = std::chrono::milliseconds(1);
  const auto headset = open_headset(uri);
  if (!headset) {
    return headset.error();
  }
  ToolPoseSource* const source = (*headset)->tool_poses();
  if (source == nullptr) {
    return Error{uri + ": measures no tools itself"};
  }
  const auto tracker = nav::create_tracker_of_poses(source->names(), {tool});
  if (!tracker) {
    return tracker.error();
  }
  std::fprintf(stderr, "orthonav: listening for %.0f s\n", length_s);
  const Stopwatch watch;
  MeasuredPoses out;
  out.format = "OpenIGTLink";
  ToolPoses poses;
  std::optional<std::int64_t> map;
  while (watch.elapsed() < from_seconds(length_s)) {
    const auto next = source->next(poses);
    if (!next) {
      return next.error();
    }
    if (*next == Next::kEnd) {
      break;
    }
    if (*next == Next::kNone) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (poses.map_epoch != map.value_or(poses.map_epoch)) {
      return Error{uri + ": the connection was lost, and the tracker may have moved since: repeat"};
    }
    map = poses.map_epoch;
    ++out.pairs;
    add_measured((*tracker)->take(poses), out);
  }
  return out;
}

}  // namespace

void OtherPosesArguments::add_to(CLI::App& command) {
  constexpr const char* kGroup = "Poses by another tracker";
  command
      .add_option("--pose", pose,
                  "Which, where a file has several: a transform, a port, an id (default: the only "
                  "one, or the tool's tag)")
      ->check(some_text())
      ->type_name("NAME")
      ->group(kGroup);
  command.add_option("--units", units, "Of positions in a file that does not state it")
      ->check(CLI::IsMember({"mm", "m"}))
      ->group(kGroup);
  command
      .add_option("--columns", columns,
                  "Names of columns without a heading: x,y,z,qx,qy,qz,qw, m00 to m23, time_s; any "
                  "other is passed over")
      ->check(some_text())
      ->type_name("NAMES")
      ->group(kGroup);
  command.add_option("--rate-hz", rate_hz, "Rows a second in a file without times")
      ->check(finite_number(0.1, 10000))
      ->group(kGroup);
  command.add_option("--seconds", seconds, "How long to listen to igtl://")
      ->check(finite_number(1, 3600))
      ->capture_default_str()
      ->group(kGroup);
}

bool has_other_poses(const std::string& recording) {
  std::error_code problem;
  return is_live(recording) || !std::filesystem::is_directory(recording, problem);
}

Result<MeasuredPoses> other_poses(const std::string& recording,
                                  const OtherPosesArguments& arguments,
                                  const nav::ToolGeometry& tool) {
  if (is_live(recording)) {
    return live_poses(recording, tool, arguments.seconds);
  }
  engine::PoseFileOptions options = options_of(arguments);
  options.tag = tool.has_tag() ? tool.marker.id : -1;
  return filed_poses(recording, options);
}

}  // namespace orthonav::tools

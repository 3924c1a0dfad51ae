#include "tools/orthonav/depth/depth_live.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "base/how_many.h"
#include "base/printed.h"
#include "base/stopwatch.h"
#include "hal/open/open.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/depth_listing.h"

namespace orthonav::tools {
namespace {

constexpr std::int64_t kDefaultFrames = 30;
/// Long throw may send only one frame a second.
constexpr auto kNoFrameFor = std::chrono::seconds(10);
constexpr auto kPause = std::chrono::milliseconds(2);

/// The URI, with a depth stream asked for.
std::string asking_for_depth(const DepthArguments& arguments) {
  const std::string& uri = arguments.source;
  const std::string joint = uri.find('?') == std::string::npos ? "?" : "&";
  if (uri.starts_with("hl2ss:") && uri.find("depth=") == std::string::npos) {
    return uri + joint + "depth=" + (arguments.stream.empty() ? "ahat" : arguments.stream);
  }
  const bool is_simulated = uri.starts_with("sim:") && uri.find("depth") == std::string::npos;
  return is_simulated ? uri + joint + "depth" : uri;
}

Result<DepthCamera*> chosen_camera(const DepthArguments& arguments, const OpenedHeadset& opened) {
  const auto cameras = opened.headset->depth_cameras();
  if (cameras.empty()) {
    return Error{arguments.source + ": " +
                 (opened.warning.empty() ? "has no depth camera" : opened.warning)};
  }
  std::string names;
  for (DepthCamera* camera : cameras) {
    const std::string name = name_of(camera->calibration().stream);
    if (arguments.stream == name || (arguments.stream.empty() && cameras.size() == 1)) {
      return camera;
    }
    names += (names.empty() ? "" : " and ") + name;
  }
  if (arguments.stream.empty()) {
    return Error{"--stream: must be named, the headset has " + names};
  }
  return Error{"--stream: the headset has no " + arguments.stream + ", it has " + names};
}

/// The state of the depth stream according to the headset's connection.
std::string trouble_of(const Headset& headset) {
  const auto connection = headset.connection();
  if (!connection) {
    return "";
  }
  for (const StreamStatistics& stream : connection->streams) {
    if (stream.name.starts_with("depth") && !stream.last_trouble.empty()) {
      return "; " + stream.last_trouble;
    }
  }
  return "";
}

/// Reads a headset's frames and keeps those asked for.
class LiveDepth {
 public:
  LiveDepth(const DepthArguments& arguments, Headset& headset, DepthCamera& camera)
      : arguments_(arguments),
        headset_(headset),
        camera_(camera),
        cloud_(1e-3 * arguments.cell_or_default_mm()) {}

  /// Until there are enough frames or the headset ends; an Error if none arrives for too long.
  Status take_frames() {
    const std::int64_t enough = frames_wanted();
    Stopwatch since_last;
    while (taken_ < enough && !(found_ && !arguments_.all)) {
      const auto next = camera_.next(frame_);
      if (next && *next == Next::kEnd) {
        break;
      }
      if (next && *next == Next::kFrame) {
        since_last = Stopwatch();
        take();
        continue;
      }
      // Taking the pairs advances the clock of a headset that waits for its client, and gives the
      // map's epoch.
      StereoCamera* const cameras = headset_.cameras();
      const auto pair = cameras != nullptr ? cameras->next(pair_) : Result<Next>(Next::kNone);
      if (since_last.elapsed() > kNoFrameFor) {
        return Error{arguments_.source + ": no frame of " + name_of(camera_.calibration().stream) +
                     " within 10 s" + trouble_of(headset_)};
      }
      if (!pair || *pair != Next::kFrame) {
        std::this_thread::sleep_for(kPause);
      }
    }
    return {};
  }
  int write() {
    const DepthStream stream = camera_.calibration().stream;
    if (arguments_.out.empty()) {
      return write_listing();
    }
    if (taken_ <= arguments_.frame.value_or(0)) {
      return bad_input("--frame: is " + std::to_string(arguments_.frame.value_or(0)) +
                       ", but only " + how_many(taken_, "frame") + " came");
    }
    return arguments_.wants_picture()
               ? write_picture(arguments_, stream, taken_ - 1, frame_.range_mm)
               : write_cloud(arguments_, stream, cloud_, report_);
  }

 private:
  [[nodiscard]] std::int64_t frames_wanted() const {
    if (arguments_.frames || arguments_.all || arguments_.out.empty()) {
      return arguments_.frames.value_or(kDefaultFrames);
    }
    // A cloud needs a pose, which the first frames may lack.
    return arguments_.frame ? *arguments_.frame + 1 : kDefaultFrames;
  }
  void take() {
    const std::int64_t index = taken_++;
    const std::int64_t ticks = headset_.file_ticks_100ns(frame_.time);
    summary_.first_ticks_100ns = index == 0 ? ticks : summary_.first_ticks_100ns;
    summary_.last_ticks_100ns = ticks;
    summary_.frames_without_pose += frame_.world_from_rig ? 0 : 1;
    if (arguments_.out.empty()) {
      return;
    }
    const bool is_asked_for = !arguments_.frame || index == *arguments_.frame;
    if (arguments_.wants_picture()) {
      found_ = is_asked_for;
    } else if (is_asked_for) {
      add_to_cloud();
    }
  }
  void add_to_cloud() {
    if (!frame_.world_from_rig) {
      ++report_.frames_without_pose;
      return;
    }
    if (map_ != frame_.map_epoch) {
      // Positions in one map mean nothing in another.
      report_.frames_in_other_maps += std::exchange(report_.frames_used, 0);
      cloud_ = engine::PointCloud(1e-3 * arguments_.cell_or_default_mm());
      map_ = frame_.map_epoch;
    }
    add_points(camera_.calibration(), frame_, static_cast<std::uint16_t>(arguments_.max_mm),
               cloud_);
    ++report_.frames_used;
    found_ = true;
  }
  int write_listing() {
    summary_.stream = camera_.calibration().stream;
    summary_.width_px = camera_.calibration().width_px;
    summary_.height_px = camera_.calibration().height_px;
    summary_.frames = taken_;
    nlohmann::ordered_json out = {{"streams", nlohmann::ordered_json::array()}};
    out["streams"].push_back(as_json(summary_));
    const double wraps_at_m = camera_.calibration().wraps_at_m;
    if (wraps_at_m > 0.0) {
      out["streams"][0]["wraps_at_m"] = wraps_at_m;
    }
    if (!arguments_.json.on_stdout()) {
      std::printf("%s: %s%s\n", name_of(summary_.stream), in_words(summary_).c_str(),
                  wraps_at_m > 0.0 ? printed(", wraps at %.3f m", wraps_at_m).c_str() : "");
    }
    if (const Status s = arguments_.json.write(out); !s) {
      return bad_input(s.error().message);
    }
    return kDone;
  }

  const DepthArguments& arguments_;
  Headset& headset_;
  DepthCamera& camera_;
  DepthFrame frame_;
  StereoFrame pair_;
  std::int64_t taken_ = 0;
  bool found_ = false;  ///< the single requested frame was found
  std::optional<std::int64_t> map_;
  engine::PointCloud cloud_;
  CloudReport report_;
  replay::DepthSummary summary_;
};

}  // namespace

bool names_headset(const std::string& source) {
  std::error_code code;
  return source.find(':') != std::string::npos && !std::filesystem::exists(source, code);
}

int depth_of_headset(const DepthArguments& arguments) {
  if (arguments.source.starts_with("hl2ss:") && arguments.stream == "short-throw") {
    return bad_input("--stream: a HoloLens 2 has ahat and long-throw");
  }
  if (arguments.frames && arguments.frame && *arguments.frame >= *arguments.frames) {
    return bad_input("--frame: is " + std::to_string(*arguments.frame) +
                     ", must be less than --frames, " + std::to_string(*arguments.frames));
  }
  const auto opened = open_with_room(asking_for_depth(arguments));
  if (!opened) {
    return bad_input(opened.error().message);
  }
  const auto camera = chosen_camera(arguments, *opened);
  if (!camera) {
    return bad_input(camera.error().message);
  }
  LiveDepth live(arguments, *opened->headset, **camera);
  if (const Status taken = live.take_frames(); !taken) {
    return bad_input(taken.error().message);
  }
  return live.write();
}

}  // namespace orthonav::tools

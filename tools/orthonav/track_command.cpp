#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "base/printed.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "engine/session/method.h"
#include "hal/replay/replay_headset.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/calibration_argument.h"
#include "tools/orthonav/shared/print_text.h"
#include "tools/orthonav/shared/recorded_pairs.h"

namespace orthonav::tools {
namespace {

struct TrackArguments {
  std::string recording;
  std::string tools_file;
  std::string method = "best";
  std::string csv;
  int full_search_every = 1;
  bool exact_stamps = false;
  bool json = false;
  CalibrationArgument calibration;
};

struct TrackSummary {
  std::int64_t pairs = 0;
  std::vector<std::int64_t> measured;  ///< by tool
};

constexpr const char* kHeader =
    "timestamp_100ns,id,px,py,pz,qx,qy,qz,qw,origin,sigma_mm,residual_px,cameras\n";

void append_row(const Headset& headset, const nav::ToolGeometry& tool, const nav::ToolState& state,
                std::string& csv) {
  const auto& pose = state.world_from_marker;
  const Vec3 p = pose.value.translation();
  // A recorded head pose is rigid only to its nine digits; the file promises a unit quaternion.
  Quaternion q = quaternion_from_rotation(pose.value.rotation());
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  q = {q.x / norm, q.y / norm, q.z / norm, q.w / norm};
  append_printed(csv, "%lld,%d,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,measured,%.6g,%.6g,%d\n",
                 static_cast<long long>(headset.file_ticks_100ns(pose.time)), tool.marker.id, p.x,
                 p.y, p.z, q.x, q.y, q.z, q.w, translation_sigma_m(pose.covariance) * 1e3,
                 state.residual_px, state.cameras);
}

Result<TrackSummary> track_all(replay::ReplayHeadset& headset, nav::ToolTracker& tracker,
                               std::string& csv) {
  TrackSummary summary;
  summary.measured.resize(tracker.tools().size());
  const Status read = for_each_pair(headset, [&](const StereoFrame& frame) {
    for (const nav::ToolState& state : tracker.track(frame)) {
      // A predicted pose is not a measurement and gets no row.
      if (state.world_from_marker.status != PoseStatus::kMeasured) {
        continue;
      }
      append_row(headset, tracker.tools()[state.tool], state, csv);
      ++summary.measured[state.tool];
    }
    ++summary.pairs;
  });
  if (!read) {
    return read.error();
  }
  return summary;
}

constexpr double kMilli = 1e3;

nlohmann::ordered_json as_json(const nav::StereoAlignment& found) {
  const auto milli = [](Vec3 v) {
    return nlohmann::ordered_json{kMilli * v.x, kMilli * v.y, kMilli * v.z};
  };
  return {{"right_camera_turned_mrad", milli(found.rotation_rad)},
          {"sd_mrad", milli(found.sd_rad)},
          {"focal_percent", 100.0 * found.focal_fraction},
          {"focal_sd_percent", 100.0 * found.focal_sd},
          {"baseline_percent", 100.0 * found.baseline_fraction},
          {"baseline_sd_percent", 100.0 * found.baseline_sd},
          {"significant", found.significant},
          {"applied", found.applied}};
}

nlohmann::ordered_json as_json(const nav::TagSize& found) {
  return {{"larger_percent", 100.0 * found.fraction},
          {"sd_percent", 100.0 * found.sd},
          {"applied_percent", 100.0 * found.applied},
          {"disagrees", found.disagrees}};
}

/// On standard error, since it makes the result worthless.
void warn_of_sizes(const nav::ToolTracker& tracker) {
  const std::span<const nav::ToolGeometry> tools = tracker.tools();
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const auto size = tracker.tag_size(i);
    if (!size || !size->disagrees) {
      continue;
    }
    const double stated_mm = kMilli * tools[i].marker.size_m;
    std::fprintf(stderr,
                 "orthonav: warning: %s: its tag is stated to measure %.2f mm but measures %.2f mm "
                 "by the cameras (SD %.2f mm): check the print, the unit and the calibration\n",
                 tools[i].name.c_str(), stated_mm, stated_mm * (1.0 + size->fraction),
                 stated_mm * size->sd);
  }
}

void print(const nav::StereoAlignment& found) {
  const char* verdict = "within what can be told";
  if (found.applied) {
    verdict = "significant, applied to the poses";
  }
  if (!found.within_bounds) {
    verdict = "beyond the limit of 10 mrad: the calibration is not this headset's";
  }
  print_text(
      "right camera turned against its calibration by %.2f, %.2f, %.2f mrad"
      " (SD %.2f, %.2f, %.2f): %s\n",
      kMilli * found.rotation_rad.x, kMilli * found.rotation_rad.y, kMilli * found.rotation_rad.z,
      kMilli * found.sd_rad.x, kMilli * found.sd_rad.y, kMilli * found.sd_rad.z, verdict);
}

void print(const TrackArguments& arguments, const TrackSummary& summary,
           const replay::RecordingSummary& recording, const nav::ToolTracker& tracker) {
  const std::span<const nav::ToolGeometry> tools = tracker.tools();
  const auto alignment = tracker.alignment();
  if (arguments.json) {
    nlohmann::ordered_json out = {
        {"method", arguments.method},
        {"pairs", summary.pairs},
        {"pairs_without_pose", recording.pairs_without_pose},
        {"unpaired_images", recording.left_unpaired + recording.right_unpaired}};
    for (std::size_t i = 0; i < tools.size(); ++i) {
      out["tools"].push_back({{"name", tools[i].name},
                              {"id", tools[i].marker.id},
                              {"measured_pairs", summary.measured[i]}});
      if (const auto size = tracker.tag_size(i)) {
        out["tools"].back()["tag_size"] = as_json(*size);
      }
    }
    out["pairs_refused"] = tracker.picture_agreement().refused;
    if (alignment) {
      out["stereo_alignment"] = as_json(*alignment);
    }
    print_text("%s\n", out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return;
  }
  print_text("%s, %lld without a head pose, %s without a partner\n",
             how_many(summary.pairs, "stereo pair").c_str(),
             static_cast<long long>(recording.pairs_without_pose),
             how_many(recording.left_unpaired + recording.right_unpaired, "image").c_str());
  for (std::size_t i = 0; i < tools.size(); ++i) {
    print_text("%s (id %d): measured in %lld\n", tools[i].name.c_str(), tools[i].marker.id,
               static_cast<long long>(summary.measured[i]));
  }
  if (const auto refused = tracker.picture_agreement().refused; refused > 0) {
    print_text("%s refused: the two cameras' pictures do not belong together\n",
               how_many(refused, "stereo pair").c_str());
  }
  if (alignment) {
    print(*alignment);
  }
}

bool is_stdout(const TrackArguments& arguments) { return arguments.csv == "-"; }

/// Before the work, so that an unwritable place is known at once.
Status check_place(const TrackArguments& arguments) {
  if (!is_stdout(arguments)) {
    return engine::check_place(arguments.csv);
  }
  return arguments.json
             ? Error{"--csv -: standard output has the poses, so --json has no place there"}
             : Status{};
}

auto open_recording(const TrackArguments& arguments) {
  replay::ReplayOptions options;
  if (arguments.exact_stamps) {
    options.stamps = replay::RecordedStamps::kExact;
  }
  return replay::ReplayHeadset::open(arguments.recording, options);
}

nav::TrackerOptions options_of(const TrackArguments& arguments) {
  nav::TrackerOptions options;
  options.full_search_interval = arguments.full_search_every;
  return options;
}

/// Writes the poses as the arguments say; standard output then holds nothing else.
Status write_poses(const TrackArguments& arguments, const std::string& csv) {
  if (is_stdout(arguments)) {
    std::fwrite(csv.data(), 1, csv.size(), stdout);
    return {};
  }
  return engine::write_file(arguments.csv, csv);
}

int run_track(const TrackArguments& arguments) {
  const auto method = engine::method_named(arguments.method);
  if (!method) {
    return bad_input(method.error().message);
  }
  auto tools = engine::load_tools(arguments.tools_file);
  if (!tools) {
    return bad_input(tools.error().message);
  }
  const auto headset = open_recording(arguments);
  if (!headset) {
    return bad_input(headset.error().message);
  }
  if (const Status place = check_place(arguments); !place) {
    return bad_input(place.error().message);
  }
  CalibrationArgument calibration = arguments.calibration;
  const auto calibrated = calibration.on(**headset);
  if (!calibrated) {
    return bad_input(calibrated.error().message);
  }
  const auto tracker = method->create_tracker((*calibrated)->cameras()->calibration(),
                                              std::move(*tools), options_of(arguments));
  if (!tracker) {
    return bad_input(tracker.error().message);
  }
  std::string csv = kHeader;
  const auto summary = track_all(**headset, **tracker, csv);
  if (!summary) {
    return bad_input(summary.error().message);
  }
  if (const Status written = write_poses(arguments, csv); !written) {
    return bad_input(written.error().message);
  }
  if (!is_stdout(arguments)) {
    print(arguments, *summary, (*headset)->summary(), **tracker);
  }
  warn_of_sizes(**tracker);
  warn_of_never_seen(**tracker);
  return kDone;
}

constexpr const char* kTrackFooter =
    "\nThe CSV has a row for each tool measured in a pair: world_from_marker, position in metres "
    "and\n"
    "unit quaternion; sigma_mm: predicted 3-D SD of the position from the images' noise;\n"
    "residual_px: RMS reprojection residual of the corners (paper; 0 with best, which has none);\n"
    "cameras: 2, or 1 where one camera alone saw it (best only; less sure). Marker frame: origin "
    "at\n"
    "the tag's centre, x right, y up as the upright tag is seen, z out of its face.";

}  // namespace

void add_track_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<TrackArguments>();
  CLI::App* command =
      app.add_subcommand("track", "Poses of every tool in every stereo pair of a recording");
  command->add_option("RECORDING", arguments->recording, "Folder of a StreamRecorder recording")
      ->required();
  command->add_option("-t,--tools", arguments->tools_file, "Tool definitions (JSON)")->required();
  add_method_option(*command, arguments->method, "tracking: best or paper");
  command->add_option("--csv", arguments->csv, "Where the poses go; -: standard output")
      ->required();
  command
      ->add_option("--full-search-every", arguments->full_search_every,
                   "1: search whole images; N: only around predictions, and everywhere in every "
                   "N-th pair while a tool is missing")
      ->capture_default_str()
      ->check(whole_number(1, 1000));
  command->add_flag("--exact-stamps", arguments->exact_stamps,
                    "StreamRecorder's stamps were corrected already (default: they are 12.5 ms "
                    "late)");
  command->add_flag("--json", arguments->json, "The summary as JSON");
  arguments->calibration.add_to(*command);
  command->footer(kTrackFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_track(*arguments); }; });
}

}  // namespace orthonav::tools

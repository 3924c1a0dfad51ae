#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "engine/io/atomic_file.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/depth/depth_live.h"
#include "tools/orthonav/depth/depth_output.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/depth_listing.h"

namespace orthonav::tools {
namespace {

std::string names_of(const std::vector<replay::RecordedDepth>& streams) {
  std::string names;
  for (const replay::RecordedDepth& depth : streams) {
    names += (names.empty() ? "" : " and ") + std::string(name_of(depth.summary.stream));
  }
  return names;
}

int list(const DepthArguments& arguments, const replay::RecordedDepths& depths) {
  nlohmann::ordered_json out = {{"streams", nlohmann::ordered_json::array()}};
  const auto take = [&](const replay::DepthSummary& summary) {
    out["streams"].push_back(as_json(summary));
    if (!arguments.json.on_stdout()) {
      std::printf("%s: %s\n", name_of(summary.stream), in_words(summary).c_str());
    }
  };
  for (const replay::RecordedDepth& depth : depths.streams) {
    take(depth.summary);
  }
  for (const replay::DepthSummary& unreadable : depths.unreadable) {
    take(unreadable);
  }
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  return kDone;
}

/// The stream asked for, or the only one.
Result<replay::RecordedDepth*> chosen(const DepthArguments& arguments,
                                      replay::RecordedDepths& depths) {
  if (arguments.stream.empty() && depths.streams.size() == 1) {
    return &depths.streams.front();
  }
  for (replay::RecordedDepth& depth : depths.streams) {
    if (arguments.stream == name_of(depth.summary.stream)) {
      return &depth;
    }
  }
  for (const replay::DepthSummary& unreadable : depths.unreadable) {
    if (arguments.stream == name_of(unreadable.stream) || depths.streams.empty()) {
      return Error{unreadable.trouble};
    }
  }
  if (arguments.stream.empty()) {
    return Error{"--stream: must be named, the recording has " + names_of(depths.streams)};
  }
  return Error{"--stream: the recording has no " + arguments.stream + ", it has " +
               names_of(depths.streams)};
}

/// The requested frame, or else the first, or for a cloud the first with a pose.
Result<std::size_t> frame_index(const DepthArguments& arguments, const replay::RecordedDepth& depth,
                                bool with_pose) {
  const auto count = static_cast<std::int64_t>(depth.frames.size());
  std::int64_t index = arguments.frame.value_or(0);
  if (index >= count) {
    return Error{"--frame: is " + std::to_string(index) + ", must be 0 to " +
                 std::to_string(count - 1)};
  }
  const auto located = [&] {
    return depth.frames[static_cast<std::size_t>(index)].world_from_rig.has_value();
  };
  while (with_pose && !arguments.frame && !located() && index + 1 < count) {
    ++index;
  }
  if (with_pose && !located()) {
    return Error{"frame " + std::to_string(index) +
                 " has no pose: the place of its points in the world is unknown"};
  }
  return static_cast<std::size_t>(index);
}

int write_recorded_picture(const DepthArguments& arguments, replay::RecordedDepth& depth) {
  const auto index = frame_index(arguments, depth, false);
  if (!index) {
    return bad_input(index.error().message);
  }
  DepthFrame frame;
  if (const Status s = depth.read(depth.frames[*index], frame); !s) {
    return bad_input(s.error().message);
  }
  return write_picture(arguments, depth.summary.stream, static_cast<std::int64_t>(*index),
                       frame.range_mm);
}

Result<CloudReport> collect(const DepthArguments& arguments, replay::RecordedDepth& depth,
                            engine::PointCloud& cloud) {
  const auto max_mm = static_cast<std::uint16_t>(arguments.max_mm);
  if (arguments.all) {
    return add_all(depth, max_mm, cloud);
  }
  const auto index = frame_index(arguments, depth, true);
  if (!index) {
    return index.error();
  }
  DepthFrame frame;
  if (Status s = depth.read(depth.frames[*index], frame); !s) {
    return s.error();
  }
  add_points(depth.calibration, frame, max_mm, cloud);
  return CloudReport{.frames_used = 1};
}

int write_recorded_cloud(const DepthArguments& arguments, replay::RecordedDepth& depth) {
  engine::PointCloud cloud(1e-3 * arguments.cell_or_default_mm());
  const auto report = collect(arguments, depth, cloud);
  if (!report) {
    return bad_input(report.error().message);
  }
  return write_cloud(arguments, depth.summary.stream, cloud, *report);
}

int of_recording(const DepthArguments& arguments) {
  std::error_code code;
  if (!std::filesystem::is_directory(arguments.source, code)) {
    return bad_input(arguments.source + ": no such folder");
  }
  if (arguments.frames) {
    return bad_input("--frames: is for a headset; --all takes all frames of a recording");
  }
  replay::RecordedDepths depths = replay::read_depths(arguments.source);
  if (depths.streams.empty() && depths.unreadable.empty()) {
    return bad_input(arguments.source +
                     ": holds no depth stream (\"Depth AHaT.tar\", \"Depth Long Throw.tar\", "
                     "\"short_throw_depth.tar\" or \"long_throw_depth.tar\")");
  }
  if (arguments.out.empty()) {
    return list(arguments, depths);
  }
  const auto depth = chosen(arguments, depths);
  if (!depth) {
    return bad_input(depth.error().message);
  }
  return arguments.wants_picture() ? write_recorded_picture(arguments, **depth)
                                   : write_recorded_cloud(arguments, **depth);
}

int run_depth(const DepthArguments& arguments) {
  if (!arguments.out.empty() && !arguments.wants_picture() && !arguments.out.ends_with(".ply")) {
    return bad_input("--out: \"" + arguments.out + "\" must end in .ply or .png");
  }
  if (arguments.wants_picture() && arguments.all) {
    return bad_input("--all: a picture shows one frame; name it with --frame");
  }
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  // Checked before the work, so that an unwritable place is known at once.
  if (!arguments.out.empty()) {
    if (const Status s = engine::check_place(arguments.out); !s) {
      return bad_input(s.error().message);
    }
  }
  return names_headset(arguments.source) ? depth_of_headset(arguments) : of_recording(arguments);
}

constexpr const char* kDepthFooter =
    "\nWithout --out the streams are listed. A PLY holds the measured points in the world (+y up,\n"
    "metres, binary); frames without a pose, and with --all those of an older map, are left out "
    "and\n"
    "counted. A PNG shows one frame: white near, dark far, black not measured. AHaT wraps: what "
    "is\n"
    "past about 1 m appears near (docs/recordings.md). A headset is asked for the stream that "
    "--stream\n"
    "names, raw; hl2ss://HOST?depth=ahat-h264 or long-throw-png asks for it coded. Exit "
    "1: not one "
    "point.";

}  // namespace

void add_depth_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<DepthArguments>();
  CLI::App* command = app.add_subcommand(
      "depth",
      "Depth streams of a recording or a headset: list them, points (PLY), pictures (PNG)");
  command
      ->add_option("SOURCE", arguments->source,
                   "Folder of a recording, which needs no stereo pairs; or a headset, as in "
                   "hl2ss://HOST")
      ->required();
  command->add_option("-o,--out", arguments->out, "PLY or PNG to write")->check(some_text());
  command
      ->add_option("--stream", arguments->stream,
                   "ahat, long-throw or short-throw (default: the only one; ahat of hl2ss://HOST)")
      ->check(CLI::IsMember({"ahat", "long-throw", "short-throw"}));
  CLI::Option* frame =
      command
          ->add_option("--frame", arguments->frame,
                       "Which frame, from 0 (default: the first; for a PLY the first with a pose)")
          ->check(whole_number(0));
  command->add_flag("--all", arguments->all, "The points of all frames")->excludes(frame);
  command
      ->add_option(
          "--frames", arguments->frames,
          "Of a headset: how many frames to take (default: 30 with --all or without --out, "
          "else what --frame needs)")
      ->check(whole_number(1, kMaxLiveFrames));
  constexpr double kMaxCellMm = 1000.0;
  command
      ->add_option("--cell-mm", arguments->cell_mm,
                   "One point for each cube of this side, mm; 0: all (default: 5 with --all, else "
                   "0)")
      ->check(finite_number(0.0, kMaxCellMm));
  command->add_option("--max-mm", arguments->max_mm, "Leave out what is farther, mm")
      ->check(whole_number(1, kMaxRangeMm))
      ->capture_default_str();
  arguments->json.add_to(*command);
  command->footer(kDepthFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_depth(*arguments); }; });
}

}  // namespace orthonav::tools

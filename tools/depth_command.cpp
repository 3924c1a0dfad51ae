#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "engine/io/atomic_file.h"
#include "engine/io/image_file.h"
#include "engine/io/ply_points.h"
#include "engine/io/range_picture.h"
#include "tools/arguments.h"
#include "tools/command.h"
#include "tools/depth_cloud.h"
#include "tools/depth_listing.h"
#include "tools/json_output.h"

namespace orthonav::tools {
namespace {

constexpr int kMaxRangeMm = 65535;

struct DepthArguments {
  std::string recording;
  std::string stream;
  std::string out;
  std::optional<std::int64_t> frame;
  bool all = false;
  std::optional<double> cell_mm;
  int max_mm = kMaxRangeMm;
  JsonOutput json;
};

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

/// The frame asked for, or the first, for a cloud the first with a pose.
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
                 " has no pose: where its points lie in the world is not known"};
  }
  return static_cast<std::size_t>(index);
}

int write_picture(const DepthArguments& arguments, replay::RecordedDepth& depth) {
  const auto index = frame_index(arguments, depth, false);
  if (!index) {
    return bad_input(index.error().message);
  }
  DepthFrame frame;
  if (const Status s = depth.read(depth.frames[*index], frame); !s) {
    return bad_input(s.error().message);
  }
  const engine::RangePicture picture = engine::picture_of_ranges(frame.range_mm);
  if (const Status s = engine::write_png(arguments.out, picture.image); !s) {
    return bad_input(s.error().message);
  }
  const nlohmann::ordered_json out = {{"stream", name_of(depth.summary.stream)},
                                      {"frame", *index},
                                      {"white_mm", picture.white_mm},
                                      {"dark_mm", picture.dark_mm}};
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::printf("%s: frame %zu of %s, white %u mm, dark %u mm, black not measured\n",
                arguments.out.c_str(), *index, name_of(depth.summary.stream), picture.white_mm,
                picture.dark_mm);
  }
  return kDone;
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

int write_cloud(const DepthArguments& arguments, replay::RecordedDepth& depth) {
  constexpr double kDefaultCellMm = 5.0;
  const double cell_mm = arguments.cell_mm.value_or(arguments.all ? kDefaultCellMm : 0.0);
  engine::PointCloud cloud(1e-3 * cell_mm);
  const auto report = collect(arguments, depth, cloud);
  if (!report) {
    return bad_input(report.error().message);
  }
  const std::size_t points = cloud.points_m().size();
  if (const Status s = engine::write_file(
          arguments.out,
          engine::ply_text(cloud.points_m(), "world, +y up, metres; orthonav depth"));
      !s) {
    return bad_input(s.error().message);
  }
  const nlohmann::ordered_json out = {{"stream", name_of(depth.summary.stream)},
                                      {"points", points},
                                      {"cell_mm", cell_mm},
                                      {"frames_used", report->frames_used},
                                      {"frames_without_pose", report->frames_without_pose},
                                      {"frames_in_other_maps", report->frames_in_other_maps}};
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::printf(
        "%s: %zu points of %s; frames: %lld used, %lld without a pose, %lld in other maps\n",
        arguments.out.c_str(), points, name_of(depth.summary.stream),
        static_cast<long long>(report->frames_used),
        static_cast<long long>(report->frames_without_pose),
        static_cast<long long>(report->frames_in_other_maps));
  }
  return points > 0 ? kDone : kNo;
}

int run_depth(const DepthArguments& arguments) {
  const bool picture = arguments.out.ends_with(".png");
  if (!arguments.out.empty() && !picture && !arguments.out.ends_with(".ply")) {
    return bad_input("--out: \"" + arguments.out + "\" must end in .ply or .png");
  }
  if (picture && arguments.all) {
    return bad_input("--all: a picture shows one frame; name it with --frame");
  }
  std::error_code code;
  if (!std::filesystem::is_directory(arguments.recording, code)) {
    return bad_input(arguments.recording + ": no such folder");
  }
  replay::RecordedDepths depths = replay::read_depths(arguments.recording);
  if (depths.streams.empty() && depths.unreadable.empty()) {
    return bad_input(arguments.recording +
                     ": holds no depth stream (\"Depth AHaT.tar\", \"Depth Long Throw.tar\", "
                     "\"short_throw_depth.tar\" or \"long_throw_depth.tar\")");
  }
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  if (arguments.out.empty()) {
    return list(arguments, depths);
  }
  // Checked before the work, so that an unwritable place is known at once.
  if (const auto place = engine::AtomicFile::create(arguments.out); !place) {
    return bad_input(place.error().message);
  }
  const auto depth = chosen(arguments, depths);
  if (!depth) {
    return bad_input(depth.error().message);
  }
  return picture ? write_picture(arguments, **depth) : write_cloud(arguments, **depth);
}

constexpr const char* kDepthFooter =
    "\nWithout --out the streams are listed. A PLY holds the measured points in the world (+y up,\n"
    "metres, binary); frames without a pose, and with --all those of an older map, are left out "
    "and\n"
    "counted. A PNG shows one frame: white near, dark far, black not measured. AHaT wraps: what "
    "is\n"
    "past about 1 m appears near (docs/recordings.md). Exit 1: not one point.";

}  // namespace

void add_depth_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<DepthArguments>();
  CLI::App* command = app.add_subcommand(
      "depth", "Depth streams of a recording: list them, points (PLY), pictures (PNG)");
  command
      ->add_option("RECORDING", arguments->recording,
                   "Folder of a recording; it needs no stereo pairs")
      ->required();
  command->add_option("-o,--out", arguments->out, "PLY or PNG to write")->check(some_text());
  command
      ->add_option("--stream", arguments->stream,
                   "ahat, long-throw or short-throw (default: the only one)")
      ->check(CLI::IsMember({"ahat", "long-throw", "short-throw"}));
  CLI::Option* frame =
      command
          ->add_option("--frame", arguments->frame,
                       "Which frame, from 0 (default: the first; for a PLY the first with a pose)")
          ->check(whole_number(0));
  command->add_flag("--all", arguments->all, "The points of all frames")->excludes(frame);
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

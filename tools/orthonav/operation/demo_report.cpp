#include "tools/orthonav/operation/demo_report.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "base/file_code.h"
#include "engine/io/atomic_file.h"

namespace orthonav::tools {
namespace {

Result<std::vector<std::uint8_t>> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Error{path.string() + ": cannot be read", code_of_unopened(path)};
  }
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(file), {});
}

/// What to look at in a step.
const char* caption_of(engine::Step step) {
  constexpr std::array<const char*, engine::kStepCount> kCaptions = {
      "The tools are found in both cameras; nothing is registered yet.",
      "The pointer strokes the bone: one colour while recording, another once saved.",
      "The pose of the vertebra that fits the strokes is computed.",
      "The registered vertebra is laid over the bone to be judged before use.",
      "The registration was accepted: entry points appear.",
      "Entry, planned trajectory, the triangle towards the tool's axis, and the angle.",
      "What stands in the bone is measured: the line beside the plan is how it stands.",
      "The heads are touched one by one; the rod follows as a spline through them.",
      "The operation is over."};
  static_assert(kCaptions.back() != nullptr, "every step has its caption");
  return kCaptions[static_cast<std::size_t>(step)];
}

std::vector<std::string> notes_of(const DemoReport& report) {
  if (!report.simulated) {
    return {"Errors against the truth are unknown here. Not a medical device."};
  }
  std::vector<std::string> notes;
  notes.push_back(report.perfect
                      ? "Simulated operating room with every source of error at zero."
                      : "Simulated operating room: cameras, head, map, hands and tools err by the "
                        "documented magnitudes (docs/accuracy.md).");
  notes.push_back(report.surgeon);
  notes.push_back(
      "Tracking, registration and guidance saw camera images, head poses, clicker and voice alone; "
      "errors were computed afterwards against what really happened.");
  notes.push_back("Not a medical device.");
  return notes;
}

/// A picture in which a screw is guided says best what the film is of; the last one else.
std::vector<std::uint8_t> poster_of(const DemoReport& report,
                                    const engine::ReportContent& content) {
  if (!report.video || content.pictures.empty()) {
    return {};
  }
  const auto guided = std::find_if(
      report.pictures.begin(), report.pictures.end(),
      [](const StepPicture& picture) { return picture.at.step == engine::Step::kGuide; });
  return guided != report.pictures.end()
             ? content.pictures[static_cast<std::size_t>(guided - report.pictures.begin())].png
             : content.pictures.back().png;
}

/// The registered levels as they lie to each other, in the axes of the first.
void show_spine(const engine::OperationResult& result, bool simulated,
                engine::ReportContent& content) {
  std::optional<Transform<Vertebra, World>> first_from_world;
  for (std::size_t l = 0; l < result.state.levels.size(); ++l) {
    const engine::LevelState& level = result.state.levels[l];
    if (!level.accepted || !level.newest || !level.plan.model) {
      continue;
    }
    const auto& world_from_vertebra = level.newest->registration.world_from_vertebra;
    if (!first_from_world) {
      first_from_world = world_from_vertebra.inverse();
    }
    const Transform<Vertebra, Vertebra> pose = *first_from_world * world_from_vertebra;
    content.spine.add_bone(level.plan.model->mesh(), pose);
    for (std::size_t s = 0; s < level.screws.size(); ++s) {
      if (const auto planned = nav::cylinder_of(level.plan.screws[s])) {
        content.spine.add_planned(*planned, pose);
      }
      const auto driven = engine::driven_screw(level, s, result.truth.levels[l].screws[s]);
      if (level.screws[s].done && driven) {
        content.spine.add_placed(*driven, pose);
      }
    }
  }
  content.spine_note =
      std::string(
          "Vertebrae as they were registered. Blue: screws as planned; amber: the same screws ") +
      (simulated ? "where they truly lie." : "along the tool as it was tracked at depth.");
}

}  // namespace

Status write_demo_report(const std::filesystem::path& folder, const engine::OperationResult& result,
                         const DemoReport& report) {
  engine::ReportContent content;
  content.report_json = engine::report_json(result);
  if (report.video) {
    content.video = "operation.mp4";
  }
  content.date = report.date;
  content.beside_json = report.beside_json;
  content.beside_page = report.beside_page;
  content.plots = report.plots;
  content.notes = notes_of(report);
  content.timings = {{"tracking and update", result.loop.step_wall_ms}};
  if (!result.loop.draw_wall_ms.empty()) {
    content.timings.push_back(
        {"draw the surgeon's view (room and holograms)", result.loop.draw_wall_ms});
  }
  for (const engine::LevelState& level : result.state.levels) {
    if (auto registered = engine::registered_level(level)) {
      content.registrations.push_back(std::move(*registered));
    }
  }
  show_spine(result, report.simulated, content);
  for (const StepPicture& picture : report.pictures) {
    auto png = bytes_of(picture.path);
    if (!png) {
      return png.error();
    }
    content.pictures.push_back(
        {engine::name_of(picture.at), caption_of(picture.at.step), std::move(*png)});
  }
  content.poster = poster_of(report, content);
  const auto page = engine::report_html(content);
  if (!page) {
    return page.error();
  }
  return engine::write_file(folder / "report.html", *page);
}

}  // namespace orthonav::tools

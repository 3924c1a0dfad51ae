#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/angle.h"
#include "base/joined.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "nav/calibration/tag_body.h"
#include "nav/calibration/tag_mounting.h"
#include "tools/arguments.h"
#include "tools/calibrate.h"
#include "tools/json_output.h"
#include "tools/number_list.h"
#include "tools/pose_json.h"
#include "tools/print_text.h"
#include "tools/recorded_pairs.h"

namespace orthonav::tools {
namespace {

constexpr std::size_t kMostTags = 64;

struct ToolArguments {
  std::string recording;
  std::string family = "tag36h11";
  std::string ids;
  std::string sizes_mm;
  std::string out;
  std::string tools_file;
  std::string tool = "tool";
  std::string role = "reference";
  JsonOutput json;
};

/// "40", or a size for each tag: "40,30,30".
Result<std::vector<double>> sizes_m(const std::string& text, std::size_t tags) {
  std::vector<double> sizes;
  std::istringstream fields(text);
  for (std::string field; std::getline(fields, field, ',');) {
    char* end = nullptr;
    const double mm = std::strtod(field.c_str(), &end);
    if (field.empty() || *end != '\0' || !(mm >= 5.0 && mm <= 200.0)) {
      return Error{"--size-mm: \"" + field + "\" must be a size of 5-200 mm"};
    }
    sizes.push_back(mm * 1e-3);
  }
  if (sizes.size() == 1) {
    sizes.resize(tags, sizes.front());
  }
  if (sizes.size() != tags) {
    return Error{"--size-mm: " + std::to_string(sizes.size()) + " sizes for " +
                 std::to_string(tags) + " tags, must be one, or one each"};
  }
  return sizes;
}

Result<std::vector<nav::MarkerDefinition>> tags_from(const ToolArguments& arguments) {
  const auto ids = number_list(arguments.ids, kMostTags);
  if (!ids) {
    return Error{"--ids: " + ids.error().message};
  }
  const auto sizes = sizes_m(arguments.sizes_mm, ids->size());
  if (!sizes) {
    return sizes.error();
  }
  std::vector<nav::MarkerDefinition> tags;
  for (std::size_t i = 0; i < ids->size(); ++i) {
    tags.push_back({arguments.family, ids->at(i), sizes->at(i)});
  }
  return tags;
}

/// The tool of the tools file that is to get these tags; none without such a file.
Result<std::optional<nav::ToolGeometry>> described_tool(const ToolArguments& arguments) {
  if (arguments.tools_file.empty()) {
    return std::optional<nav::ToolGeometry>();
  }
  const auto tools = engine::load_tools(arguments.tools_file);
  if (!tools) {
    return tools.error();
  }
  const auto tool = engine::tool_named(*tools, arguments.tool);
  if (!tool) {
    return Error{arguments.tools_file + ": " + tool.error().message};
  }
  return std::optional<nav::ToolGeometry>(*tool);
}

/// A tool that is to get its tags must have the first one as its marker.
Status check_marker(const ToolArguments& arguments, const std::optional<nav::ToolGeometry>& tool,
                    const nav::MarkerDefinition& first) {
  if (!tool) {
    return {};
  }
  const nav::MarkerDefinition& marker = tool->marker;
  if (marker.family != first.family || marker.id != first.id ||
      std::abs(marker.size_m - first.size_m) > 1e-9) {
    return Error{arguments.tools_file + ": the marker of '" + arguments.tool + "' is " +
                 marker.family + " id " + std::to_string(marker.id) + " of " +
                 std::to_string(marker.size_m * 1e3) + " mm, the first of --ids must be the same"};
  }
  return {};
}

const char* turn_text(int quarter_turns) {
  return quarter_turns == 1   ? "90° counter-clockwise"
         : quarter_turns == 2 ? "180°"
                              : "90° clockwise";
}

/// Poses of tags that were glued on the wrong way round would be right, but not what the file's
/// owner believes: the tip and the axis are described by how the tags should sit.
Status check_mounting(const ToolArguments& arguments, const std::optional<nav::ToolGeometry>& tool,
                      const nav::TagBody& body) {
  if (!tool) {
    return {};
  }
  std::vector<std::string> problems;
  for (const nav::TurnedTag& tag : nav::turned_tags(body.tags, tool->more_markers)) {
    problems.push_back("tag " + tag.definition.family + " id " + std::to_string(tag.definition.id) +
                       " is mounted turned by " + turn_text(tag.quarter_turns));
  }
  if (problems.empty()) {
    return {};
  }
  return Error{"tool calibration: " + joined(problems) + ", seen from the front, against " +
               arguments.tools_file + "; mount it as described, or correct its pose there"};
}

std::vector<nav::AttachedMarker> further_tags(const nav::TagBody& body) {
  std::vector<nav::AttachedMarker> more;
  for (std::size_t i = 1; i < body.tags.size(); ++i) {
    more.push_back({body.tags[i].definition, body.tags[i].marker_from_tag});
  }
  return more;
}

Result<std::string> tools_with(const ToolArguments& arguments, const nav::TagBody& body) {
  if (!arguments.tools_file.empty()) {
    return engine::changed_tools(arguments.tools_file, arguments.tool,
                                 {.more_markers = further_tags(body)});
  }
  nav::ToolGeometry tool;
  tool.name = arguments.tool;
  for (const nav::ToolRole role :
       {nav::ToolRole::kPointer, nav::ToolRole::kGuide, nav::ToolRole::kReference}) {
    if (engine::to_text(role) == arguments.role) {
      tool.role = role;
    }
  }
  tool.marker = body.tags.front().definition;
  tool.more_markers = further_tags(body);
  const std::string text = engine::tools_text({tool});
  if (const auto back = engine::parse_tools(text, arguments.out); !back) {
    return back.error();
  }
  return text;
}

nlohmann::ordered_json body_json(const Result<nav::TagBody>& body, std::size_t pairs) {
  nlohmann::ordered_json out = {{"pairs", pairs}};
  if (!body) {
    add_judgement({nav::Verdict::kFail, body.error().message}, out);
    return out;
  }
  out["pairs_used"] = body->pairs;
  out["rms_px"] = body->rms_px;
  out["outlier_share"] = body->outlier_fraction;
  for (const nav::BodyTag& tag : body->tags) {
    out["tags"].push_back({{"family", tag.definition.family},
                           {"id", tag.definition.id},
                           {"size_mm", tag.definition.size_m * 1e3},
                           {"measured_size_mm", tag.definition.size_m * tag.size_ratio * 1e3},
                           {"pose", rows_mm(tag.marker_from_tag.row_major())},
                           {"pairs", tag.pairs},
                           {"sigma_mm", tag.sigma_m * 1e3},
                           {"sigma_deg", tag.sigma_rad * kDegreesPerRadian}});
  }
  add_judgement(body->judgement, out);
  return out;
}

void print(const nav::TagBody& body) {
  print_text("%zu pairs, residual %.3f px RMS, %.1f %% of the corners left out\n", body.pairs,
             body.rms_px, 100 * body.outlier_fraction);
  for (const nav::BodyTag& tag : body.tags) {
    const Vec3 at_mm = tag.marker_from_tag.translation() * 1e3;
    print_text(
        "%s id %d: at %.3f %.3f %.3f mm, known to %.3f mm and %.3f°; seen in %zu pairs, "
        "edges measure %.2f mm\n",
        tag.definition.family.c_str(), tag.definition.id, at_mm.x, at_mm.y, at_mm.z,
        tag.sigma_m * 1e3, tag.sigma_rad * kDegreesPerRadian, tag.pairs,
        tag.definition.size_m * tag.size_ratio * 1e3);
  }
  print_judgement(body.judgement);
}

int run_tool(const ToolArguments& arguments) {
  const auto tags = tags_from(arguments);
  if (!tags) {
    return bad_input(tags.error().message);
  }
  const auto tool = described_tool(arguments);
  if (!tool) {
    return bad_input(tool.error().message);
  }
  if (const Status s = check_marker(arguments, *tool, tags->front()); !s) {
    return bad_input(s.error().message);
  }
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  if (auto place = engine::AtomicFile::create(arguments.out); !place) {
    return bad_input(place.error().message);
  }
  const auto seen = recorded_sightings(arguments.recording, *tags);
  if (!seen) {
    return bad_input(seen.error().message);
  }

  auto body = nav::calibrate_tag_body(seen->calibration, *tags, seen->pairs);
  if (body) {
    if (const Status s = check_mounting(arguments, *tool, *body); !s) {
      body = s.error();
    }
  }
  if (body) {
    const auto text = tools_with(arguments, *body);
    if (!text) {
      return bad_input(text.error().message);
    }
    if (const Status s = engine::write_file(arguments.out, *text); !s) {
      return bad_input(s.error().message);
    }
  }
  if (const Status s = arguments.json.write(body_json(body, seen->pairs.size())); !s) {
    return bad_input(s.error().message);
  }
  if (!body) {
    return refused(body.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(*body);
  }
  return kDone;
}

constexpr const char* kToolFooter =
    "\nTurn the tool slowly before the cameras so that each tag is seen together with a "
    "neighbour,\n"
    "in fifty pairs and more. The first of --ids becomes the tool's marker; poses of the others\n"
    "are relative to it. A tag that sits turned by a quarter or half against the pose that "
    "--tools\n"
    "has for it is refused. Without --tools a file with this one tool is written, its tip at the\n"
    "marker until `calibrate pivot` finds it. Exit code 1: refused, nothing written.";

}  // namespace

void add_calibrate_tool(CLI::App& calibrate, Action& action) {
  auto arguments = std::make_shared<ToolArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "tool", "Where several tags lie on one rigid tool, from a recording");
  command->add_option("RECORDING", arguments->recording, "Folder of a recording")->required();
  command->add_option("--family", arguments->family, "Tag family")->capture_default_str();
  command->add_option("--ids", arguments->ids, "Tags of the tool, its marker first: 3,4,5 or 3-5")
      ->required()
      ->type_name("LIST");
  command
      ->add_option("--size-mm", arguments->sizes_mm,
                   "Outer edge of the black borders: one for all, or one each: 40,30,30")
      ->required()
      ->type_name("LIST");
  command->add_option("--out", arguments->out, "Where the tools file goes")
      ->required()
      ->check(some_text())
      ->type_name("FILE");
  command
      ->add_option("--tools", arguments->tools_file,
                   "Tools of which the one named gets these tags; may be the file of --out")
      ->type_name("FILE");
  command->add_option("--tool", arguments->tool, "Name of the tool")
      ->check(some_text())
      ->capture_default_str()
      ->type_name("NAME");
  command->add_option("--role", arguments->role, "Of a new tool")
      ->check(CLI::IsMember({"pointer", "guide", "reference"}))
      ->capture_default_str();
  arguments->json.add_to(*command);
  command->footer(kToolFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_tool(*arguments); }; });
}

}  // namespace orthonav::tools

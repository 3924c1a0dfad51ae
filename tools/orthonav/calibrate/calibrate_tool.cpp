#include <cmath>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>

#include "base/how_many.h"
#include "base/joined.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "nav/calibration/tag_body.h"
#include "nav/calibration/tag_mounting.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/calibrate/tag_body_output.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/number_list.h"
#include "tools/orthonav/shared/recorded_pairs.h"

namespace orthonav::tools {
namespace {

constexpr std::size_t kMaxTagsOfTool = 64;

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
    return Error{"--size-mm: " + how_many(sizes.size(), "size") + " for " + how_many(tags, "tag") +
                 ", must be one, or one each"};
  }
  return sizes;
}

Result<std::vector<nav::MarkerDefinition>> tags_from(const ToolArguments& arguments) {
  const auto ids = number_list(arguments.ids, kMaxTagsOfTool);
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

/// The tool of the tools file to which these tags are to be added; none without such a file.
Result<std::optional<nav::ToolGeometry>> described_tool(const ToolArguments& arguments) {
  if (arguments.tools_file.empty()) {
    return std::optional<nav::ToolGeometry>();
  }
  const auto tool = engine::load_tool(arguments.tools_file, arguments.tool);
  if (!tool) {
    return tool.error();
  }
  return std::optional<nav::ToolGeometry>(*tool);
}

/// The tool must have the first tag as its marker.
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

const char* rotation_text(int quarter_turns) {
  return quarter_turns == 1   ? "90° counter-clockwise"
         : quarter_turns == 2 ? "180°"
                              : "90° clockwise";
}

/// The measured poses of tags that were glued on turned would be right, but the file's tip and axis
/// assume the intended mounting.
Status check_mounting(const ToolArguments& arguments, const std::optional<nav::ToolGeometry>& tool,
                      const nav::TagBody& body) {
  if (!tool) {
    return {};
  }
  std::vector<std::string> problems;
  for (const nav::RotatedTag& tag : nav::rotated_tags(body.tags, tool->more_markers)) {
    problems.push_back("tag " + tag.definition.family + " id " + std::to_string(tag.definition.id) +
                       " is mounted turned by " + rotation_text(tag.quarter_turns));
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

std::vector<std::string> role_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < nav::kToolRoles; ++i) {
    names.push_back(engine::to_text(static_cast<nav::ToolRole>(i)));
  }
  return names;
}

Result<std::string> tools_with(const ToolArguments& arguments, const nav::TagBody& body) {
  if (!arguments.tools_file.empty()) {
    return engine::changed_tools(arguments.tools_file, arguments.tool,
                                 {.more_markers = further_tags(body)});
  }
  nav::ToolGeometry tool;
  tool.name = arguments.tool;
  for (std::size_t i = 0; i < nav::kToolRoles; ++i) {
    const auto role = static_cast<nav::ToolRole>(i);
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

/// The inputs that the arguments name, before the recording is read.
struct ToolInput {
  std::vector<nav::MarkerDefinition> tags;
  std::optional<nav::ToolGeometry> tool;  ///< as described; none without a tools file
};

/// Checks that the results can be written, too.
Result<ToolInput> tool_input(const ToolArguments& arguments) {
  auto tags = tags_from(arguments);
  if (!tags) {
    return tags.error();
  }
  auto tool = described_tool(arguments);
  if (!tool) {
    return tool.error();
  }
  if (const Status s = check_marker(arguments, *tool, tags->front()); !s) {
    return s.error();
  }
  if (const Status s = arguments.json.check(); !s) {
    return s.error();
  }
  if (const Status s = engine::check_place(arguments.out); !s) {
    return s.error();
  }
  return ToolInput{std::move(*tags), std::move(*tool)};
}

/// Also refuses a tag that is not mounted as described.
Result<nav::TagBody> calibrated(const ToolArguments& arguments, const ToolInput& input,
                                const RecordedSightings& seen) {
  auto body = nav::calibrate_tag_body(seen.calibration, input.tags, seen.pairs);
  if (!body) {
    return Error{body.error().message + (seen.never_seen.empty() ? "" : "; " + seen.never_seen)};
  }
  if (const Status s = check_mounting(arguments, input.tool, *body); !s) {
    return s.error();
  }
  return body;
}

Status write_tools(const ToolArguments& arguments, const nav::TagBody& body) {
  const auto text = tools_with(arguments, body);
  return text ? engine::write_file(arguments.out, *text) : Status(text.error());
}

int run_tool(const ToolArguments& arguments) {
  const auto input = tool_input(arguments);
  if (!input) {
    return bad_input(input.error().message);
  }
  const auto seen = recorded_sightings(arguments.recording, input->tags);
  if (!seen) {
    return bad_input(seen.error().message);
  }
  const auto body = calibrated(arguments, *input, *seen);
  if (body) {
    if (const Status s = write_tools(arguments, *body); !s) {
      return bad_input(s.error().message);
    }
  }
  if (const Status s = arguments.json.write(tag_body_json(body, seen->pairs.size())); !s) {
    return bad_input(s.error().message);
  }
  if (!body) {
    return refused(body.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print_tag_body(*body);
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
  command->add_option("-o,--out", arguments->out, "Where the tools file goes")
      ->required()
      ->check(some_text())
      ->type_name("FILE");
  command
      ->add_option("-t,--tools", arguments->tools_file,
                   "Tools of which the one named gets these tags; may be the file of --out")
      ->type_name("FILE");
  command->add_option("--tool", arguments->tool, "Name of the tool")
      ->check(some_text())
      ->capture_default_str()
      ->type_name("NAME");
  command->add_option("--role", arguments->role, "Of a new tool")
      ->check(CLI::IsMember(role_names()))
      ->capture_default_str();
  arguments->json.add_to(*command);
  command->footer(kToolFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_tool(*arguments); }; });
}

}  // namespace orthonav::tools

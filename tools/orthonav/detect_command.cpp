#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/how_many.h"
#include "base/printed.h"
#include "engine/io/grey_image_file.h"
#include "nav/tracking/marker_detector.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

constexpr const char* kConvention =
    "continuous pixels as stored: x right, y down, the top-left pixel's centre is (0.5, 0.5)";
constexpr const char* kOrder = "bottom left, bottom right, top right, top left of the upright tag";
constexpr int kManyCodes = 10000;

struct DetectArguments {
  std::vector<std::string> images;
  std::vector<std::string> families = {"tag36h11"};
  std::optional<int> max_hamming;
  double min_decision_margin = 25.0;
  double decimate = 1.0;
  std::string refine = "edges";
  bool json = false;
};

const std::map<std::string, nav::Refinement>& refinements() {
  static const std::map<std::string, nav::Refinement> all = {{"none", nav::Refinement::kNone},
                                                             {"library", nav::Refinement::kLibrary},
                                                             {"edges", nav::Refinement::kEdges}};
  return all;
}

struct Seen {
  std::string image;
  int width_px = 0;
  int height_px = 0;
  std::vector<nav::MarkerCorners> markers;
};

int default_hamming(const std::vector<std::string>& families) {
  for (const std::string& family : families) {
    if (nav::family_size(family) > kManyCodes) {
      return 1;
    }
  }
  return 2;
}

Result<std::vector<Seen>> detect_all(const DetectArguments& arguments) {
  nav::DetectorOptions options;
  options.families = arguments.families;
  options.max_hamming = arguments.max_hamming.value_or(default_hamming(arguments.families));
  options.min_decision_margin = arguments.min_decision_margin;
  options.decimate = arguments.decimate;
  options.touched = true;
  options.refinement = refinements().at(arguments.refine);
  auto detector = nav::MarkerDetector::create(options);
  if (!detector) {
    return detector.error();
  }
  std::vector<Seen> all;
  for (const std::string& path : arguments.images) {
    const auto image = engine::load_grey(path);
    if (!image) {
      return image.error();
    }
    Seen seen{path, image->width_px, image->height_px, {}};
    if (Status status = detector->detect(*image, seen.markers); !status) {
      return Error{path + ": " + status.error().message};
    }
    all.push_back(std::move(seen));
  }
  return all;
}

std::string seen_as_json(const std::vector<Seen>& all) {
  nlohmann::ordered_json out = {{"corner_coordinates", kConvention}, {"corner_order", kOrder}};
  out["images"] = nlohmann::ordered_json::array();
  for (const Seen& seen : all) {
    nlohmann::ordered_json image = {
        {"image", seen.image}, {"width_px", seen.width_px}, {"height_px", seen.height_px}};
    image["markers"] = nlohmann::ordered_json::array();
    for (const nav::MarkerCorners& marker : seen.markers) {
      nlohmann::ordered_json corners;
      for (const Vec2 c : marker.corners_px) {
        corners.push_back({c.x, c.y});
      }
      image["markers"].push_back({{"family", marker.family},
                                  {"id", marker.id},
                                  {"hamming_bits", marker.hamming},
                                  {"decision_margin", marker.decision_margin},
                                  {"corners_px", std::move(corners)}});
    }
    out["images"].push_back(std::move(image));
  }
  return out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string as_text(const std::vector<Seen>& all) {
  std::string text = std::string("# corners in ") + kConvention + "; " + kOrder + "\n";
  for (const Seen& seen : all) {
    text += seen.image + ": " + how_many(seen.markers.size(), "marker") + "\n";
    for (const nav::MarkerCorners& marker : seen.markers) {
      const auto& c = marker.corners_px;
      append_printed(text,
                     "  %s id %d  corrected bits %d  margin %.1f  (%.3f %.3f) (%.3f %.3f) "
                     "(%.3f %.3f) (%.3f %.3f)\n",
                     std::string(marker.family).c_str(), marker.id, marker.hamming,
                     marker.decision_margin, c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y, c[3].x,
                     c[3].y);
    }
  }
  return text;
}

int run_detect(const DetectArguments& arguments) {
  const auto all = detect_all(arguments);
  if (!all) {
    return bad_input(all.error().message);
  }
  const std::string text = arguments.json ? seen_as_json(*all) : as_text(*all);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return kDone;
}

}  // namespace

void add_detect_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command =
      app.add_subcommand("detect", "Ids and corners of the markers in images (PNG, JPEG, PGM)");
  command->add_option("IMAGE", arguments->images, "Images")->required();
  command
      ->add_option("--family", arguments->families,
                   "Tag family, may be repeated; known are " + nav::known_families_text())
      ->default_str("tag36h11")
      ->allow_extra_args(false);
  command
      ->add_option("--max-hamming", arguments->max_hamming,
                   "Corrected bits, 0-2 (default: 2, or 1 for families of over 10,000 codes)")
      ->check(whole_number(0, 2));
  command
      ->add_option("--min-margin", arguments->min_decision_margin,
                   "Least decision margin, grey levels: weaker tags are left out")
      ->check(finite_number(0, 255))
      ->capture_default_str();
  command
      ->add_option("--decimate", arguments->decimate,
                   "Look for tags at this fraction of the resolution: 1, 1.5, 2, 3 or 4")
      ->check(finite_number(1, 4))
      ->capture_default_str();
  command
      ->add_option("--refine", arguments->refine,
                   "Corners: where the edges meet that are fitted to the grey levels (edges); as "
                   "AprilTag refines them (library); as its quads have them (none)")
      ->check(CLI::IsMember(refinements()))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Everything as JSON");
  command->footer(std::string("\nCorners are in ") + kConvention + ",\nin the order " + kOrder +
                  ".");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_detect(*arguments); }; });
}

}  // namespace orthonav::tools

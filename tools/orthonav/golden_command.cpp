#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "base/how_many.h"
#include "engine/golden/golden_review.h"
#include "engine/io/atomic_file.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReasonsFile = "reasons.txt";

struct GoldenOptions {
  std::string folder = "tests/golden/images";
  std::string device = engine::GoldenPainter::kPinnedDevice;
  std::vector<std::string> scenes;  ///< empty: all
  std::string out;
  std::string why;
};

/// The scenes of those names; an error names one that does not exist.
Result<std::vector<engine::GoldenScene>> chosen_scenes(const std::vector<std::string>& names) {
  std::vector<engine::GoldenScene> all = engine::golden_scenes();
  if (names.empty()) {
    return all;
  }
  std::vector<engine::GoldenScene> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const engine::GoldenScene& scene) {
      return scene.name == name;
    });
    if (found == all.end()) {
      return Error{"no golden scene '" + name + "'; see: orthonav golden list"};
    }
    chosen.push_back(*found);
  }
  return chosen;
}

int list_scenes() {
  for (const engine::GoldenScene& scene : engine::golden_scenes()) {
    std::printf("%-16s %4dx%d x%zu  %s\n", scene.name.c_str(), scene.width_px, scene.height_px,
                scene.views.size(), scene.what.c_str());
  }
  return kDone;
}

int render_scenes(const GoldenOptions& options) {
  const auto scenes = chosen_scenes(options.scenes);
  if (!scenes) {
    return bad_input(scenes.error().message);
  }
  const auto out = OutFolder::create("--out", options.out);
  if (!out) {
    return bad_input(out.error().message);
  }
  engine::GoldenPainter painter(options.device);
  for (const engine::GoldenScene& scene : *scenes) {
    const auto images = painter.paint(scene);
    if (!images) {
      return bad_input(images.error().message);
    }
    const Status written = engine::write_goldens(options.out, scene.name, *images);
    if (!written) {
      return bad_input(written.error().message);
    }
    std::printf("%s\n", scene.name.c_str());
  }
  return kDone;
}

int review(const GoldenOptions& options) {
  const auto scenes = chosen_scenes(options.scenes);
  if (!scenes) {
    return bad_input(scenes.error().message);
  }
  engine::GoldenPainter painter(options.device);
  std::vector<engine::GoldenVerdict> verdicts;
  const std::vector<std::string> orphans =
      engine::orphaned_goldens(options.folder, engine::golden_scenes());
  bool alike = orphans.empty();
  for (const std::string& orphan : orphans) {
    std::printf("%s belongs to no scene\n", orphan.c_str());
  }
  for (const engine::GoldenScene& scene : *scenes) {
    auto verdict = engine::judge(painter, scene, options.folder);
    if (!verdict) {
      return bad_input(verdict.error().message);
    }
    alike = alike && verdict->problems.empty();
    for (const std::string& problem : verdict->problems) {
      std::printf("%s: %s\n", scene.name.c_str(), problem.c_str());
    }
    verdicts.push_back(std::move(*verdict));
  }
  const Result<std::string> page = engine::review_page(verdicts, orphans);
  if (!page) {
    return bad_input(page.error().message);
  }
  if (const Status written = engine::write_file(options.out, *page); !written) {
    return bad_input(written.error().message);
  }
  std::printf("%s, %s: %s\n", how_many(verdicts.size(), "scene").c_str(),
              alike ? "all alike" : "not all alike", options.out.c_str());
  return alike ? kDone : kNo;
}

/// The recorded reasons with this scene's added or replaced; one line per scene, sorted.
std::string reasons_with(const fs::path& file, const std::string& scene, const std::string& why) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && !line.starts_with(scene + ": ")) {
      lines.push_back(line);
    }
  }
  lines.push_back(scene + ": " + why);
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines) {
    text += line + "\n";
  }
  return text;
}

int approve(const GoldenOptions& options) {
  if (options.why.empty() || options.why.find('\n') != std::string::npos) {
    return bad_input("--why: a reason in one line is needed");
  }
  const auto scenes = chosen_scenes(options.scenes);
  if (!scenes) {
    return bad_input(scenes.error().message);
  }
  if (!fs::is_directory(options.folder)) {
    return bad_input(options.folder + ": no such folder");
  }
  engine::GoldenPainter painter(options.device, true);
  const engine::GoldenScene& scene = scenes->front();
  const auto images = painter.paint(scene);
  if (!images) {
    return bad_input(images.error().message);
  }
  const std::vector<std::string> messages = painter.validation_messages();
  if (!messages.empty()) {
    return bad_input("not approved; validation: " + messages.front());
  }
  const Status written = engine::write_goldens(options.folder, scene.name, *images);
  if (!written) {
    return bad_input(written.error().message);
  }
  const fs::path reasons = fs::path(options.folder) / kReasonsFile;
  const Status noted =
      engine::write_file(reasons.string(), reasons_with(reasons, scene.name, options.why));
  if (!noted) {
    return bad_input(noted.error().message);
  }
  std::printf("%s approved\n", scene.name.c_str());
  return kDone;
}

}  // namespace

void add_golden_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<GoldenOptions>();
  CLI::App* golden = app.add_subcommand("golden", "Golden images of the holograms");
  golden->require_subcommand(1);
  const auto add_common = [&](CLI::App* command) {
    command->add_option("--dir", options->folder, "Folder of the golden images")
        ->capture_default_str();
    command->add_option("--device", options->device, "Part of the Vulkan device's name")
        ->capture_default_str();
  };
  CLI::App* list = golden->add_subcommand("list", "Names, sizes (px x views) and contents");
  list->callback([&action] { action = list_scenes; });

  CLI::App* draw = golden->add_subcommand("render", "Draws scenes as they are now");
  draw->add_option("SCENE", options->scenes, "Scenes (default: all)");
  draw->add_option("-o,--out", options->out, "Folder to write to")->required();
  draw->add_option("--device", options->device, "Part of the Vulkan device's name")
      ->capture_default_str();
  draw->callback([&action, options] { action = [options] { return render_scenes(*options); }; });

  CLI::App* page = golden->add_subcommand(
      "review", "Writes one HTML with expected, actual and difference; exit 1 if any differs");
  page->add_option("SCENE", options->scenes, "Scenes (default: all)");
  page->add_option("-o,--out", options->out, "HTML file to write")
      ->default_str("golden-review.html");
  add_common(page);
  page->callback([&action, options] {
    if (options->out.empty()) {
      options->out = "golden-review.html";
    }
    action = [options] { return review(*options); };
  });

  CLI::App* take = golden->add_subcommand("approve", "Takes what is drawn now as the golden image");
  take->add_option("SCENE", options->scenes, "Scene")->required()->expected(1);
  take->add_option("--why", options->why, "Reason, one line; kept beside the images")->required();
  add_common(take);
  take->callback([&action, options] { action = [options] { return approve(*options); }; });
}

}  // namespace orthonav::tools

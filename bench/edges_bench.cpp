// How far the edges of every golden scene are from what 64 samples in each pixel show, with
// computed coverage and with four samples. Texts are left out: they are drawn alike. Prints a table
// in Markdown.
//   build/bench/bench/bench_edges [--device NAME] [SCENE ...]
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "engine/golden/golden_scenes.h"
#include "tests/support/many_samples.h"

namespace orthonav::bench {
namespace {

using render::Edges;

constexpr int kGrid = 8;

struct Errors {
  render::EdgeError coverage;
  render::EdgeError samples;
};

[[noreturn]] void fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  std::exit(1);
}

std::unique_ptr<render::Renderer> renderer_for(const engine::GoldenScene& scene, Edges edges,
                                               const std::string& device) {
  render::RendererOptions options;
  options.width_px = scene.width_px;
  options.height_px = scene.height_px;
  options.edges = edges;
  options.device = device;
  options.every_triangle = edges == Edges::kHard;  // the reference
  auto renderer = render::Renderer::create(options);
  if (!renderer) {
    fail(renderer.error());
  }
  return std::move(*renderer);
}

std::vector<RgbaImage> drawn(render::Renderer& renderer, const engine::GoldenScene& scene) {
  std::vector<RgbaImage> images;
  if (const Status done = renderer.draw(scene.scene, scene.views, {}, images); !done) {
    fail(done.error());
  }
  return images;
}

void add(const engine::GoldenScene& scene, const std::string& device, Errors& errors) {
  const auto hard = renderer_for(scene, Edges::kHard, device);
  const auto reference = render::many_samples(*hard, scene.scene, scene.views, kGrid);
  if (!reference) {
    fail(reference.error());
  }
  const auto one = drawn(*hard, scene);
  const auto coverage = drawn(*renderer_for(scene, Edges::kCoverage, device), scene);
  const auto samples = drawn(*renderer_for(scene, Edges::kSamples, device), scene);
  for (std::size_t view = 0; view < one.size(); ++view) {
    render::add_error((*reference)[view], one[view], coverage[view], errors.coverage);
    render::add_error((*reference)[view], one[view], samples[view], errors.samples);
  }
}

void print_row(const std::string& name, const Errors& errors) {
  std::printf("| %s | %zu | %.1f | %.1f | %.0f | %.0f |\n", name.c_str(),
              errors.coverage.channels / 3, errors.coverage.rms(), errors.samples.rms(),
              errors.coverage.worst, errors.samples.worst);
}

void join(const render::EdgeError& part, render::EdgeError& all) {
  all.sum_squares += part.sum_squares;
  all.worst = std::max(all.worst, part.worst);
  all.channels += part.channels;
}

void run(const std::vector<std::string>& wanted, const std::string& device) {
  std::printf(
      "| scene | pixels cut | RMS, coverage | RMS, 4 samples | worst, coverage | worst, 4 samples "
      "|\n"
      "|---|---|---|---|---|---|\n");
  Errors all;
  int sharper = 0;
  int better_worst = 0;
  int scenes = 0;
  for (engine::GoldenScene& scene : engine::golden_scenes()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), scene.name) == wanted.end()) {
      continue;
    }
    scene.scene.texts.clear();
    Errors errors;
    add(scene, device, errors);
    if (errors.coverage.channels == 0) {
      continue;
    }
    print_row(scene.name, errors);
    join(errors.coverage, all.coverage);
    join(errors.samples, all.samples);
    ++scenes;
    sharper += errors.coverage.rms() < errors.samples.rms() ? 1 : 0;
    better_worst += errors.coverage.worst < errors.samples.worst ? 1 : 0;
  }
  print_row("all", all);
  std::printf("\nWith computed coverage, %d of %d scenes have a smaller RMS error, ", sharper,
              scenes);
  std::printf("and in %d of them the worst pixel is less far off.\n", better_worst);
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  std::vector<std::string> scenes;
  std::string device = "llvmpipe";
  CLI::App app("Errors of edges against 64 samples in each pixel");
  app.add_option("scenes", scenes, "golden scenes; all of them if none is named");
  app.add_option("--device", device, "part of the Vulkan device's name");
  CLI11_PARSE(app, argc, argv);
  orthonav::bench::run(scenes, device);
}

// A full frame of guidance in both eyes, compared with VTK drawing the same in the same run, frames
// alternating so that other load affects both alike. Prints a table in Markdown.
//   xvfb-run -a build/bench/bench/bench_render [--frames N] [--width PX] [--height PX]
//     [--device NAME] [--save]
#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/render_scene.h"
#include "bench/vtk_window.h"
#include "render/renderer.h"

namespace orthonav::bench {
namespace {

struct Options {
  int frames = 200;
  int width_px = 1268;
  int height_px = 720;
  std::string device = "llvmpipe";
  bool save = false;
};

/// Times of one phase over all frames.
class Phase {
 public:
  void add(double ms) { ms_.push_back(ms); }
  [[nodiscard]] double quantile(double fraction) const {
    std::vector<double> sorted = ms_;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty()) {
      return 0;
    }
    return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1) +
                                           0.5)];
  }
  [[nodiscard]] std::string text() const {
    char line[64];
    std::snprintf(line, sizeof(line), "%.1f / %.1f", quantile(0.5), quantile(0.99));
    return line;
  }

 private:
  std::vector<double> ms_;
};

/// Resident memory of this process.
double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Of all threads of this process.
double processor_ms() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Row {
  Phase record, submit, gpu, read, total, processor;
  double memory_mib = 0;
};

void print_row(const std::string& name, const std::string& edges, const Row& row) {
  std::printf("| %s | %s | %s | %s | %s | %s | %s | %s | %.0f |\n", name.c_str(), edges.c_str(),
              row.record.text().c_str(), row.submit.text().c_str(), row.gpu.text().c_str(),
              row.read.text().c_str(), row.total.text().c_str(), row.processor.text().c_str(),
              row.memory_mib);
}

std::unique_ptr<render::Renderer> make_renderer(const Options& options, render::Edges edges,
                                                bool every_triangle) {
  render::RendererOptions wanted;
  wanted.width_px = options.width_px;
  wanted.height_px = options.height_px;
  wanted.edges = edges;
  wanted.device = options.device;
  wanted.every_triangle = every_triangle;
  auto renderer = render::Renderer::create(wanted);
  if (!renderer) {
    std::fprintf(stderr, "%s\n", renderer.error().message.c_str());
    std::exit(1);
  }
  return std::move(*renderer);
}

class Ours {
 public:
  Ours(const Options& options, render::Edges edges, bool every_triangle, const FullScene& full)
      : before_mib_(resident_mib()),
        renderer_(make_renderer(options, edges, every_triangle)),
        full_(full) {}

  void draw(int frame, Row* row) {
    const double before_ms = processor_ms();
    const Status drawn = renderer_->draw(full_.scene, swayed(full_.views, frame), {}, images_);
    if (!drawn) {
      std::fprintf(stderr, "%s\n", drawn.error().message.c_str());
      std::exit(1);
    }
    if (row == nullptr) {
      return;
    }
    const render::FrameTiming timing = renderer_->last_timing();
    row->record.add(timing.record_ms);
    row->submit.add(timing.submit_ms);
    row->gpu.add(timing.gpu_ms);
    row->read.add(timing.read_ms);
    row->total.add(timing.total_ms);
    row->processor.add(processor_ms() - before_ms);
  }
  [[nodiscard]] double before_mib() const { return before_mib_; }
  [[nodiscard]] std::string name() const { return renderer_->device().name; }

 private:
  double before_mib_;
  std::unique_ptr<render::Renderer> renderer_;
  const FullScene& full_;
  std::vector<RgbaImage> images_;
};

void draw_peer(VtkWindow& window, const FullScene& full, int frame, Row* row) {
  const double before_ms = processor_ms();
  const VtkTiming timing = window.draw(swayed(full.views, frame));
  if (row == nullptr) {
    return;
  }
  row->record.add(timing.render_ms);
  row->gpu.add(timing.wait_ms);
  row->read.add(timing.read_ms);
  row->total.add(timing.total_ms);
  row->processor.add(processor_ms() - before_ms);
}

/// Memory is what each renderer adds to the process with its first frames.
struct Comparison {
  const char* name;
  render::Edges edges;
  int samples;  ///< VTK's
};

void compare(const Options& options, const Comparison& way, const FullScene& full) {
  constexpr int kWarmUp = 5;
  Row ours, all_triangles, peers;
  Ours renderer(options, way.edges, false, full);
  for (int i = 0; i < kWarmUp; ++i) {
    renderer.draw(i, nullptr);
  }
  ours.memory_mib = resident_mib() - renderer.before_mib();
  Ours whole(options, way.edges, true, full);
  for (int i = 0; i < kWarmUp; ++i) {
    whole.draw(i, nullptr);
  }
  all_triangles.memory_mib = resident_mib() - whole.before_mib();
  const double between_mib = resident_mib();
  std::unique_ptr<VtkWindow> window;
  if (std::getenv("DISPLAY") != nullptr) {
    window = VtkWindow::create(full.scene, full.views.size(), options.width_px, options.height_px,
                               way.samples);
  }
  for (int i = 0; window && i < kWarmUp; ++i) {
    draw_peer(*window, full, i, nullptr);
  }
  peers.memory_mib = resident_mib() - between_mib;
  for (int i = 0; i < options.frames; ++i) {
    renderer.draw(i, &ours);
    whole.draw(i, &all_triangles);
    if (window) {
      draw_peer(*window, full, i, &peers);
    }
  }
  print_row("orthonav, " + renderer.name(), way.name, ours);
  print_row("orthonav, every triangle", way.name, all_triangles);
  if (!window) {
    return;
  }
  print_row("VTK " + window->name(), std::to_string(way.samples) + " samples", peers);
  std::printf("\nRatio of the medians, %s to VTK's %d samples: %.3f, with every triangle %.3f;\n",
              way.name, way.samples, ours.total.quantile(0.5) / peers.total.quantile(0.5),
              all_triangles.total.quantile(0.5) / peers.total.quantile(0.5));
  std::printf("of processor time: %.3f, %.3f\n\n",
              ours.processor.quantile(0.5) / peers.processor.quantile(0.5),
              all_triangles.processor.quantile(0.5) / peers.processor.quantile(0.5));
  if (options.save) {
    window->save("vtk_" + std::to_string(way.samples) + ".png");
  }
}

void run(const Options& options) {
  const FullScene full = full_scene();
  std::size_t triangles = 0;
  for (const auto& item : full.scene.meshes) {
    triangles += item.mesh->indices.size() / 3;
  }
  std::printf("%zu surfaces of %zu triangles, %zu lines, %zu triangles, %zu texts; %zu eyes of ",
              full.scene.meshes.size(), triangles, full.scene.lines.size(),
              full.scene.triangles.size(), full.scene.texts.size(), full.views.size());
  std::printf("%dx%d px; %d frames; ms as median / p99\n\n", options.width_px, options.height_px,
              options.frames);
  std::printf(
      "| renderer | edges | record | submit | GPU side | read | total | processor | memory, MiB "
      "|\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  for (const Comparison& way : {Comparison{"coverage", render::Edges::kCoverage, 4},
                                {"4 samples", render::Edges::kSamples, 4},
                                {"1 sample", render::Edges::kHard, 1}}) {
    compare(options, way, full);
  }
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  orthonav::bench::Options options;
  CLI::App app("Frame times of a full guidance scene, beside VTK");
  app.add_option("--frames", options.frames, "frames measured");
  app.add_option("--width", options.width_px, "of one eye, px");
  app.add_option("--height", options.height_px, "of one eye, px");
  app.add_option("--device", options.device, "part of the name of our Vulkan device");
  app.add_flag("--save", options.save, "saves what VTK drew as vtk_SAMPLES.png");
  CLI11_PARSE(app, argc, argv);
  if (std::getenv("DISPLAY") == nullptr) {
    std::puts("No X display, so no VTK: run it through xvfb-run -a");
  }
  orthonav::bench::run(options);
}

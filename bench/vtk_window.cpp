// VTK as Debian builds it needs an X display; Xvfb provides one, with Mesa's llvmpipe. VTK draws
// into its own framebuffer, with the samples asked for, not into the window.
#include "bench/vtk_window.h"

#include <vtkAutoInit.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>
#include <vtkWindowToImageFilter.h>

#include <chrono>
#include <sstream>

#include "bench/vtk_scene.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace orthonav::bench {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

class Window final : public VtkWindow {
 public:
  Window(const render::Scene& scene, std::size_t eyes, int width_px, int height_px, int samples)
      : renderers_(eyes), scene_(scene) {
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(samples);
    window_->SetSize(static_cast<int>(eyes) * width_px, height_px);
    for (std::size_t i = 0; i < eyes; ++i) {
      const double fraction = 1.0 / static_cast<double>(eyes);
      const auto at = static_cast<double>(i);
      renderers_[i]->SetViewport(at * fraction, 0, (at + 1) * fraction, 1);
      renderers_[i]->SetBackground(0, 0, 0);
      window_->AddRenderer(renderers_[i]);
    }
  }

  VtkTiming draw(const std::vector<render::View>& views) override {
    if (first_) {
      for (std::size_t i = 0; i < renderers_.size(); ++i) {
        add_scene(scene_, views[i], *renderers_[i]);
      }
      first_ = false;
    }
    const auto start = Clock::now();
    for (std::size_t i = 0; i < renderers_.size(); ++i) {
      set_camera(views[i], *renderers_[i]);
    }
    window_->Render();
    const auto rendered = Clock::now();
    window_->WaitForCompletion();
    const auto finished = Clock::now();
    const int* size = window_->GetSize();
    window_->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels_);
    const auto read = Clock::now();
    return {milliseconds(start, rendered), milliseconds(rendered, finished),
            milliseconds(finished, read), milliseconds(start, read)};
  }

  std::string name() override {
    std::istringstream lines(window_->ReportCapabilities());
    std::string renderer;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("OpenGL renderer string:", 0) == 0) {
        renderer = line.substr(23);
      }
    }
    return std::string(vtkVersion::GetVTKVersion()) + " on" + renderer;
  }

  void save(const std::string& png) override {
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window_);
    image->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(png.c_str());
    writer->SetInputConnection(image->GetOutputPort());
    writer->Write();
  }

 private:
  vtkNew<vtkRenderWindow> window_;
  std::vector<vtkNew<vtkRenderer>> renderers_;
  vtkNew<vtkUnsignedCharArray> pixels_;
  render::Scene scene_;
  bool first_ = true;
};

}  // namespace

std::unique_ptr<VtkWindow> VtkWindow::create(const render::Scene& scene, std::size_t eyes,
                                             int width_px, int height_px, int samples) {
  return std::make_unique<Window>(scene, eyes, width_px, height_px, samples);
}

}  // namespace orthonav::bench

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/scene.h"

namespace orthonav::bench {

/// How the time of one of VTK's frames splits up, in milliseconds of wall time.
struct VtkTiming {
  double render_ms = 0;  ///< vtkRenderWindow::Render: recording and submitting
  double wait_ms = 0;    ///< until the driver has finished
  double read_ms = 0;    ///< pixels into memory
  double total_ms = 0;
};

/// VTK drawing a scene: the same surfaces, tubes where we have wide lines, one renderer per eye,
/// side by side in one window that is not on a screen. The scene never changes, only the cameras
/// do.
class VtkWindow {
 public:
  static std::unique_ptr<VtkWindow> create(const render::Scene& scene, std::size_t eyes,
                                           int width_px, int height_px, int samples);
  virtual ~VtkWindow() = default;
  virtual VtkTiming draw(const std::vector<render::View>& views) = 0;
  /// The GL renderer and VTK's version.
  virtual std::string name() = 0;
  virtual void save(const std::string& png) = 0;
};

}  // namespace orthonav::bench

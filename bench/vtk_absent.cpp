#include "bench/vtk_window.h"

namespace orthonav::bench {

std::unique_ptr<VtkWindow> VtkWindow::create(const render::Scene&, std::size_t, int, int, int) {
  return nullptr;
}

}  // namespace orthonav::bench

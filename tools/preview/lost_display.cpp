#include "tools/preview/lost_display.h"

#include <X11/Xlib.h>

// Declared as in glfw3native.h, which would also need the headers of Xlib's extensions.
extern "C" Display* glfwGetX11Display(void);  // NOLINT(readability-identifier-naming)

namespace orthonav::preview {
namespace {

// Xlib's handlers are per process, so this flag is too.
bool lost = false;

}  // namespace

void watch_display() {
  lost = false;
  Display* display = glfwGetX11Display();
  if (!display) {
    return;
  }
  // The default prints two lines and exits.
  XSetIOErrorHandler([](Display*) { return 0; });
  XSetIOErrorExitHandler(
      display, [](Display*, void*) { lost = true; }, nullptr);
}

bool display_is_lost() { return lost; }

}  // namespace orthonav::preview

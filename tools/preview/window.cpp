#include "tools/preview/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl2.h>
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "tools/preview/look_and_feel.h"
#include "tools/preview/lost_display.h"

namespace orthonav::preview {
namespace {

/// Keys with a character are named after it.
std::optional<Key> key_of_glfw(int key) {
  switch (key) {
    case GLFW_KEY_TAB:
      return Key::kTab;
    case GLFW_KEY_ESCAPE:
      return Key::kEscape;
    case GLFW_KEY_BACKSPACE:
      return Key::kBackspace;
    case GLFW_KEY_LEFT:
      return Key::kLeft;
    case GLFW_KEY_RIGHT:
      return Key::kRight;
    case GLFW_KEY_F10:
      return Key::kF10;
    case GLFW_KEY_F11:
      return Key::kF11;
    case GLFW_KEY_F12:
      return Key::kF12;
    case GLFW_KEY_KP_ADD:
      return key_of('=');
    case GLFW_KEY_KP_SUBTRACT:
      return key_of('-');
    default:
      break;
  }
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) {
    return key_of(static_cast<char>('a' + key - GLFW_KEY_A));
  }
  if (key >= GLFW_KEY_SPACE && key < GLFW_KEY_ESCAPE) {
    return key_of(static_cast<char>(key));
  }
  return std::nullopt;
}

std::string newest_glfw_error(const char* otherwise) {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : otherwise;
}

/// That size, or the part of it that the desktop and a title bar leave.
std::array<int, 2> fitting(int width_px, int height_px) {
  constexpr int kTitleBar_px = 40;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  if (monitor != nullptr) {
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  }
  height -= kTitleBar_px;
  return {width > 0 ? std::min(width, width_px) : width_px,
          height > 0 ? std::min(height, height_px) : height_px};
}

}  // namespace

/// GLFW itself and its one window; destroyed last.
struct Window::Glfw {
  GLFWwindow* window = nullptr;
  bool imgui = false;
  Vec2 cursor{};

  ~Glfw() {
    if (imgui) {
      ImGui_ImplOpenGL2_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    if (window) {
      glfwDestroyWindow(window);
    }
    glfwTerminate();
  }
};

Result<std::unique_ptr<Window>> Window::open(const std::string& title, int width_px, int height_px,
                                             WindowInput input) {
  if (!glfwInit()) {
    return Error{"window: " + newest_glfw_error("no display"), ErrorCode::kUnavailable};
  }
  auto glfw = std::make_unique<Glfw>();
  watch_display();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  const auto [width, height] = fitting(width_px, height_px);
  glfw->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!glfw->window) {
    return Error{"window: " + newest_glfw_error("cannot be opened"), ErrorCode::kUnavailable};
  }
  glfwMakeContextCurrent(glfw->window);
  glfwSwapInterval(1);
  return std::unique_ptr<Window>(new Window(std::move(glfw), std::move(input)));
}

Window::Window(std::unique_ptr<Glfw> glfw, WindowInput input)
    : glfw_(std::move(glfw)), input_(std::move(input)) {
  // Set before Dear ImGui's callbacks, which forward to these.
  watch_input();
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  set_look_and_feel();
  ImGui_ImplGlfw_InitForOpenGL(glfw_->window, true);
  ImGui_ImplOpenGL2_Init();
  glfw_->imgui = true;
  glGenTextures(1, &texture_);
  poll(0.0);
}

/// Handles keys and mouse when Dear ImGui does not want them.
void Window::watch_input() {
  glfwSetWindowUserPointer(glfw_->window, this);
  watch_keys();
  watch_mouse();
}

void Window::watch_keys() {
  GLFWwindow* window = glfw_->window;
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
    const auto known = key_of_glfw(key);
    // A key release always counts, wherever the focus is now.
    const bool ours = action == GLFW_RELEASE || !ImGui::GetIO().WantTextInput;
    if (known && ours && action != GLFW_REPEAT) {
      self->input_.key(*known, action == GLFW_PRESS);
    }
  });
}

void Window::watch_mouse() {
  GLFWwindow* window = glfw_->window;
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
    const Vec2 now{x, y};
    const Vec2 by =
        (1.0 / self->shown_height_px_) * (now - std::exchange(self->glfw_->cursor, now));
    const bool left = glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    const bool other = glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS ||
                       glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS;
    const bool shift = glfwGetKey(w, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
    if (self->input_.move) {
      self->input_.move((1.0 / self->shown_height_px_) * (now - self->shown_from_px_));
    }
    if (self->input_.drag && (left || other) && !ImGui::GetIO().WantCaptureMouse) {
      self->input_.drag(by, other || shift);
    }
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
    const bool down = action == GLFW_PRESS;
    const bool ours = !down || !ImGui::GetIO().WantCaptureMouse;
    if (self->input_.button && button == GLFW_MOUSE_BUTTON_LEFT && ours) {
      self->input_.button(down);
    }
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double steps) {
    auto* self = static_cast<Window*>(glfwGetWindowUserPointer(w));
    if (!ImGui::GetIO().WantCaptureMouse) {
      self->input_.scroll(steps);
    }
  });
}

Window::~Window() {
  if (texture_) {
    glDeleteTextures(1, &texture_);
  }
}

void Window::poll(double wait_s) {
  if (wait_s > 0.0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
  glfwGetFramebufferSize(glfw_->window, &width_px_, &height_px_);
  if (glfwGetWindowAttrib(glfw_->window, GLFW_ICONIFIED)) {
    width_px_ = height_px_ = 0;
  }
}

bool Window::lost() const { return display_is_lost(); }

bool Window::closed() const { return glfwWindowShouldClose(glfw_->window); }

void Window::resize(int width_px, int height_px) {
  glfwSetWindowSize(glfw_->window, width_px, height_px);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(glfw_->window, title.c_str());
}

void Window::upload(const RgbaImage& picture) {
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // Otherwise the upper edge would bleed into the lower one.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, picture.width_px, picture.height_px, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, picture.pixels.data());
  picture_width_px_ = picture.width_px;
  picture_height_px_ = picture.height_px;
}

/// As large as fits, centred.
void Window::place_picture(int panel_px) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const float across = std::max(room.x - static_cast<float>(panel_px), 1.0f);
  if (picture_width_px_ == 0 || room.y < 1.0f) {
    return;
  }
  const auto width = static_cast<float>(picture_width_px_);
  const auto height = static_cast<float>(picture_height_px_);
  const float scale = std::min(across / width, room.y / height);
  const ImVec2 from{std::floor(0.5f * (across - scale * width)),
                    std::floor(0.5f * (room.y - scale * height))};
  const ImVec2 to{from.x + scale * width, from.y + scale * height};
  shown_from_px_ = {static_cast<double>(from.x), static_cast<double>(from.y)};
  shown_height_px_ = std::max(static_cast<double>(scale * height), 1.0);
  const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_));
  ImGui::GetBackgroundDrawList()->AddImage(id, from, to);
}

void Window::draw(int panel_px, const std::function<void()>& panels) {
  if (width_px_ <= 0 || height_px_ <= 0) {
    return;
  }
  ImGui_ImplOpenGL2_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  // If the display disappears in this call, Dear ImGui would end the program because of the size
  // that is left.
  if (lost()) {
    return;
  }
  ImGui::NewFrame();
  place_picture(panel_px);
  panels();
  ImGui::Render();
  glViewport(0, 0, width_px_, height_px_);
  glClearColor(0.06f, 0.07f, 0.08f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
}

void Window::present() {
  if (width_px_ > 0 && height_px_ > 0) {
    glfwSwapBuffers(glfw_->window);
  }
}

RgbaImage Window::screenshot() const {
  RgbaImage image;
  if (width_px_ <= 0 || height_px_ <= 0) {
    return image;
  }
  image.width_px = width_px_;
  image.height_px = height_px_;
  const auto row = 4u * static_cast<std::size_t>(width_px_);
  std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height_px_));
  image.pixels.resize(upside_down.size());
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_px_); ++y) {
    std::memcpy(&image.pixels[y * row], &upside_down[upside_down.size() - (y + 1) * row], row);
  }
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    image.pixels[i] = 255;
  }
  return image;
}

}  // namespace orthonav::preview

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "base/vec.h"
#include "render/renderer.h"
#include "tools/preview/keys.h"

namespace orthonav::preview {

/// Input of keys and mouse over the picture; what the panel handles is not reported. What is not
/// set is not called.
struct WindowInput {
  std::function<void(Key key, bool down)> key;
  /// By this fraction of the picture's height, to the right and down; `pan` with shift or another
  /// button.
  std::function<void(Vec2 by, bool pan)> drag;
  std::function<void(double steps)> scroll;
  /// The mouse is there now: from the upper left of the picture, as fractions of its height.
  std::function<void(Vec2 at)> move;
  /// The left button goes down over the picture, or up anywhere.
  std::function<void(bool down)> button;
};

/// A desktop window with one picture and Dear ImGui on top, by GLFW and OpenGL. Opens no larger
/// than the desktop. Handles any size, including none, and any number of resizes: what can't be
/// seen is not drawn. Main thread only; one window at a time.
class Window {
 public:
  /// An Error when there is no display or no OpenGL.
  static Result<std::unique_ptr<Window>> open(const std::string& title, int width_px, int height_px,
                                              WindowInput input);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Handles pending input, waiting for it no longer than this many seconds.
  void poll(double wait_s);
  [[nodiscard]] bool closed() const;
  /// The display has gone for good.
  [[nodiscard]] bool lost() const;
  void resize(int width_px, int height_px);
  void set_title(const std::string& title);
  /// Shows this picture from now on.
  void upload(const RgbaImage& picture);
  /// Draws the picture to the left of `panel_px`, and the panels that `panels` makes with Dear
  /// ImGui.
  void draw(int panel_px, const std::function<void()>& panels);
  /// What was drawn, until it is presented; empty when nothing can be seen.
  [[nodiscard]] RgbaImage screenshot() const;
  void present();
  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }

 private:
  struct Glfw;
  Window(std::unique_ptr<Glfw> glfw, WindowInput input);
  void watch_input();
  void watch_keys();
  void watch_mouse();
  void place_picture(int panel_px);

  std::unique_ptr<Glfw> glfw_;
  WindowInput input_;
  int width_px_ = 0;  ///< of the framebuffer; 0: nothing can be seen
  int height_px_ = 0;
  int picture_width_px_ = 0;
  int picture_height_px_ = 0;
  unsigned texture_ = 0;
  Vec2 shown_from_px_{};          ///< upper left of the picture in the window
  double shown_height_px_ = 1.0;  ///< of the picture in the window
};

}  // namespace orthonav::preview

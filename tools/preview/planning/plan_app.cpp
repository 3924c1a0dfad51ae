#include "tools/preview/planning/plan_app.h"

#include <filesystem>
#include <utility>

#include "engine/io/folders.h"
#include "engine/io/image_file.h"
#include "tools/preview/panel_parts.h"
#include "tools/preview/planning/plan_script.h"
#include "tools/preview/screenshot.h"

namespace orthonav::preview {
namespace {

namespace fs = std::filesystem;

constexpr double kPictures_hz = 30.0;

}  // namespace

PlanApp::PlanApp(PlanOptions options, std::optional<Script> script, engine::PlanEditor& editor,
                 const engine::Volume* scan)
    : options_(std::move(options)), script_(std::move(script)), scan_(scan), model_(editor) {
  facts_.scan = options_.scan_name;
}

Status PlanApp::open_window() {
  auto view = PlanView::create(options_.width_px, options_.height_px, options_.device);
  if (!view) {
    return view.error();
  }
  view_ = std::move(*view);
  if (scan_) {
    view_->look_at_scan(*scan_);
    model_.set_over_scan(true);
  }
  facts_.device = view_->device().name;
  model_.set_aspect(view_->aspect());
  WindowInput input;
  input.key = [this](Key key, bool down) { model_.key(key, down); };
  input.move = [this](Vec2 at) { model_.move(at); };
  input.button = [this](bool down) { down ? model_.press() : model_.release(); };
  input.scroll = [this](double steps) { model_.scroll(steps); };
  auto window = Window::open("orthonav plan", options_.width_px + kPanel_px, options_.height_px,
                             std::move(input));
  if (!window) {
    return window.error();
  }
  window_ = std::move(*window);
  return {};
}

Status PlanApp::run() {
  const Status watched = watch();
  const Status saved = model_.editor().unsaved() && !discard_ ? save() : Status{};
  if (!watched) {
    return watched;
  }
  if (saved && script_ && !script_->done()) {
    return Error{"script: the window was closed before its end"};
  }
  return saved;
}

Status PlanApp::watch() {
  while (!window_->closed()) {
    if (window_->lost()) {
      return Error{"window: the display has gone", ErrorCode::kLost};
    }
    if (const Status did = run_script(); !did) {
      return did;
    }
    const PlanWishes wishes = model_.take_wishes();
    if (wishes.save) {
      const Status saved = save();
      model_.set_note(saved ? "wrote " + saved_ : saved.error().message);
    }
    discard_ = wishes.discard;
    if (quit_ || wishes.quit || (script_ && script_->done() && wanted_screenshot_.empty())) {
      return {};
    }
    if (wishes.screenshot) {
      wanted_screenshot_ = numbered_name(options_.out, "preview", ".png");
    }
    if (const Status drawn = draw(); !drawn) {
      return drawn;
    }
    window_->present();
    window_->poll(1.0 / kPictures_hz);
  }
  return {};
}

Status PlanApp::run_script() {
  if (!script_) {
    return {};
  }
  ScriptStage stage;
  stage.resize = [this](int width, int height) { window_->resize(width, height); };
  stage.screenshot = [this](const std::string& name) { wanted_screenshot_ = name; };
  return script_->advance([&](const ScriptLine& line) { return perform(line, model_, stage); });
}

Status PlanApp::draw() {
  if (model_.take_changed()) {
    if (const Status drawn = view_->draw(model_); !drawn) {
      return drawn;
    }
    window_->upload(view_->picture());
  }
  const auto panels = [this] { draw_plan_panel(model_, facts_); };
  window_->draw(model_.panel() ? kPanel_px : 0, panels);
  if (!wanted_screenshot_.empty()) {
    // A new panel has its size, and is drawn, the second time.
    window_->draw(model_.panel() ? kPanel_px : 0, panels);
  }
  return wanted_screenshot_.empty() ? Status{}
                                    : take_screenshot(std::exchange(wanted_screenshot_, {}));
}

/// Writes the case as a new folder: whoever planned before keeps their plan.
Status PlanApp::save() {
  const fs::path folder = fs::path(options_.out) / numbered_name(options_.out, "plan", "");
  const auto made = engine::make_folders(folder.string());
  if (!made) {
    return Error{"--out " + made.error().message, made.error().code};
  }
  const Status saved = model_.editor().save(folder.string());
  if (saved) {
    saved_ = folder.string();
  } else {
    engine::remove_empty(*made);
  }
  return saved;
}

/// A script that gets no picture has failed; a person reads the reason.
Status PlanApp::take_screenshot(const std::string& name) {
  const fs::path path = png_path(options_.out, name);
  const Status taken = write_screenshot(*window_, path);
  model_.set_note(taken ? "wrote " + path.string() : taken.error().message);
  return script_ ? taken : Status{};
}

}  // namespace orthonav::preview

#include "tools/preview/preview_app.h"

#include <utility>

#include "tools/preview/panel_parts.h"

namespace orthonav::preview {
namespace {

constexpr double kPictures_hz = 30.0;
constexpr const char* kReplay = "replay:";

bool is_replay(const std::string& uri) { return uri.rfind(kReplay, 0) == 0; }

}  // namespace

PreviewApp::PreviewApp(PreviewOptions options, std::optional<Script> script)
    : options_(std::move(options)), script_(std::move(script)) {
  gate_.pause(options_.paused);
  gate_.set_speed(options_.speed);
}

Status PreviewApp::open_window() {
  auto stage = StageView::create(options_.stage);
  if (!stage) {
    return stage.error();
  }
  stage_ = std::move(*stage);
  WindowInput input;
  input.key = [this](Key key, bool down) { model_.key(key, down); };
  input.drag = [this](Vec2 by, bool pan) {
    pan ? model_.look().camera.pan(by) : model_.look().camera.orbit(by);
  };
  input.scroll = [this](double steps) { model_.look().camera.zoom(steps); };
  auto window = Window::open("orthonav preview", options_.stage.width_px + kPanel_px,
                             options_.stage.height_px, std::move(input));
  if (!window) {
    return window.error();
  }
  window_ = std::move(*window);
  facts_.device = stage_->device().name;
  facts_.note = "preparing the models";
  window_->draw(kPanel_px, [this] { draw_panel(model_, facts_, error_model_); });
  window_->present();
  return {};
}

Status PreviewApp::open_operation(OperationSource source) {
  source_ = std::move(source);
  if (const Status started = start_operation(); !started) {
    return started;
  }
  if (operation_->room()) {
    // What the URI asks for is kept for every later start.
    options_.room = operation_->room()->options();
    source_.headset = "sim:";
    error_model_ = running_ = options_.room.error_model;
    facts_.running = &running_;
    stage_->look_at_room(*operation_->room());
  } else if (is_replay(source_.headset)) {
    auto images = RecordedImages::open(source_.headset.substr(std::string(kReplay).size()));
    if (!images) {
      return images.error();
    }
    facts_.pairs = images->pairs();
    stage_->look_at_recording(std::move(*images));
  }
  facts_.headset = operation_->name();
  return {};
}

Status PreviewApp::start_operation() {
  operation_.reset();
  timeline_.clear();
  gate_.restart();
  model_.restarted();
  drawn_.reset();
  facts_.moment.reset();
  facts_.ended = false;
  facts_.note.clear();
  auto operation = LiveOperation::open(source_, options_.room, gate_, keyboard_, timeline_);
  if (!operation) {
    return operation.error();
  }
  operation_ = std::move(*operation);
  // One pair, so that there is something to see.
  gate_.step();
  operation_->start();
  return {};
}

Status PreviewApp::run() {
  counted_since_ = wall_.now();
  const Status watched = watch();
  // However it ended, the recorded video is kept.
  const Status stopped = stop_video();
  if (!watched) {
    return watched;
  }
  if (!stopped) {
    return stopped;
  }
  if (script_ && !script_->done()) {
    return Error{"script: the window was closed before its end"};
  }
  return operation_->ended() ? operation_->outcome() : Status{};
}

Status PreviewApp::watch() {
  while (!window_->closed()) {
    const Timestamp begun = wall_.now();
    if (window_->lost()) {
      return Error{"window: the display has gone", ErrorCode::kLost};
    }
    if (const Status did = run_script(); !did) {
      return did;
    }
    const Wishes wishes = model_.take_wishes();
    if (quit_ || wishes.quit || (script_ && script_->done() && wanted_screenshot_.empty())) {
      return {};
    }
    if (const Status granted = grant(wishes); !granted) {
      return granted;
    }
    if (const Status shown = show_moment(); !shown) {
      return shown;
    }
    window_->draw(model_.panel() ? kPanel_px : 0,
                  [this] { draw_panel(model_, facts_, error_model_); });
    if (!wanted_screenshot_.empty()) {
      if (const Status taken = take_screenshot(std::exchange(wanted_screenshot_, {})); !taken) {
        return taken;
      }
    }
    window_->present();
    count_pictures();
    window_->poll(1.0 / kPictures_hz - seconds(wall_.now() - begun));
  }
  return {};
}

Status PreviewApp::run_script() {
  if (!script_) {
    return {};
  }
  ScriptStage stage;
  stage.resize = [this](int width, int height) { window_->resize(width, height); };
  stage.screenshot = [this](const std::string& name) { wanted_screenshot_ = name; };
  return script_->advance(model_, stage, wall_.now(), operation_->ended());
}

/// The title names the step, so that it can be read from a list of windows, and by programs that
/// drive the window.
void PreviewApp::set_title(const Moment& moment) {
  if (facts_.moment && facts_.moment->at == moment.at) {
    return;
  }
  window_->set_title("orthonav preview: " + engine::name_of(moment.at));
}

Status PreviewApp::show_moment() {
  if (operation_->ended() && !std::exchange(facts_.ended, true)) {
    facts_.note =
        operation_->outcome() ? "the operation has ended" : operation_->outcome().error().message;
  }
  const auto moment = model_.shown();
  if (!moment) {
    return {};
  }
  model_.seen_from(stage_->eye_of(*moment));
  if (moment == drawn_ && model_.look() == drawn_look_) {
    return {};
  }
  if (const Status drawn = stage_->draw(*moment, model_.look()); !drawn) {
    return drawn;
  }
  set_title(*moment);
  drawn_ = facts_.moment = moment;
  drawn_look_ = model_.look();
  facts_.background_ms = stage_->background_ms();
  facts_.holograms_ms = stage_->holograms_ms();
  window_->upload(stage_->picture());
  if (!video_) {
    return {};
  }
  frame_.width_px = stage_->picture().width_px;
  frame_.height_px = stage_->picture().height_px;
  frame_.pixels = stage_->picture().pixels;
  return video_->write(frame_);
}

/// Problems with a screenshot or a video are reported in the panel; the preview continues.
Status PreviewApp::grant(const Wishes& wishes) {
  if (wishes.screenshot) {
    wanted_screenshot_ = next_name(".png");
  }
  if (wishes.video) {
    if (const Status toggled = toggle_video(); !toggled) {
      facts_.note = toggled.error().message;
    }
  }
  return wishes.restart ? start_again() : Status{};
}

/// With the error sources as set; if no room can be made with them, with the previous ones.
Status PreviewApp::start_again() {
  options_.room.error_model = error_model_;
  if (const Status started = start_operation(); !started) {
    options_.room.error_model = running_;
    if (const Status restored = start_operation(); !restored) {
      return restored;
    }
    facts_.note = started.error().message;
  }
  running_ = options_.room.error_model;
  if (operation_->room()) {
    stage_->look_at_room(*operation_->room());
  }
  return {};
}

void PreviewApp::count_pictures() {
  ++counted_;
  const double passed_s = seconds(wall_.now() - counted_since_);
  if (passed_s < 0.5) {
    return;
  }
  facts_.pictures_a_second = counted_ / passed_s;
  counted_ = 0;
  counted_since_ = wall_.now();
}

}  // namespace orthonav::preview

#include "engine/live/presenter.h"

#include <chrono>
#include <utility>

#include "base/guarded.h"
#include "base/stopwatch.h"
#include "engine/holograms/scene_builder.h"

namespace orthonav::engine {
namespace {

/// How long to wait before asking again while the display is not in use.
constexpr auto kIdlePause = std::chrono::milliseconds(5);
/// How long to wait for a runtime to end a session.
constexpr auto kLongestGoodbye = std::chrono::seconds(2);
// More would not add information.
constexpr std::size_t kMaxProblems = 20;

}  // namespace

Result<std::unique_ptr<Presenter>> Presenter::start(PixelDisplay& display,
                                                    PresenterOptions options) {
  std::unique_ptr<Presenter> presenter(new Presenter(display, std::move(options)));
  auto renderer = DisplayRenderer::start(display, presenter->options_.renderer);
  if (!renderer) {
    return renderer.error();
  }
  presenter->renderer_ = std::move(*renderer);
  presenter->thread_ = std::thread([raw = presenter.get()] {
    const Status died = guarded("renderer", [raw] { raw->run(); });
    {
      const MutexLock lock(raw->mutex_);
      raw->died_ = died;
    }
    static_cast<void>(guarded("renderer", [raw] { raw->leave(); }));
  });
  return presenter;
}

Presenter::~Presenter() { stop(); }

PresentReport Presenter::stop() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
  const MutexLock lock(mutex_);
  return report_;
}

Status Presenter::draw(const Snapshot& snapshot) {
  const MutexLock lock(mutex_);
  incoming_ = snapshot;
  fresh_ = true;
  if (!died_) {
    return died_;
  }
  if (untold_.empty()) {
    return {};
  }
  return Error{std::exchange(untold_, {})};
}

void Presenter::note(const std::string& problem) {
  const MutexLock lock(mutex_);
  untold_ = problem;
  if (report_.problems.size() < kMaxProblems) {
    report_.problems.push_back(problem);
  }
}

void Presenter::lose(const std::string& why) {
  note(why);
  renderer_.reset();
  panel_draws_ = 0;
  const MutexLock lock(mutex_);
  gaze_.reset();
  ++report_.losses;
}

void Presenter::pause(Duration wall_time) {
  const Stopwatch paused;
  const MutexLock lock(mutex_);
  while (!stopping_ && changed_.wait_until(mutex_, paused.after(wall_time))) {
  }
}

void Presenter::run() {
  for (;;) {
    {
      const MutexLock lock(mutex_);
      if (stopping_) {
        break;
      }
    }
    if (over_) {
      pause(std::chrono::seconds(1));
    } else if (renderer_) {
      next_frame();
    } else {
      look_again();
    }
  }
}

void Presenter::next_frame() {
  const Working working(beats_ ? &*beats_ : nullptr, Part::kRenderer);
  const Stopwatch waiting;
  const DisplayFrame frame = display_.begin_frame();
  switch (frame.kind) {
    case DisplayFrame::Kind::kFrame:
      present(frame, waiting.elapsed_ms());
      return;
    case DisplayFrame::Kind::kIdle:
      pause(kIdlePause);
      return;
    case DisplayFrame::Kind::kLost:
      lose(frame.why);
      return;
    case DisplayFrame::Kind::kOver:
      note(frame.why);
      renderer_.reset();
      over_ = true;
      if (options_.on_over) {
        options_.on_over();
      }
      return;
  }
}

/// A frame that was begun is always ended, drawn or not.
void Presenter::present(const DisplayFrame& frame, double waited_ms) {
  const Stopwatch begun;
  const bool drawn = draw_scene(frame);
  const Stopwatch submitting;
  const Status finished = renderer_->end_frame();
  const bool late = drawn && begun.elapsed() > frame.ahead;
  if (!finished) {
    note(finished.error().message);
  }
  {
    const MutexLock lock(mutex_);
    ++report_.frames;
    report_.drawn += drawn && finished ? 1 : 0;
    report_.failures += finished ? 0 : 1;
    report_.late += late ? 1 : 0;
    report_.missed += frame.missed;
    report_.period = frame.period;
    report_.wait_ms.add(waited_ms);
    report_.submit_ms.add(submitting.elapsed_ms());
    gaze_ = renderer_->gaze();
  }
  note_panel();
  if (renderer_->renderer().lost()) {
    lose("the display's graphics device is lost");
  }
}

/// If the panel fails, the frame does not: it still shows the status line.
void Presenter::note_panel() {
  const StatusPanel& panel = renderer_->panel();
  const MutexLock lock(mutex_);
  report_.panel_draws += panel.drawn() - std::exchange(panel_draws_, panel.drawn());
  if (panel.problem() != panel_problem_) {
    panel_problem_ = panel.problem();
    if (!panel_problem_.empty() && report_.problems.size() < kMaxProblems) {
      report_.problems.push_back("status line not on its panel: " + panel_problem_);
    }
  }
}

std::optional<Gaze> Presenter::gaze() const {
  const MutexLock lock(mutex_);
  return gaze_;
}

/// Labels are laid out for the eyes of the frame before: by the time that this frame's are known it
/// must be drawn, and a head hardly moves from one frame to the next.
void Presenter::take_newest() {
  {
    const MutexLock lock(mutex_);
    if (!std::exchange(fresh_, false)) {
      return;
    }
    std::swap(shown_, incoming_);
    has_snapshot_ = true;
  }
  if (renderer_->head_located()) {
    labels_.lay_out(shown_.scene, renderer_->views(), shown_.patches, shown_.display_time);
  }
}

bool Presenter::draw_scene(const DisplayFrame& frame) {
  take_newest();
  if (!frame.draw || !has_snapshot_) {
    return false;
  }
  // Checked for every frame: the tracking thread may have stalled since the snapshot.
  if (shown_.expires && frame.display_time > *shown_.expires) {
    hide_tool_guidance(shown_.scene);
    shown_.expires.reset();
    const MutexLock lock(mutex_);
    ++report_.hidden;
  }
  const auto drawn = renderer_->draw(shown_.scene);
  if (!drawn) {
    note(drawn.error().message);
    const MutexLock lock(mutex_);
    ++report_.failures;
    return false;
  }
  if (!*drawn) {
    return false;
  }
  if (options_.on_drawn) {
    options_.on_drawn(renderer_->drawn(), renderer_->views());
  }
  const MutexLock lock(mutex_);
  report_.latch_ms.add(renderer_->renderer().last_timing().total_ms);
  return true;
}

void Presenter::look_again() {
  auto renderer = DisplayRenderer::start(display_, options_.renderer);
  if (renderer) {
    renderer_ = std::move(*renderer);
    return;
  }
  display_.close();
  pause(options_.look_again_after);
}

/// Ends the session in order, as long as the runtime cooperates.
void Presenter::leave() {
  if (!renderer_) {
    return;
  }
  display_.ask_to_end();
  const Stopwatch asked;
  while (asked.elapsed() < kLongestGoodbye) {
    const DisplayFrame frame = display_.begin_frame();
    if (frame.kind == DisplayFrame::Kind::kLost || frame.kind == DisplayFrame::Kind::kOver) {
      break;
    }
    if (frame.kind == DisplayFrame::Kind::kFrame) {
      static_cast<void>(display_.end_frame({}));
    } else {
      std::this_thread::sleep_for(kIdlePause);
    }
  }
  renderer_.reset();
}

}  // namespace orthonav::engine

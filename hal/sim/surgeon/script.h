#pragma once

#include <coroutine>
#include <exception>
#include <utility>

namespace orthonav::sim {

/// Behaviour written from top to bottom, as a coroutine: it runs until it awaits the next tick, and
/// continues there. Scripts can await scripts. Single-threaded. Trap: a script keeps arguments
/// passed by reference as references; pass only objects that outlive it.
class [[nodiscard]] Script {
 public:
  struct promise_type;
  using Handle = std::coroutine_handle<promise_type>;

  struct BackToCaller {
    [[nodiscard]] bool await_ready() const noexcept { return false; }
    std::coroutine_handle<> await_suspend(Handle finished) const noexcept;
    void await_resume() const noexcept {}
  };

  struct promise_type {
    std::coroutine_handle<> caller;
    Script get_return_object() { return Script(Handle::from_promise(*this)); }
    std::suspend_always initial_suspend() noexcept { return {}; }
    BackToCaller final_suspend() noexcept { return {}; }
    void return_void() {}
    // Scripts throw nothing; running out of memory ends the program as everywhere else.
    void unhandled_exception() { std::terminate(); }
  };

  Script(Script&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  Script& operator=(Script&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Script() {
    if (handle_) {
      handle_.destroy();
    }
  }

  void start() { handle_.resume(); }
  [[nodiscard]] bool done() const { return handle_.done(); }

  [[nodiscard]] bool await_ready() const noexcept { return false; }
  std::coroutine_handle<> await_suspend(std::coroutine_handle<> caller) noexcept {
    handle_.promise().caller = caller;
    return handle_;
  }
  void await_resume() const noexcept {}

 private:
  explicit Script(Handle handle) : handle_(handle) {}
  Handle handle_;
};

inline std::coroutine_handle<> Script::BackToCaller::await_suspend(Handle finished) const noexcept {
  if (finished.promise().caller) {
    return finished.promise().caller;
  }
  return std::noop_coroutine();
}

/// Where a running script waits for the next tick.
class Metronome {
 public:
  struct NextTick {
    Metronome& metronome;
    [[nodiscard]] bool await_ready() const noexcept { return false; }
    void await_suspend(std::coroutine_handle<> waiting) noexcept { metronome.waiting_ = waiting; }
    void await_resume() const noexcept {}
  };
  [[nodiscard]] NextTick next_tick() { return {*this}; }
  /// Resumes the waiting script until its next wait; does nothing when none waits.
  void tick() {
    if (const auto waiting = std::exchange(waiting_, nullptr)) {
      waiting.resume();
    }
  }

 private:
  std::coroutine_handle<> waiting_;
};

}  // namespace orthonav::sim

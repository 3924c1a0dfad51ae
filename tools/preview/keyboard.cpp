#include "tools/preview/keyboard.h"

#include <utility>

namespace orthonav::preview {

void Keyboard::button(bool down) {
  const MutexLock lock(mutex_);
  downs_.push_back(down);
}

void Keyboard::say(std::string phrase) {
  const MutexLock lock(mutex_);
  phrases_.push_back(std::move(phrase));
}

void Keyboard::mute(bool muted) {
  const MutexLock lock(mutex_);
  muted_ = muted;
}

bool Keyboard::muted() const {
  const MutexLock lock(mutex_);
  return muted_;
}

void Keyboard::take_button(std::vector<bool>& downs) {
  const MutexLock lock(mutex_);
  downs.insert(downs.end(), downs_.begin(), downs_.end());
  downs_.clear();
}

void Keyboard::take_phrases(std::vector<std::string>& phrases) {
  const MutexLock lock(mutex_);
  for (std::string& phrase : phrases_) {
    phrases.push_back(std::move(phrase));
  }
  phrases_.clear();
}

Status SharedClicker::do_poll(Timestamp until, std::vector<ClickerEvent>& events) {
  offered_.clear();
  if (const Status status = inner_.poll(until, offered_); !status) {
    return status;
  }
  const bool muted = keyboard_.muted();
  for (const ClickerEvent& event : offered_) {
    if (!muted || event.action != ClickerAction::kPress) {
      button_.offer(SharedButton::Hand::kFirst, event, events);
    }
  }
  offered_.clear();
  downs_.clear();
  keyboard_.take_button(downs_);
  timer_.advance(until, offered_);
  for (const bool down : downs_) {
    timer_.button(down, until, offered_);
  }
  for (const ClickerEvent& event : offered_) {
    button_.offer(SharedButton::Hand::kSecond, {event.action, until}, events);
  }
  return {};
}

Status SharedVoice::do_poll(Timestamp until, std::vector<Phrase>& phrases) {
  const std::size_t before = phrases.size();
  if (const Status status = inner_.poll(until, phrases); !status) {
    return status;
  }
  if (keyboard_.muted()) {
    phrases.resize(before);
  }
  typed_.clear();
  keyboard_.take_phrases(typed_);
  for (std::string& text : typed_) {
    phrases.push_back({std::move(text), 1.0, until});
  }
  return {};
}

}  // namespace orthonav::preview

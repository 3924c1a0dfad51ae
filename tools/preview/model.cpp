#include "tools/preview/model.h"

#include <algorithm>
#include <array>
#include <string>

namespace orthonav::preview {
namespace {

/// From slow to fast; the last means as fast as possible.
constexpr std::array<double, 6> kSpeeds = {0.1, 0.25, 0.5, 1.0, 4.0, 0.0};

void flip(bool& choice) { choice = !choice; }

void wish(Command command, Wishes& wishes) {
  wishes.screenshot = wishes.screenshot || command == Command::kScreenshot;
  wishes.video = wishes.video != (command == Command::kVideo);
  wishes.restart = wishes.restart || command == Command::kRestart;
  wishes.quit = wishes.quit || command == Command::kQuit;
}

}  // namespace

void PreviewModel::key(Key key, bool down) {
  const KeyBinding* binding = binding_of(key);
  if (!binding) {
    return;
  }
  if (binding->command == Command::kClicker) {
    if (std::exchange(clicker_down_, down) != down) {
      keyboard_.button(down);
    }
  } else if (down) {
    obey(*binding);
  }
}

void PreviewModel::obey(const KeyBinding& binding) {
  switch (binding.command) {
    case Command::kClicker:
      break;
    case Command::kSay:
      return keyboard_.say(std::string(binding.what));
    case Command::kMute:
      return mute(!keyboard_.muted());
    case Command::kPause:
      return pause(!gate_.paused());
    case Command::kBack:
      return step_back();
    case Command::kForward:
      return step_on();
    case Command::kLive:
      return live();
    case Command::kSlower:
    case Command::kFaster:
      return change_speed(binding.command == Command::kFaster);
    case Command::kOrbit:
      return orbit(!look_.camera.orbits());
    case Command::kHologram:
      return look_.holograms.toggle(binding.hologram);
    case Command::kAllHolograms:
      return look_.holograms.toggle_all();
    case Command::kTools:
      return flip(look_.tools);
    case Command::kPanel:
      return flip(panel_);
    case Command::kHelp:
      return flip(help_);
    case Command::kScreenshot:
    case Command::kVideo:
    case Command::kRestart:
    case Command::kQuit:
      return wish(binding.command, wishes_);
  }
}

void PreviewModel::say(const std::string& phrase) {
  if (!phrase.empty()) {
    keyboard_.say(phrase);
  }
}

void PreviewModel::pause(bool paused) {
  gate_.pause(paused);
  if (!paused) {
    live();
  }
}

void PreviewModel::step_on() {
  if (!gate_.paused()) {
    return pause(true);
  }
  if (!looked_at_) {
    return gate_.step();
  }
  looked_at_ = timeline_.after(looked_at_->pair);
  if (looked_at_ == timeline_.newest()) {
    live();
  }
}

void PreviewModel::step_back() {
  const auto now = shown();
  gate_.pause(true);
  if (now) {
    looked_at_ = timeline_.before(now->pair);
  }
}

void PreviewModel::scrub_to(std::int64_t pair) {
  gate_.pause(true);
  const auto newest = timeline_.newest();
  if (!newest || pair > newest->pair) {
    gate_.run_to(pair);
    live();
  } else {
    looked_at_ = timeline_.at(pair);
  }
}

void PreviewModel::change_speed(bool faster) {
  const auto now = std::find(kSpeeds.begin(), kSpeeds.end(), gate_.speed());
  const auto index = now == kSpeeds.end() ? std::size_t{3} : std::size_t(now - kSpeeds.begin());
  const std::size_t next =
      faster ? std::min(index + 1, kSpeeds.size() - 1) : std::max(index, std::size_t{1}) - 1;
  gate_.set_speed(kSpeeds[next]);
}

void PreviewModel::orbit(bool orbits) {
  if (orbits) {
    look_.camera.start_orbit(eye_);
  } else {
    look_.camera.end_orbit();
  }
}

std::shared_ptr<const Moment> PreviewModel::shown() const {
  return looked_at_ ? looked_at_ : timeline_.newest();
}

bool PreviewModel::looks_back() const { return looked_at_ && looked_at_ != timeline_.newest(); }

bool PreviewModel::at_rest() const {
  const auto newest = timeline_.newest();
  return gate_.paused() && gate_.at_rest() && newest && newest->pair == gate_.passed();
}

}  // namespace orthonav::preview

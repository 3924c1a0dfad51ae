#pragma once

#include <array>
#include <variant>

#include "tests/support/scripted_operation.h"

namespace orthonav::test {

/// The course of the operation.
enum class Story {
  kPlain,
  /// The second level's first registration is refused; the first level's right screw is moved
  /// before it is drilled; the second level's left wire is redone, and its right one kept beyond
  /// the limit.
  kEventful
};

/// Does the next thing that the session asks for, whatever was done before, so a resumed operation
/// continues by the same rules. Registrations are verified by touch.
class ScriptedSurgeon {
 public:
  /// Each stroke takes this many pairs.
  explicit ScriptedSurgeon(ScriptedOperation& operation, int stroke = 5,
                           Story story = Story::kPlain)
      : s_(operation), stroke_(stroke), eventful_(story == Story::kEventful) {
    s_.pair();
  }

  /// Does one thing; false once the operation is done.
  bool act() {
    switch (s_.session().current_step()) {
      case engine::Step::kSetup:
        s_.tracker().pointer = pointer_at(kOnBone);
        s_.says("start");
        return true;
      case engine::Step::kDigitize:
        return digitize();
      case engine::Step::kVerify:
        return verify();
      case engine::Step::kTouchLandmark:
        return touch_landmark();
      case engine::Step::kGuide:
        if (is_to_be_moved()) {
          s_.says("move cranial one");
          return true;
        }
        s_.tracker().guide = guide_at(entry() - Vec3{0, 0.030, 0}, 0.01);
        s_.pairs(3);
        s_.says("next");
        return true;
      case engine::Step::kMeasureWire:
        return measure();
      case engine::Step::kRod:
        return touch_heads();
      case engine::Step::kRegistering:
        s_.pair();
        return true;
      case engine::Step::kDone:
        return false;
    }
    return false;
  }
  /// Goes on to the end; returns how many things it took.
  int finish() {
    int acts = 0;
    while (acts < kMaxActs && act()) {
      ++acts;
    }
    return acts;
  }
  static constexpr int kMaxActs = 500;

 private:
  static constexpr Vec3 kOnBone{0, 0.02, 0};

  [[nodiscard]] const engine::LevelState& level() {
    return s_.session().levels()[s_.shown().level];
  }
  [[nodiscard]] std::size_t screw() { return level().open_screw().value_or(0); }
  [[nodiscard]] Vec3 entry() { return level().plan.screws[screw()].entry.v; }
  [[nodiscard]] bool is_second_level() { return eventful_ && s_.shown().level == 1; }
  [[nodiscard]] bool is_to_be_moved() {
    return eventful_ && s_.shown().level == 0 && screw() == 1 && !level().screws[1].replanned();
  }
  [[nodiscard]] bool is_to_be_redone() {
    return is_second_level() && screw() == 0 && level().screws[0].redone == 0;
  }

  bool digitize() {
    std::size_t saved = 0;
    for (const nav::Region& region : s_.shown().regions) {
      saved += region.saved ? 1 : 0;
    }
    if (saved < 2) {
      s_.tracker().pointer = pointer_at(kOnBone + Vec3{0.01 * static_cast<double>(saved), 0, 0});
      s_.strokes(stroke_);
      s_.says("save");
    } else {
      s_.unusable.reset();
      if (is_second_level() && level().attempts == 0) {
        s_.unusable = "too few places";
      }
      s_.does({ClickerAction::kDoubleClick});
    }
    return true;
  }

  bool verify() {
    constexpr std::array<Vec3, 3> kPlaces = {Vec3{-0.015, 0.020, -0.010},
                                             Vec3{0.015, 0.020, -0.010}, Vec3{0.000, 0.020, 0.012}};
    const std::size_t touched = level().check_points.size();
    if (touched < kPlaces.size()) {
      s_.touches(kPlaces[touched]);
    } else {
      s_.accepts();
    }
    return true;
  }

  bool touch_landmark() {
    const auto* so_far = std::get_if<engine::LandmarkSoFar>(&s_.shown().status.state);
    if (so_far != nullptr && (!so_far->last || so_far->last->missing > 0)) {
      s_.touches(ScriptedOperation::kLandmark);
    } else if (s_.says("next").step == engine::Step::kTouchLandmark) {
      s_.touches(ScriptedOperation::kLandmark);  // a screw is redone
    }
    return true;
  }

  bool measure() {
    if (const engine::PlacedWire* wire = s_.shown().wire) {
      const bool stays = wire->within() || wire->kept;
      s_.says(stays ? "next" : is_to_be_redone() ? "delete" : "accept");
      return true;
    }
    const bool beyond = is_to_be_redone() || (is_second_level() && screw() == 1);
    s_.tracker().guide = guide_at(entry() + Vec3{beyond ? 0.003 : 0.0004, 0.004, 0}, 0.0);
    s_.does({ClickerAction::kPress});
    s_.pair();
    s_.does({ClickerAction::kRelease, ClickerAction::kClick});
    if (s_.pair().wire == nullptr) {
      s_.says("next");
    }
    return true;
  }

  bool touch_heads() {
    const engine::RodState* open = nullptr;
    for (const engine::RodState& rod : s_.session().rods()) {
      open = open == nullptr && !rod.done ? &rod : open;
    }
    const std::size_t heads = open != nullptr ? open->heads.size() : 0;
    if (heads < 2) {
      s_.touches({0.02, 0.03, 0.04 * static_cast<double>(heads)});
    } else {
      s_.says("done");
    }
    return true;
  }

  ScriptedOperation& s_;
  int stroke_;
  bool eventful_;
};

}  // namespace orthonav::test

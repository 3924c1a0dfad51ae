#pragma once

#include <utility>
#include <vector>

#include "engine/session/session_observer.h"

namespace orthonav::engine {

/// Passes what it hears on to others, in the order in which they were added. Borrowed, not owned.
class ObserverList : public SessionObserver {
 public:
  ObserverList() = default;
  explicit ObserverList(std::vector<SessionObserver*> observers)
      : observers_(std::move(observers)) {}
  void add(SessionObserver* observer) {
    if (observer) {
      observers_.push_back(observer);
    }
  }

  void happened(Timestamp time, Step from, Event event, Cell answer) override {
    for (auto* o : observers_) {
      o->happened(time, from, event, answer);
    }
  }
  void not_understood(const Phrase& phrase) override {
    for (auto* o : observers_) {
      o->not_understood(phrase);
    }
  }
  void region_saved(Timestamp time, const LevelState& level, const nav::Region& region) override {
    for (auto* o : observers_) {
      o->region_saved(time, level, region);
    }
  }
  void region_dropped(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->region_dropped(time, level);
    }
  }
  void level_cleared(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->level_cleared(time, level);
    }
  }
  void acceptance_withdrawn(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->acceptance_withdrawn(time, level);
    }
  }
  void places_forgotten(Timestamp time) override {
    for (auto* o : observers_) {
      o->places_forgotten(time);
    }
  }
  void references_placed(Timestamp time, std::span<const nav::ReferencePlace> places) override {
    for (auto* o : observers_) {
      o->references_placed(time, places);
    }
  }
  void accepted_as_shown(Timestamp time, const LevelState& level, std::string_view shown) override {
    for (auto* o : observers_) {
      o->accepted_as_shown(time, level, shown);
    }
  }
  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override {
    for (auto* o : observers_) {
      o->registered(time, level, outcome);
    }
  }
  void check_point_recorded(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->check_point_recorded(time, level);
    }
  }
  void check_point_dropped(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->check_point_dropped(time, level);
    }
  }
  void accepted(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->accepted(time, level);
    }
  }
  void landmark_touched(Timestamp time, const LevelState& level,
                        const LandmarkTouch& touch) override {
    for (auto* o : observers_) {
      o->landmark_touched(time, level, touch);
    }
  }
  void axis_compared(Timestamp time, const AxisDifference& difference) override {
    for (auto* o : observers_) {
      o->axis_compared(time, difference);
    }
  }
  void tips_compared(Timestamp time, const TipDifference& difference) override {
    for (auto* o : observers_) {
      o->tips_compared(time, difference);
    }
  }
  void landmark_dropped(Timestamp time, const LevelState& level) override {
    for (auto* o : observers_) {
      o->landmark_dropped(time, level);
    }
  }
  void wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                     const PlacedWire& wire) override {
    for (auto* o : observers_) {
      o->wire_measured(time, level, screw, wire);
    }
  }
  void screw_redone(Timestamp time, const LevelState& level, std::size_t screw,
                    const nav::OtherEntry& entry) override {
    for (auto* o : observers_) {
      o->screw_redone(time, level, screw, entry);
    }
  }
  void replanned(Timestamp time, const LevelState& level, const Replan& asked,
                 const ScrewReplanned& done) override {
    for (auto* o : observers_) {
      o->replanned(time, level, asked, done);
    }
  }
  void screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                  const ToolGuidance* at_depth) override {
    for (auto* o : observers_) {
      o->screw_done(time, level, screw, at_depth);
    }
  }
  void calibration_found(Timestamp time, const CalibrationInUse& found) override {
    for (auto* o : observers_) {
      o->calibration_found(time, found);
    }
  }
  void head_recorded(Timestamp time, nav::Side side, Point<World> head) override {
    for (auto* o : observers_) {
      o->head_recorded(time, side, head);
    }
  }
  void head_dropped(Timestamp time, nav::Side side) override {
    for (auto* o : observers_) {
      o->head_dropped(time, side);
    }
  }
  void rod_done(Timestamp time, const RodState& rod) override {
    for (auto* o : observers_) {
      o->rod_done(time, rod);
    }
  }

 private:
  std::vector<SessionObserver*> observers_;
};

}  // namespace orthonav::engine

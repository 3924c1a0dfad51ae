#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "engine/session/log/session_observer.h"

namespace orthonav::engine {

/// Forwards each event to several observers, in the order in which they were added. Borrowed, not
/// owned.
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
    tell(&SessionObserver::happened, time, from, event, answer);
  }
  void asked_from_outside(const Request& request) override {
    tell(&SessionObserver::asked_from_outside, request);
  }
  void request_answered(const Request& request, bool taken, const Message* why_not) override {
    tell(&SessionObserver::request_answered, request, taken, why_not);
  }
  void not_understood(const Phrase& phrase) override {
    tell(&SessionObserver::not_understood, phrase);
  }
  void region_saved(Timestamp time, const LevelState& level, const nav::Region& region) override {
    tell(&SessionObserver::region_saved, time, level, region);
  }
  void region_dropped(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::region_dropped, time, level);
  }
  void level_cleared(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::level_cleared, time, level);
  }
  void acceptance_withdrawn(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::acceptance_withdrawn, time, level);
  }
  void places_forgotten(Timestamp time) override { tell(&SessionObserver::places_forgotten, time); }
  void references_placed(Timestamp time, std::span<const nav::ReferencePlace> places) override {
    tell(&SessionObserver::references_placed, time, places);
  }
  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override {
    tell(&SessionObserver::registered, time, level, outcome);
  }
  void registration_restored(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::registration_restored, time, level);
  }
  void check_point_recorded(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::check_point_recorded, time, level);
  }
  void check_point_dropped(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::check_point_dropped, time, level);
  }
  void accepted(Timestamp time, const LevelState& level, std::string_view shown) override {
    tell(&SessionObserver::accepted, time, level, shown);
  }
  void landmark_touched(Timestamp time, const LevelState& level,
                        const LandmarkTouch& touch) override {
    tell(&SessionObserver::landmark_touched, time, level, touch);
  }
  void axis_compared(Timestamp time, const AxisDifference& difference) override {
    tell(&SessionObserver::axis_compared, time, difference);
  }
  void tips_compared(Timestamp time, const TipDifference& difference) override {
    tell(&SessionObserver::tips_compared, time, difference);
  }
  void landmark_dropped(Timestamp time, const LevelState& level) override {
    tell(&SessionObserver::landmark_dropped, time, level);
  }
  void wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                     const PlacedWire& wire) override {
    tell(&SessionObserver::wire_measured, time, level, screw, wire);
  }
  void screw_redone(Timestamp time, const LevelState& level, std::size_t screw,
                    const nav::OtherEntry& entry) override {
    tell(&SessionObserver::screw_redone, time, level, screw, entry);
  }
  void replanned(Timestamp time, const LevelState& level, const Replan& asked,
                 const ScrewReplanned& done) override {
    tell(&SessionObserver::replanned, time, level, asked, done);
  }
  void screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                  const ToolGuidance* at_depth) override {
    tell(&SessionObserver::screw_done, time, level, screw, at_depth);
  }
  void calibration_found(Timestamp time, const CalibrationInUse& found) override {
    tell(&SessionObserver::calibration_found, time, found);
  }
  void head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) override {
    tell(&SessionObserver::head_recorded, time, side, touch);
  }
  void head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) override {
    tell(&SessionObserver::head_dropped, time, side, touch);
  }
  void rod_done(Timestamp time, const RodState& rod) override {
    tell(&SessionObserver::rod_done, time, rod);
  }

 private:
  template <class... Heard>
  void tell(void (SessionObserver::*what)(Heard...), const std::type_identity_t<Heard>&... heard) {
    for (SessionObserver* observer : observers_) {
      (observer->*what)(heard...);
    }
  }

  std::vector<SessionObserver*> observers_;
};

}  // namespace orthonav::engine

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/session/session.h"
#include "tests/support/scripted_tracker.h"

namespace orthonav::test {

/// A closed box, finely divided, 60 × 40 × 50 mm: a sufficient bone for the session.
nav::TriangleMesh box_bone();

/// One screw on each side on top of that box (its posterior face, +y), pointing straight in (-y).
std::vector<nav::ScrewPlan> two_screws();

/// Without labels: of rods alone.
engine::Operation operation_of(const std::vector<std::string>& labels);

/// With a patient reference many more places would be asked for; tests of other matters touch
/// three.
[[nodiscard]] inline engine::SessionOptions three_places() {
  engine::SessionOptions options;
  options.check_points.enough = 3;
  return options;
}

/// A session whose surgeon, tools and registrations are scripted line by line. Pairs come every 33
/// ms. One of rods alone has no guide, unless it has a reference or another tool.
class ScriptedOperation {
 public:
  explicit ScriptedOperation(std::vector<std::string> labels = {"L4", "L5"},
                             engine::SessionOptions options = {},
                             engine::Verification verification = engine::Verification::kByEye,
                             bool coaching = false, bool reference = false,
                             const std::optional<nav::ToolGeometry>& other = std::nullopt);
  /// Its session's registrar refers to it.
  ScriptedOperation(const ScriptedOperation&) = delete;
  ScriptedOperation& operator=(const ScriptedOperation&) = delete;

  const engine::Guidance& pair();
  const engine::Guidance& pairs(int n);
  const engine::Guidance& says(const std::string& phrase, double confidence = 1.0);
  const engine::Guidance& does(std::vector<ClickerAction> actions);
  /// Another program makes a request, at the time of the next pair.
  const engine::Guidance& asks(engine::Request request);
  /// The phrase comes with the next pair, beside anything said or done then.
  void hears_at(Timestamp time, const std::string& phrase, double confidence = 1.0);
  /// Presses, holds over `n` pairs, releases.
  const engine::Guidance& strokes(int n);
  /// A click of two pairs with the pointer's tip at `tip`.
  const engine::Guidance& touches(Vec3 tip);
  /// The next registrations are uncertain by a shift of this SD along each axis, and by no turn.
  void registers_within(double sd_m);
  /// From setup to `verify` of the first level.
  const engine::Guidance& registers_first_level();
  /// Looks at the registration, then accepts it.
  const engine::Guidance& accepts();
  /// From setup to `landmark` of the first level.
  const engine::Guidance& accepts_first_level();
  /// Touches three places of the box's back that confirm a registration.
  const engine::Guidance& checks_by_touch();
  /// From setup to `landmark` of the first level, where registrations are verified by touch.
  const engine::Guidance& accepts_first_by_touch();
  /// A place for its landmark: on the box's back.
  static constexpr Vec3 kLandmark{0.012, 0.020, 0.015};
  /// Touches the landmark with this offset, as often as its measurement needs.
  const engine::Guidance& touches_landmark(Vec3 off_m = {});
  /// From setup to the end of the last level's last screw: to `rod`, or `done` with one level.
  const engine::Guidance& finishes_every_screw();

  [[nodiscard]] engine::Session& session() { return *session_; }
  /// Of the newest pair; there must have been one.
  [[nodiscard]] const engine::Guidance& shown() const { return *shown_; }
  [[nodiscard]] ScriptedTracker& tracker() { return *tracker_; }
  [[nodiscard]] Timestamp now() const { return now_; }

  nav::Registration registration;              ///< the next registration's result
  std::optional<std::string> unusable;         ///< or why there is none
  std::vector<std::size_t> registered_points;  ///< of each registration asked for
  std::function<void()> before_registering;    ///< may be null; called on the thread that computes
  Duration latency = std::chrono::milliseconds(16);
  std::int64_t map_epoch = 0;           ///< of the next pairs
  std::optional<engine::Part> stalled;  ///< in the next pairs
  bool time_runs = false;               ///< as `engine::Inputs` have it

 private:
  const engine::Guidance& registers_level();
  Timestamp now_ = from_ticks_100ns(10'000'000);
  std::vector<ClickerEvent> clicks_;
  std::vector<Phrase> phrases_;
  std::vector<engine::Request> requests_;
  ScriptedTracker* tracker_ = nullptr;
  std::unique_ptr<engine::Session> session_;
  const engine::Guidance* shown_ = nullptr;
};

/// SD along an axis of the difference between the guide's tip and the pointer's if the two were
/// never compared, with tags of known sizes.
double guide_sd_m();

}  // namespace orthonav::test

#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/case/case.h"
#include "engine/case/screw_sizes.h"
#include "engine/session/replan.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// A place for a screw: one on each side of a level.
struct ScrewPlace {
  std::size_t level = 0;  ///< in the case
  nav::Side side = nav::Side::kLeft;
  friend bool operator==(const ScrewPlace&, const ScrewPlace&) = default;
};

/// The plan of a case while somebody works on it, with every step to be undone. Each change keeps
/// what a plan's file must fulfil: sizes from the list, an entry on the bone where a pointer
/// reaches it, the named side. A screw that leaves the cortex is allowed here, with its clearance
/// beside it: no operation takes it without a reason. One thread.
class PlanEditor {
 public:
  /// Prepares the bones. Refuses a case with a mesh that is not a vertebra.
  static Result<PlanEditor> create(Case subject, ScrewSizes sizes);

  /// The case with its screws as they are now.
  [[nodiscard]] const Case& subject() const { return subject_; }
  [[nodiscard]] const CaseLevel& level() const { return subject_.levels[place_.level]; }
  [[nodiscard]] const nav::VertebraModel& bone() const { return *bones_[place_.level]; }
  [[nodiscard]] const ScrewSizes& sizes() const { return sizes_; }

  [[nodiscard]] const ScrewPlace& place() const { return place_; }
  /// A level beyond the last is ignored. Ends a drag.
  void select(const ScrewPlace& place);
  /// The next place, or the one before: levels in the order of the case, left first.
  void select_beside(bool next);

  /// The screw at the selected place, and the one on the other side of its level; null: none.
  [[nodiscard]] const nav::ScrewPlan* screw() const { return find(place_); }
  [[nodiscard]] const nav::ScrewPlan* other_screw() const;
  /// Of the selected screw; none where its diameter is not stated.
  [[nodiscard]] const std::optional<nav::Clearance>& clearance() const { return clearance_; }

  // Changes of the selected screw. Each is one step to be undone; an Error is one line and changes
  // nothing.

  /// A phrase as in surgery ("move cranial one", "screw six forty five", "undo"), or "redo",
  /// "auto", "delete", "breach REASON" (docs/preview.md).
  Status say(std::string_view phrase);
  /// The screw that `plan auto` finds on this side.
  Status plan_anew();
  Status remove();
  /// The reason why the screw may leave the cortex; empty: it may not.
  Status accept_breach(std::string_view reason);
  Status undo();
  Status redo();

  /// Holds the selected screw by a part; everything until `drop` is one step. False: none is there.
  bool grab(nav::ScrewPart part);
  /// Moves it by this much from where it was grabbed. An entry stays on the bone; a target takes
  /// the nearest length in the list. False: it stays where the last valid move left it.
  bool drag(Vec3 by_m);
  void drop();
  [[nodiscard]] bool held() const { return grabbed_.has_value(); }

  /// Whether the plan differs from the one last saved or loaded.
  [[nodiscard]] bool unsaved() const { return unsaved_; }
  /// Writes the case into an existing folder without one (`save_case`).
  Status save(const std::string& folder);

 private:
  using Bones = std::vector<std::shared_ptr<const nav::VertebraModel>>;
  struct Step {
    ScrewPlace place;
    std::optional<nav::ScrewPlan> before;
    std::optional<nav::ScrewPlan> after;
  };
  struct Grabbed {
    nav::ScrewPart part;
    nav::ScrewPlan from;
  };

  PlanEditor(Case subject, ScrewSizes sizes, Bones bones);
  [[nodiscard]] const nav::ScrewPlan* find(const ScrewPlace& place) const;
  void put(const ScrewPlace& place, const std::optional<nav::ScrewPlan>& screw);
  Status change(const Replan& replan);
  [[nodiscard]] Status check(const nav::ScrewPlan& screw) const;
  /// Makes it one step.
  Status take(std::optional<nav::ScrewPlan> screw);
  [[nodiscard]] std::optional<nav::ScrewPlan> dragged(Vec3 by_m) const;
  void show(const ScrewPlace& place);

  Case subject_;
  ScrewSizes sizes_;
  Bones bones_;
  ScrewPlace place_;
  std::optional<nav::Clearance> clearance_;
  std::vector<Step> done_;
  std::vector<Step> undone_;
  std::optional<Grabbed> grabbed_;
  bool unsaved_ = false;
};

}  // namespace orthonav::engine

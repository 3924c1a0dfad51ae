#include "engine/planning/plan_editor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/case/case_writer.h"
#include "engine/case/screw_place.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/workflow/commands.h"
#include "nav/planning/pedicle_screws.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kBreach = "breach";

/// Before surgery a screw may be moved anywhere on its bone.
ReplanLimits no_limits(const ScrewSizes& sizes) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return {kAny, kAny, sizes};
}

/// The length in the list that is nearest to this one; this one if the list has none.
double listed_length_m(const ScrewSizes& sizes, double diameter_m, double length_m) {
  const ScrewSize* of_diameter = sizes.of_diameter(diameter_m);
  if (of_diameter == nullptr || of_diameter->lengths_m.empty()) {
    return length_m;
  }
  const auto nearer = [length_m](double a, double b) {
    return std::abs(a - length_m) < std::abs(b - length_m);
  };
  return *std::min_element(of_diameter->lengths_m.begin(), of_diameter->lengths_m.end(), nearer);
}

}  // namespace

Result<PlanEditor> PlanEditor::create(Case subject, ScrewSizes sizes) {
  Bones bones;
  for (const CaseLevel& level : subject.levels) {
    auto bone = nav::VertebraModel::prepare(level.mesh);
    if (!bone) {
      return Error{level.label + ": " + bone.error().message, bone.error().code};
    }
    bones.push_back(std::move(*bone));
  }
  if (bones.empty()) {
    return Error{"the case has no level"};
  }
  return PlanEditor(std::move(subject), std::move(sizes), std::move(bones));
}

PlanEditor::PlanEditor(Case subject, ScrewSizes sizes, Bones bones)
    : subject_(std::move(subject)), sizes_(std::move(sizes)), bones_(std::move(bones)) {
  show({});
}

const nav::ScrewPlan* PlanEditor::find(const ScrewPlace& place) const {
  const auto& screws = subject_.levels[place.level].screws;
  const auto found = std::find_if(screws.begin(), screws.end(), [&](const nav::ScrewPlan& screw) {
    return screw.side == place.side;
  });
  return found == screws.end() ? nullptr : &*found;
}

const nav::ScrewPlan* PlanEditor::other_screw() const {
  const bool left = place_.side == nav::Side::kLeft;
  return find({place_.level, left ? nav::Side::kRight : nav::Side::kLeft});
}

/// Selects it and measures its clearance.
void PlanEditor::show(const ScrewPlace& place) {
  place_ = place;
  const nav::ScrewPlan* shown = screw();
  const auto cylinder = shown ? nav::cylinder_of(*shown) : std::nullopt;
  clearance_ = cylinder ? nav::least_clearance(bone().surface(), *cylinder) : std::nullopt;
}

void PlanEditor::select(const ScrewPlace& place) {
  drop();
  if (place.level < subject_.levels.size()) {
    show(place);
  }
}

void PlanEditor::select_beside(bool next) {
  const std::size_t places = 2 * subject_.levels.size();
  const std::size_t now = 2 * place_.level + (place_.side == nav::Side::kLeft ? 0 : 1);
  const std::size_t then = (now + (next ? 1 : places - 1)) % places;
  select({then / 2, then % 2 == 0 ? nav::Side::kLeft : nav::Side::kRight});
}

void PlanEditor::put(const ScrewPlace& place, const std::optional<nav::ScrewPlan>& screw) {
  auto& screws = subject_.levels[place.level].screws;
  std::erase_if(screws, [&](const nav::ScrewPlan& old) { return old.side == place.side; });
  if (screw) {
    // Left first, as a plan from the meshes has them.
    screws.insert(place.side == nav::Side::kLeft ? screws.begin() : screws.end(), *screw);
  }
  show(place);
}

Status PlanEditor::check(const nav::ScrewPlan& screw) const {
  if (const auto ill = ill_sized(screw.entry, screw.target, screw.radius_m)) {
    return Error{"the screw " + *ill};
  }
  if (const auto off = misplaced(bone().surface(), screw.entry, screw.target, screw.radius_m)) {
    return Error{"the screw's " + *off};
  }
  const auto side = off_midline(level().mesh, screw.entry, screw.target).side();
  if (side && *side != screw.side) {
    return Error{std::string("the screw would lie on the ") + name_of(*side)};
  }
  return {};
}

Status PlanEditor::take(std::optional<nav::ScrewPlan> screw) {
  if (screw) {
    if (const Status valid = check(*screw); !valid) {
      return valid;
    }
  }
  const nav::ScrewPlan* before = this->screw();
  done_.push_back({place_, before ? std::optional(*before) : std::nullopt, screw});
  undone_.clear();
  unsaved_ = true;
  put(place_, screw);
  return {};
}

Status PlanEditor::say(std::string_view phrase) {
  drop();
  if (phrase == "redo") {
    return redo();
  }
  if (phrase == "auto") {
    return plan_anew();
  }
  if (phrase == "delete") {
    return remove();
  }
  if (phrase.starts_with(kBreach)) {
    const std::string_view rest = phrase.substr(kBreach.size());
    const std::size_t begin = rest.find_first_not_of(' ');
    return accept_breach(begin == std::string_view::npos ? std::string_view() : rest.substr(begin));
  }
  const auto replan = replan_from(phrase);
  if (!replan) {
    return Error{"\"" + std::string(phrase) + "\" is not a change of a screw"};
  }
  return *replan ? change(**replan) : Status(replan->error());
}

Status PlanEditor::change(const Replan& replan) {
  if (std::holds_alternative<UndoChange>(replan)) {
    return undo();
  }
  const nav::ScrewPlan* now = screw();
  if (!now) {
    return Error{"no screw is planned here; \"auto\" plans one"};
  }
  const auto made = changed(replan, *now, *now, bone(), no_limits(sizes_));
  if (const auto* refusal = std::get_if<ReplanRefusal>(&made)) {
    std::string text;
    write({text}, *refusal);
    return Error{text};
  }
  return take(std::get<nav::ScrewPlan>(made));
}

Status PlanEditor::plan_anew() {
  drop();
  const auto found = nav::plan_pedicle_screws(level().mesh, bone().surface(), sizes_.implants());
  if (!found) {
    return found.error();
  }
  const auto& here = found->sides[place_.side == nav::Side::kLeft ? 0 : 1];
  return here ? take(here->plan) : Status(here.error());
}

Status PlanEditor::remove() {
  drop();
  return screw() ? take(std::nullopt) : Status(Error{"no screw is planned here"});
}

Status PlanEditor::accept_breach(std::string_view reason) {
  drop();
  const nav::ScrewPlan* now = screw();
  if (!now) {
    return Error{"no screw is planned here"};
  }
  nav::ScrewPlan stated = *now;
  stated.accepted_breach = reason;
  return take(std::move(stated));
}

Status PlanEditor::undo() {
  drop();
  if (done_.empty()) {
    return Error{"nothing to undo"};
  }
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  unsaved_ = true;
  put(undone_.back().place, undone_.back().before);
  return {};
}

Status PlanEditor::redo() {
  drop();
  if (undone_.empty()) {
    return Error{"nothing to redo"};
  }
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  unsaved_ = true;
  put(done_.back().place, done_.back().after);
  return {};
}

bool PlanEditor::grab(nav::ScrewPart part) {
  drop();
  const nav::ScrewPlan* now = screw();
  if (now) {
    grabbed_ = Grabbed{part, *now};
  }
  return now != nullptr;
}

std::optional<nav::ScrewPlan> PlanEditor::dragged(Vec3 by_m) const {
  const nav::ScrewPlan& from = grabbed_->from;
  if (grabbed_->part != nav::ScrewPart::kTarget) {
    return nav::shifted_screw(from, grabbed_->part, by_m, bone().surface(),
                              bone().reachable_surface());
  }
  const Vec3 way = from.target + by_m - from.entry;
  const double length_m = way.norm();
  if (!(length_m > 0.0)) {
    return std::nullopt;
  }
  nav::ScrewPlan aimed = from;
  const double listed_m = listed_length_m(sizes_, 2.0 * from.radius_m, length_m);
  aimed.target = from.entry + (listed_m / length_m) * way;
  return aimed;
}

bool PlanEditor::drag(Vec3 by_m) {
  if (!grabbed_) {
    return false;
  }
  const auto moved = dragged(by_m);
  if (!moved || !check(*moved)) {
    return false;
  }
  put(place_, *moved);
  return true;
}

void PlanEditor::drop() {
  const auto grabbed = std::exchange(grabbed_, std::nullopt);
  const nav::ScrewPlan* now = screw();
  if (!grabbed || !now ||
      (now->entry == grabbed->from.entry && now->target == grabbed->from.target)) {
    return;
  }
  done_.push_back({place_, grabbed->from, *now});
  undone_.clear();
  unsaved_ = true;
}

Status PlanEditor::save(const std::string& folder) {
  drop();
  const Status saved = save_case(folder, subject_);
  unsaved_ = unsaved_ && !saved;
  return saved;
}

}  // namespace orthonav::engine

#include "engine/session/session_steps.h"

#include "base/check.h"

namespace orthonav::engine {
namespace {

/// Calls `act` with the step in which a place is touched; the table asks for touches in no other
/// step.
template <class Do>
void in_touched_step(SessionSteps& steps, Step step, const Do& act) {
  switch (step) {
    case Step::kVerify:
      return act(steps.verifying);
    case Step::kAccepted:
      return act(steps.landmarking);
    case Step::kPlaced:
      return act(steps.placing);
    case Step::kRod:
      return act(steps.rods);
    case Step::kSetup:
    case Step::kDigitize:
    case Step::kRegistering:
    case Step::kGuide:
    case Step::kDone:
      break;
  }
  ORTHONAV_CHECK(false);
}

}  // namespace

SessionSteps::SessionSteps(const OperationInWork& work)
    : digitizing(work),
      landmarking(work.options.landmark),
      guide_checks(work.options),
      guiding(work.options.drill),
      placing(work.options),
      replanning(work.options.replan),
      rods(work.rods_alone() || rod_planned(work.state.levels, nav::Side::kLeft),
           work.rods_alone() || rod_planned(work.state.levels, nav::Side::kRight)) {}

void SessionSteps::expect_landmark(const OperationInWork& work) {
  landmarking = Landmarking(work.options.landmark);
  // On the headset's map a comparison costs more by the drift meanwhile than it gains.
  if (work.anchored()) {
    guide_checks.expect_tips();
  }
}

void SessionSteps::expect_wire(const OperationInWork& work) { placing = Placing(work.options); }

void SessionSteps::select_screw(const OperationInWork& work) {
  digitizing.clear();
  guiding.select_open_screw(work.level());
}

void SessionSteps::forget_registration(const OperationInWork& work) {
  verifying = Verifying{};
  expect_landmark(work);
  expect_wire(work);
  guiding.forget_guidance();
}

void SessionSteps::button(Action action, OperationInWork& work, Timestamp time) {
  switch (action) {
    case Action::kStartSampling:
      return digitizing.press(work.level(), time);
    case Action::kStopSampling:
      return digitizing.release(time);
    case Action::kBeginTouch:
      return in_touched_step(*this, work.step, [](auto& step) { step.begin_touch(); });
    case Action::kEndTouch:
      return in_touched_step(*this, work.step, [](auto& step) { step.end_touch(); });
    default:
      ORTHONAV_CHECK(action == Action::kDropTouch);
      return in_touched_step(*this, work.step, [&](auto& step) { step.drop_touch(work, time); });
  }
}

void SessionSteps::collect(const OperationInWork& work) {
  const MethodSteps& of_method = work.options.steps;
  switch (work.step) {
    case Step::kDigitize:
      return digitizing.collect(work);
    case Step::kVerify:
      if (of_method.check_points) {
        verifying.collect(work.tools);
      }
      return;
    case Step::kAccepted:
      if (of_method.dimple()) {
        landmarking.collect(work.tools);
      }
      return;
    case Step::kPlaced:
      return placing.collect(work.tools);
    case Step::kRod:
      return rods.collect(work.tools);
    case Step::kSetup:
    case Step::kRegistering:
    case Step::kGuide:
    case Step::kDone:
      return;
  }
}

bool SessionSteps::consent(OperationInWork& work, Timestamp said) {
  return replanning.consent(work, guiding, placing, said);
}

std::optional<std::size_t> SessionSteps::tool(const OperationInWork& work) const {
  const std::size_t pointer = work.tools.pointer();
  const MethodSteps& of_method = work.options.steps;
  switch (work.step) {
    case Step::kDigitize:
    case Step::kRegistering:
    case Step::kRod:
      return pointer;
    case Step::kVerify:
      return of_method.check_points ? std::optional(pointer) : std::nullopt;
    case Step::kAccepted:
      // Once the landmark is touched, the guide is next.
      return of_method.dimple()
                 ? std::optional(landmarking.touched() ? work.tools.guide() : pointer)
                 : std::nullopt;
    case Step::kGuide:
    case Step::kPlaced:
      return work.tools.guide();
    case Step::kSetup:
    case Step::kDone:
      return std::nullopt;
  }
  return std::nullopt;
}

StepOnDisplay SessionSteps::on_display(const OperationInWork& work) const {
  switch (work.step) {
    case Step::kSetup:
    case Step::kDone:
      return {work.step, {}, {}};
    case Step::kDigitize:
    case Step::kRegistering:
    case Step::kVerify:
    case Step::kAccepted:
      return {work.step, work.level().plan.label, {}};
    case Step::kGuide:
    case Step::kPlaced:
      return {work.step, work.level().plan.label, work.level().plan.screws[guiding.screw()].side};
    case Step::kRod:
      return {work.step, {}, rods.side()};
  }
  return {};
}

StepState SessionSteps::state(const OperationInWork& work) const {
  switch (work.step) {
    case Step::kDigitize:
      return digitizing.state();
    case Step::kVerify:
      return verifying.state(work);
    case Step::kAccepted:
      return landmarking.state(work, guide_checks);
    case Step::kPlaced:
      return placing.state();
    case Step::kRod:
      return rods.state(work);
    case Step::kSetup:
    case Step::kRegistering:
    case Step::kGuide:  // what to do there follows from what a frame shows
    case Step::kDone:
      return {};
  }
  return {};
}

void SessionSteps::write(const OperationInWork& work, bool hidden, Guidance& out) {
  digitizing.write(out);
  verifying.write(work, out);
  guiding.write(work, guide_checks, hidden, out);
  placing.write(work.step, out);
  rods.write(work, out);
}

}  // namespace orthonav::engine

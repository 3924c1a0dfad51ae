#include "engine/session/session_steps.h"

namespace orthonav::engine {

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

void SessionSteps::drop_touch(OperationInWork& work, Timestamp time) {
  using What = TouchNotRecorded::What;
  const What what = work.step == Step::kVerify     ? What::kCheckPoint
                    : work.step == Step::kAccepted ? What::kLandmark
                    : work.step == Step::kPlaced   ? What::kWire
                                                   : What::kHead;
  work.touches.drop();
  work.messages.say(TouchNotRecorded{what, {TouchRefusal::Kind::kHeldTooLong}}, time);
}

void SessionSteps::collect(OperationInWork& work) {
  const WatchedTools& tools = work.tools;
  switch (work.step) {
    case Step::kDigitize:
      return digitizing.collect(work);
    case Step::kVerify:
      if (work.options.steps.check_points) {
        add_tip(work.touches.pointer, tools, tools.pointer());
      }
      return;
    case Step::kAccepted:
      if (work.options.steps.dimple()) {
        add_tip(work.touches.pointer, tools, tools.pointer());
        add_tip(work.touches.guide, tools, tools.guide());
      }
      return;
    case Step::kPlaced:
      return placing.collect(work);
    case Step::kRod:
      return add_tip(work.touches.pointer, tools, tools.pointer());
    case Step::kSetup:
    case Step::kRegistering:
    case Step::kGuide:
    case Step::kDone:
      return;
  }
}

std::optional<Event> SessionSteps::consent(OperationInWork& work, Timestamp said) {
  return replanning.consent(work, guiding, placing, said) ? std::nullopt
                                                          : std::optional(Event::kNoChangePending);
}

void SessionSteps::correct_guide(OperationInWork& work, Timestamp time) {
  if (landmarking.touched() && guide_checks.correct_guide(work, time)) {
    guiding.forget_guidance();
  } else {
    work.messages.say(NotPossibleNow{Event::kSayAccept}, time);
  }
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

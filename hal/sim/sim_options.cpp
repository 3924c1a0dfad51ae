#include <set>
#include <string>

#include "base/joined.h"
#include "base/printed.h"
#include "hal/sim/room/room_layout.h"
#include "hal/sim/sim_headset.h"
#include "hal/sim/surgeon/stroke_plan.h"

namespace orthonav::sim {
namespace {

constexpr double kLongest_s = 86400.0;
constexpr double kFastestRate_hz = 240.0;
constexpr double kFarthest_m = 0.05;
constexpr double kFarthestToldSd = 10.0;

}  // namespace

Status SimOptions::check() const {
  const auto problems = error_model.check();
  if (!problems.empty()) {
    return Error{joined(problems)};
  }
  if (!(told_sd_factor >= 1.0 / kFarthestToldSd && told_sd_factor <= kFarthestToldSd)) {
    return Error{"told_sd_factor is " + printed("%g", told_sd_factor) + ", must lie in [0.1, 10]"};
  }
  if (!(frame_rate_hz >= 1.0 && frame_rate_hz <= kFastestRate_hz)) {
    return Error{"simulated frame rate is " + printed("%f", frame_rate_hz) +
                 " Hz, must lie in [1, 240]"};
  }
  if (error_model.exposure_s * frame_rate_hz > 1.0) {
    return Error{"simulated exposure of " + printed("%f", error_model.exposure_s) +
                 " s is longer than a frame at " + printed("%f", frame_rate_hz) + " Hz"};
  }
  for (const double moved_m : {reference_bump.translation_m, patient_shift.shift_m}) {
    if (!(moved_m >= 0.0 && moved_m <= kFarthest_m)) {
      return Error{"simulated shift of the reference or the patient is " + printed("%f", moved_m) +
                   " m, must lie in [0, 0.05]"};
    }
  }
  std::set<DepthStream> once;
  for (const DepthStream stream : depth) {
    if (stream == DepthStream::kShortThrow || !once.insert(stream).second) {
      return Error{std::string("simulated depth camera ") + name_of(stream) +
                   ": must be ahat or long-throw, and named once"};
    }
  }
  if (!(limit_s > 0.0 && limit_s <= kLongest_s)) {
    return Error{"simulated time limit is " + printed("%f", limit_s) +
                 " s, must be more than 0 and at most 86400"};
  }
  return {};
}

Status check_surgery(const RoomDescription& room) {
  const RoomLayout layout(room);
  if (!layout.tool(ToolKind::kPointer)) {
    return Error{"room: the surgeon has no pointer"};
  }
  const SurgeonPhrases& say = room.phrases;
  for (const std::string* phrase :
       {&say.begin, &say.save, &say.drop, &say.accept, &say.reject, &say.next, &say.finish_rod}) {
    if (phrase->empty()) {
      return Error{"room: the surgeon lacks a phrase to say"};
    }
  }
  if (!room.screws.empty()) {
    return {};
  }
  if (!layout.tool(ToolKind::kGuide)) {
    return Error{"room: the surgeon has no guide"};
  }
  for (const std::size_t level : layout.operated()) {
    if (plan_strokes(room.levels[level], room.exposure).empty()) {
      return Error{"room level \"" + room.levels[level].label +
                   "\": has no surface that a pointer reaches from behind (+y)"};
    }
  }
  return {};
}

}  // namespace orthonav::sim

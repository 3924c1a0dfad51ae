#include "engine/session/landmark_wording.h"

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/said.h"
#include "engine/session/wording.h"

namespace orthonav::engine {
namespace {

constexpr const char* kSayAccept = translatable("say accept result to correct it");

/// The guide's tip and the pointer's: what is to be done, or how far apart they were.
void write_tips(PartedText text, const TipCheck& tips, std::string_view separator) {
  std::string& out = text.out;
  if (tips.due()) {
    text.begin(Importance::kNext, separator);
    out +=
        tips.for_screw()
            ? translated("put the guide's tip in it too, held as for the screw, or say go to next")
            : translated("put the guide's tip in it too, or say go to next");
    return;
  }
  if (!tips.last() || tips.last()->corrected || !tips.offers()) {
    return;
  }
  text.begin(Importance::kDanger, separator);
  append_printed(out, translated("guide's tip %s from the pointer's"),
                 said_mm(tips.last()->apart_m.norm()).c_str());
  text.begin(Importance::kNext, ": ");
  out += translated(kSayAccept);
}

/// The error of the guide's axis according to the last wire, if it is worth correcting.
void write_axis(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  if (landmark.axis == nullptr || !landmark.axis->offers() || landmark.tips->offers()) {
    return;
  }
  text.begin(Importance::kDanger, separator);
  append_printed(text.out, translated("guide's axis %.1f° off"),
                 degrees(landmark.axis->last()->off_rad));
  text.begin(Importance::kNext, ": ");
  text.out += translated(kSayAccept);
}

/// What the touch asks for next, after the text so far.
void write_act_after_touch(PartedText text, const LandmarkSoFar& landmark) {
  const std::size_t end = text.out.size();
  if (landmark.tips != nullptr) {
    write_tips(text, *landmark.tips, "; ");
    write_axis(text, landmark, "; ");
  }
  if (text.out.size() == end) {
    text.begin(Importance::kNext, ": ");
    text.out += translated("say go to next");
  }
}

}  // namespace

void write_landmark(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  std::string& out = text.out;
  if (!landmark.last) {
    text.begin(Importance::kNext, separator);
    out += translated(landmark.recorded ? words::kTouchDimple : words::kMakeDimple);
    return;
  }
  if (landmark.last->missing > 0) {
    text.begin(Importance::kNext, separator);
    out += translated("lift the tip and touch the dimple again");
    return;
  }
  text.begin(Importance::kMessage, separator);
  out += landmark.last->first ? translated("dimple recorded") : translated("dimple found");
  write_act_after_touch(text, landmark);
}

void write_beside_correction(PartedText text, const LandmarkSoFar& landmark) {
  if (landmark.last && landmark.last->missing == 0) {
    write_act_after_touch(text, landmark);
  }
}

}  // namespace orthonav::engine

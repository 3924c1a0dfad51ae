#include "engine/session/findings_wording.h"

#include <array>
#include <string_view>

#include "base/length_text.h"
#include "base/printed.h"
#include "engine/session/coach.h"

namespace orthonav::engine {
namespace {

constexpr const char* kOneOf100 =
    "1 of 100 errors at the screws would exceed %.1f mm, limit %.1f mm";

/// The words for a number and its limit, and the unit in which it is shown.
struct LimitWords {
  const char* format;
  double unit;
};

LimitWords words_about(nav::RefusalReason::Kind kind) {
  using enum nav::RefusalReason::Kind;
  switch (kind) {
    case kRmse:
      return {"registration RMSE %.1f mm, limit %.1f mm", 1e3};
    case kRunnerUpRmse:
      return {"another pose fits nearly as well (%.2f times the RMSE, at least %.2f)", 1.0};
    case kTreAtCentre:
      return {
          "the points leave the bone loose: %.1f mm error expected at its centre, limit %.1f mm",
          1e3};
    case kNoise:
      return {"the points scatter %.1f mm about the surface, limit %.1f mm", 1e3};
    case kInliers:
      return {"only %.0f %% of the points lie on the model, at least %.0f %%", 100.0};
    case kCoverage:
      return {"only %.0f %% of the surface was stroked, at least %.0f %%", 100.0};
    case kShaftCollision:
      return {"the pointer would have gone through bone at %.0f %% of the points, limit %.0f %%",
              100.0};
    case kLogLikelihoodRatio:
      return {"another pose fits nearly as well (margin %.1f, at least %.0f)", 1.0};
    case kTreAtScrews:
      return {"error expected at the screws %.1f mm, limit %.1f mm", 1e3};
    case kTre99AtScrews:
      return {kOneOf100, 1e3};
    case kSoftTissue:
      return {"soft tissue? The tip's height over the bone varies by %.1f mm, limit %.1f mm", 1e3};
    case kModelSize:
      return {"the points fit a bone of %.3f times the model's size", 1.0};
    case kMirrored:
      return {"the points fit the mirror image of this model better (by %.1f, limit %.1f)", 1.0};
    case kFitsOtherLevel:
      break;
  }
  return {"", 1.0};
}

}  // namespace

std::string_view word_of(Side side) { return side == Side::kLeft ? "left" : "right"; }

namespace {
void append_part(std::string& out, const nav::BonePlace& place) {
  using Part = nav::BonePlace::Part;
  constexpr std::array<std::string_view, 3> kHeights = {"upper ", "", "lower "};
  constexpr std::array<std::string_view, 3> kParts = {"spinous process", "lamina",
                                                      "facet and root of the transverse process"};
  static_assert(static_cast<int>(Part::kFacet) == 2);
  if (place.side) {
    out += word_of(*place.side);
    out += ' ';
  }
  out += kHeights[static_cast<std::size_t>(place.height)];
  out += kParts[static_cast<std::size_t>(place.part)];
}
}  // namespace

void append(std::string& out, const nav::BonePlace& place) {
  out += "stroke the ";
  append_part(out, place);
}

void append(std::string& out, const nav::UncertainMotion& motion) {
  using Kind = nav::UncertainMotion::Kind;
  constexpr std::array<std::string_view, 6> kMotions = {
      "medial-lateral shift", "anterior-posterior shift", "cranial-caudal shift",
      "flexion/extension",    "lateral bending",          "axial rotation"};
  static_assert(static_cast<std::size_t>(Kind::kUnconstrained) == kMotions.size());
  if (motion.kind == Kind::kUnconstrained) {
    out += "one motion of the bone is not determined";
    return;
  }
  out += kMotions[static_cast<std::size_t>(motion.kind)];
  append_printed(out, " (%.1f mm at the screws)", motion.error_m * 1e3);
}

void append(std::string& out, const nav::RefusalReason& reason) {
  if (reason.kind == nav::RefusalReason::Kind::kFitsOtherLevel) {
    out.append("the points fit ").append(reason.level == nav::kSeveralLevels ? "" : "level ");
    out.append(reason.level).append(" as well");
    return;
  }
  const auto [format, unit] = words_about(reason.kind);
  append_beside_limit(out, format, reason.value * unit, reason.limit * unit);
  if (reason.motion) {
    out += ": ";
    append(out, *reason.motion);
  }
  if (reason.scrape) {
    out += ": scrape to the bone at the ";
    append_part(out, *reason.scrape);
  }
}

void append(std::string& out, std::span<const nav::RefusalReason> reasons) {
  if (reasons.empty()) {
    out += "registration not accepted";
    return;
  }
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    out += i > 0 ? "; " : "";
    append(out, reasons[i]);
  }
}

void append(std::string& out, const nav::CheckAdvice& advice) {
  switch (advice.kind) {
    case nav::CheckAdvice::Kind::kNone:
      break;
    case nav::CheckAdvice::Kind::kTouchApart:
      if (advice.number == 3) {
        append_printed(out, "touch 3 places, %.0f mm apart", advice.value_m * 1e3);
      } else {
        append_printed(out, "touch %zu more place%s, %.0f mm from the others", advice.number,
                       advice.number == 1 ? "" : "s", advice.value_m * 1e3);
      }
      break;
    case nav::CheckAdvice::Kind::kTouchOffLine:
      append_printed(out, "touch 1 more place, %.0f mm off the line of the others",
                     advice.value_m * 1e3);
      break;
    case nav::CheckAdvice::Kind::kReject:
      append_printed(out, "check point %zu is ", advice.number);
      append_beside_limit(out, "%.1f mm off, limit %.1f mm: reject and stroke again",
                          advice.value_m * 1e3, advice.limit_m * 1e3);
      break;
    case nav::CheckAdvice::Kind::kTouchMore:
      out += "touch 1 more place: ";
      append_beside_limit(out, kOneOf100, advice.value_m * 1e3, advice.limit_m * 1e3);
      break;
    case nav::CheckAdvice::Kind::kUncertain:
      append_beside_limit(out, kOneOf100, advice.value_m * 1e3, advice.limit_m * 1e3);
      out += ": reject and stroke again";
      break;
  }
}

void write_coaching(PartedText text, const Coaching& coaching, std::string_view separator) {
  std::string& out = text.out;
  if (!coaching.unique) {
    // The error of a pose that may be the wrong one is meaningless.
    text.begin(Importance::kMessage, separator);
    out += "ambiguous";
  } else {
    text.begin(Importance::kFigures, separator);
    out += kExpectedError;
    append_mm(out, coaching.expected_m, 1);
    out += coaching.registration_only ? kRegistrationOnly : "";
  }
  if (coaching.enough) {
    text.begin(Importance::kNext, ", ");
    out +=
        coaching.then_touch ? "soft tissue: register, then touch the bone" : "enough to register";
    if (coaching.then_touch && coaching.stroke_next) {
      text.begin(Importance::kMore, ", ");
      out += "or first scrape the ";
      append_part(out, *coaching.stroke_next);
    }
  } else if (coaching.against) {
    text.begin(Importance::kMessage, ", ");
    append(out, *coaching.against);
  } else if (coaching.stroke_next) {
    text.begin(Importance::kNext, ", ");
    append(out, *coaching.stroke_next);
  }
}

void append(std::string& out, const Coaching& coaching) {
  write_coaching(PartedText{out}, coaching, "");
}

}  // namespace orthonav::engine

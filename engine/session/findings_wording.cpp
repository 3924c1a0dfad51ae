#include "engine/session/findings_wording.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/coach.h"
#include "engine/session/said.h"

namespace orthonav::engine {
namespace {

constexpr const char* k99Percent =
    translatable("99 %% of errors at the screws are below %.1f mm, limit %.1f mm");
constexpr const char* kThroughBone = translatable(
    "the pointer would have gone through bone at %.0f %% of the points, limit %.0f %%");
constexpr const char* kSayReject = translatable("say reject level");

/// The words for a number and its limit, and the unit in which it is shown.
struct LimitWords {
  const char* format;
  double unit;
};

LimitWords words_about(nav::RefusalReason::Kind kind) {
  using enum nav::RefusalReason::Kind;
  switch (kind) {
    case kNoise:
      return {translatable("the points scatter %.1f mm about the surface, limit %.1f mm"), 1e3};
    case kInliers:
      return {translatable("only %.0f %% of the points lie on the model, at least %.0f %%"), 100.0};
    case kCoverage:
      return {translatable("only %.0f %% of the surface was stroked, at least %.0f %%"), 100.0};
    case kShaftCollision:
      return {kThroughBone, 100.0};
    case kLogLikelihoodRatio:
      return {translatable("another pose fits nearly as well (margin %.1f, at least %.0f)"), 1.0};
    case kTreAtScrews:
      return {translatable("error expected at the screws %.1f mm, limit %.1f mm"), 1e3};
    case kTre99AtScrews:
      return {k99Percent, 1e3};
    case kTre99AtEnds:
      return {translatable("99 %% of errors at the ends of the bone are below %.1f mm, limit %.1f "
                           "mm"),
              1e3};
    case kSoftTissue:
      return {translatable(
                  "soft tissue? The tip's height over the bone varies by %.1f mm, limit %.1f mm"),
              1e3};
    case kModelSize:
      return {translatable("the points fit a bone of %.3f times the model's size"), 1.0};
    case kMirrored:
      return {translatable(
                  "the points fit the mirror image of this model better (by %.1f, limit %.1f)"),
              1.0};
    case kFitsOtherLevel:
      break;
  }
  return {"", 1.0};
}

}  // namespace

std::string_view word_of(Side side) {
  return side == Side::kLeft ? translated("left") : translated("right");
}

void append_registration_only(std::string& out) {
  out.append(" ").append(translated("(registration only)"));
}

namespace {

/// "left upper lamina", in the place of the format's `%s`.
void append_part(std::string& out, const char* format, const nav::BonePlace& place) {
  using Part = nav::BonePlace::Part;
  using Height = nav::BonePlace::Height;
  constexpr std::array<const char*, 3> kParts = {translatable("spinous process"),
                                                 translatable("lamina"), translatable("facet")};
  static_assert(static_cast<int>(Part::kFacet) == 2);
  const std::size_t begin = out.size();
  out += translated(kParts[static_cast<std::size_t>(place.part)]);
  if (place.height != Height::kMiddle) {
    enclose(out, begin,
            place.height == Height::kUpper ? translated("upper %s") : translated("lower %s"));
  }
  if (place.side) {
    enclose(out, begin,
            *place.side == Side::kLeft ? translated("left %s") : translated("right %s"));
  }
  enclose(out, begin, format);
}

}  // namespace

void append(std::string& out, const nav::BonePlace& place) {
  append_part(out, translated("digitize the %s"), place);
}

void append(std::string& out, const nav::UncertainMotion& motion) {
  using Kind = nav::UncertainMotion::Kind;
  constexpr std::array<const char*, 6> kMotions = {
      translatable("medial-lateral shift"), translatable("anterior-posterior shift"),
      translatable("cranial-caudal shift"), translatable("flexion/extension"),
      translatable("lateral bending"),      translatable("axial rotation")};
  static_assert(static_cast<std::size_t>(Kind::kUnconstrained) == kMotions.size());
  if (motion.kind == Kind::kUnconstrained) {
    out += translated("one motion of the bone is not determined");
    return;
  }
  out.append(translated(kMotions[static_cast<std::size_t>(motion.kind)])).append(" ");
  append_printed(out, translated("(%.1f mm at the screws)"), motion.error_m * 1e3);
}

void append(std::string& out, const nav::RefusalReason& reason) {
  if (reason.kind == nav::RefusalReason::Kind::kFitsOtherLevel) {
    if (reason.level == nav::kSeveralLevels) {
      out += translated("the points fit several levels as well");
    } else {
      append_with(out, translated("the points fit level %s as well"), reason.level);
    }
    return;
  }
  const auto [format, unit] = words_about(reason.kind);
  append_beside_limit(out, translated(format), reason.value * unit, reason.limit * unit);
  if (reason.motion) {
    out += ": ";
    append(out, *reason.motion);
  }
  if (reason.scrape) {
    out += ": ";
    append_part(out, translated("scrape to the bone at the %s"), *reason.scrape);
  }
}

void append(std::string& out, std::span<const nav::RefusalReason> reasons) {
  if (reasons.empty()) {
    out += translated("registration not accepted");
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
        append_printed(out, translated("touch 3 places, %.0f mm apart"), advice.value_m * 1e3);
      } else {
        append_printed(out,
                       advice.number == 1
                           ? translated("touch %zu more place, %.0f mm from the others")
                           : translated("touch %zu more places, %.0f mm from the others"),
                       advice.number, advice.value_m * 1e3);
      }
      break;
    case nav::CheckAdvice::Kind::kTouchOffLine:
      append_printed(out, translated("touch 1 more place, %.0f mm off their line"),
                     advice.value_m * 1e3);
      break;
    case nav::CheckAdvice::Kind::kReject:
      append_beside_limit(out, translated("%.1f mm off, limit %.1f mm"), advice.value_m * 1e3,
                          advice.limit_m * 1e3);
      out.append(": ").append(translated(kSayReject));
      break;
    case nav::CheckAdvice::Kind::kTouchMore:
      out += translated("touch 1 more place");
      break;
    case nav::CheckAdvice::Kind::kUncertain:
      append_beside_limit(out, translated("screws ≤ %.1f mm off, limit %.1f mm"),
                          advice.value_m * 1e3, advice.limit_m * 1e3);
      out.append(": ").append(translated(kSayReject));
      break;
  }
}

void write_coaching(PartedText text, const Coaching& coaching, std::string_view separator) {
  std::string& out = text.out;
  // A bar that fills as the expected error falls.
  constexpr int kParts = 5;
  const int filled =
      coaching.enough ? kParts : std::min(kParts - 1, static_cast<int>(kParts * coaching.progress));
  text.begin(Importance::kFigures, separator);
  for (int i = 0; i < kParts; ++i) {
    out += i < filled ? "◆" : "◇";
  }
  separator = " ";
  if (coaching.enough) {
    text.begin(Importance::kNext, separator);
    out += coaching.then_touch ? translated("double click, then touch the bone")
                               : translated("enough: double click");
  } else if (coaching.against) {
    text.begin(Importance::kMessage, separator);
    append(out, *coaching.against);
  } else if (coaching.stroke_next) {
    text.begin(Importance::kNext, separator);
    append(out, *coaching.stroke_next);
  } else {
    text.begin(Importance::kNext, separator);
    out += translated("stroke on");
  }
}

void append(std::string& out, const Coaching& coaching) {
  write_coaching(PartedText{out}, coaching, "");
}

}  // namespace orthonav::engine

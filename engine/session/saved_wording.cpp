#include "engine/session/saved_wording.h"

namespace orthonav::engine {

namespace {

Importance importance_of(Saved saved) {
  switch (saved) {
    case Saved::kNotSaved:
      return Importance::kDanger;
    case Saved::kNotRecorded:
      return Importance::kMessage;
    case Saved::kSaved:
    case Saved::kNothingNew:
      return Importance::kHeard;
  }
  return Importance::kHeard;
}

}  // namespace

std::string_view text_of(Saved saved) {
  switch (saved) {
    case Saved::kNotSaved:
      return "NOT SAVED";
    case Saved::kSaved:
      return "saved";
    case Saved::kNotRecorded:
      return "NOT RECORDED";
    case Saved::kNothingNew:
      return {};
  }
  return {};
}

void write_saved(PartedText text, Saved saved, std::string_view separator) {
  if (const std::string_view said = text_of(saved); !said.empty()) {
    text.begin(importance_of(saved), separator);
    text.out += said;
  }
}

}  // namespace orthonav::engine

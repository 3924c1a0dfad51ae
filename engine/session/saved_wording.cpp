#include "engine/session/saved_wording.h"

#include "base/translation.h"

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
      return translated("NOT SAVED");
    case Saved::kSaved:
      return translated("saved");
    case Saved::kNotRecorded:
      return translated("NOT RECORDED");
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

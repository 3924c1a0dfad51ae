#include "engine/session/saved_wording.h"

namespace orthonav::engine {

void write_saved(PartedText text, Saved saved, std::string_view separator) {
  if (saved == Saved::kNotSaved) {
    text.begin(Importance::kDanger, separator);
    text.out += "NOT SAVED";
  } else if (saved == Saved::kSaved) {
    text.begin(Importance::kHeard, separator);
    text.out += "saved";
  } else if (saved == Saved::kNotRecorded) {
    text.begin(Importance::kMessage, separator);
    text.out += "NOT RECORDED";
  }
}

}  // namespace orthonav::engine

#include "engine/session/saved_wording.h"

namespace orthonav::engine {

void write_saved(PartedText text, Saved saved, std::string_view separator) {
  if (saved == Saved::kNotSaved) {
    text.begin(Importance::kDanger, separator);
    text.out += "NOT SAVED";
  } else if (saved == Saved::kSaved) {
    text.begin(Importance::kHeard, separator);
    text.out += "saved";
  }
}

}  // namespace orthonav::engine

#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "base/translation.h"

namespace orthonav::test {

/// While it lives, that is the wearer's language of this process; English afterwards.
class LanguageInUse {
 public:
  explicit LanguageInUse(std::shared_ptr<const Translation> translation) {
    use_translation(std::move(translation));
  }
  explicit LanguageInUse(std::vector<Translation::Entry> entries)
      : LanguageInUse(std::make_shared<const Translation>(std::move(entries))) {}
  ~LanguageInUse() { use_translation(nullptr); }
  LanguageInUse(const LanguageInUse&) = delete;
  LanguageInUse& operator=(const LanguageInUse&) = delete;
};

}  // namespace orthonav::test

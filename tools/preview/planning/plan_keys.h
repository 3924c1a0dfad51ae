#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "tools/preview/keys.h"

namespace orthonav::preview {

enum class PlanCommand : std::uint8_t {
  kSay,
  kNext,
  kBefore,
  kSave,
  kViews,
  kScreenshot,
  kPanel,
  kHelp,
  kQuit,
  kDiscard,
};

/// A key while a plan is edited and what it does. The help is made from this table.
struct PlanKeyBinding {
  Key key;
  std::string_view name;  ///< as written on the key, and in scripts
  PlanCommand command;
  std::string_view what;  ///< for the help; of a phrase: the phrase
};

[[nodiscard]] std::span<const PlanKeyBinding> plan_key_bindings();
[[nodiscard]] const PlanKeyBinding* plan_binding_of(Key key);

}  // namespace orthonav::preview

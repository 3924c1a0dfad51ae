#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/set_up.h"

namespace orthonav::tools {

/// `--as-published`, `--method`, `--reference`, `--guidance`, `--instrument`: how an operation in
/// the simulated room is set up. What is not named is the best there is, or as published with
/// `--as-published` or `--method paper`.
struct SetUpArguments {
  std::string method;  ///< empty: not named; so with the others
  std::optional<bool> reference;
  std::string guidance;
  std::string instrument;
  bool as_published = false;

  void add_to(CLI::App& command);
  /// Whether anything was named that only a simulated surgeon can follow.
  [[nodiscard]] bool tells_surgeon() const { return !guidance.empty() || !instrument.empty(); }
  [[nodiscard]] engine::SetUp chosen() const;
};

/// Whether this headset's room is the simulated one.
[[nodiscard]] bool is_simulated(std::string_view headset_uri);
/// The set-up with this headset: a real one has a patient reference only where it is asked for.
[[nodiscard]] engine::SetUp chosen_for(const SetUpArguments& arguments,
                                       std::string_view headset_uri);
/// For a report: what the surgeon works with and goes by, a sentence.
[[nodiscard]] std::string described(const engine::SetUp& set_up);
/// The names of `--guidance`.
[[nodiscard]] std::vector<std::string> guidance_names();

}  // namespace orthonav::tools

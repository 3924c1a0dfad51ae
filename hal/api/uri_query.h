#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orthonav {

/// One `key` or `key=value` of a URI's query.
struct UriItem {
  std::string key;
  std::optional<std::string> value;
  bool again = false;  ///< the key was given before
};

/// The part after a URI's question mark, split at every '&'; a trailing one adds nothing.
[[nodiscard]] std::vector<UriItem> uri_items(std::string_view query);

}  // namespace orthonav

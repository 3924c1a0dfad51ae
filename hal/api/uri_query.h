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

/// What stands behind a URI's question mark, cut at every '&'; one at the end adds nothing.
[[nodiscard]] std::vector<UriItem> uri_items(std::string_view query);

}  // namespace orthonav

#include "hal/api/uri_query.h"

#include <algorithm>

namespace orthonav {

std::vector<UriItem> uri_items(std::string_view query) {
  std::vector<UriItem> items;
  while (!query.empty()) {
    const std::string_view text = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(text.size() + 1, query.size()));
    const std::size_t equals = text.find('=');
    UriItem item;
    item.key = text.substr(0, equals);
    if (equals != std::string_view::npos) {
      item.value = text.substr(equals + 1);
    }
    item.again = std::any_of(items.begin(), items.end(),
                             [&item](const UriItem& each) { return each.key == item.key; });
    items.push_back(std::move(item));
  }
  return items;
}

}  // namespace orthonav

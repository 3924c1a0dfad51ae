#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace orthonav::hl2ss {

/// Data about access units that are still in a decoder.
template <class Known>
class UnitsUnderway {
 public:
  /// Returns the number with which the decoder will return it.
  std::int64_t add(Known known) {
    if (units_.size() == kMost) {
      units_.pop_front();
    }
    units_.emplace_back(next_, std::move(known));
    return next_++;
  }
  /// The data of a unit that came back; it and earlier ones are removed. Nothing if it was removed
  /// before.
  std::optional<Known> take(std::int64_t unit) {
    const auto found = std::find_if(units_.begin(), units_.end(),
                                    [unit](const auto& each) { return each.first == unit; });
    if (found == units_.end()) {
      return std::nullopt;
    }
    std::optional<Known> known = std::move(found->second);
    units_.erase(units_.begin(), found + 1);
    return known;
  }
  void clear() { units_.clear(); }

 private:
  /// A decoder without delay holds none; more entries are left over from a damaged stream.
  static constexpr std::size_t kMost = 8;
  std::deque<std::pair<std::int64_t, Known>> units_;
  std::int64_t next_ = 0;
};

}  // namespace orthonav::hl2ss

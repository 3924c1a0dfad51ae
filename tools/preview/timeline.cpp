#include "tools/preview/timeline.h"

#include <algorithm>
#include <utility>

namespace orthonav::preview {

void Timeline::push(std::shared_ptr<const Moment> moment) {
  const MutexLock lock(mutex_);
  if (!moments_.empty()) {
    const std::int64_t last = moments_.back()->pair;
    if (last >= moment->pair || !keeps(last, stride_)) {
      moments_.pop_back();
    }
  }
  while (moments_.size() >= most_) {
    stride_ *= 2;
    std::erase_if(moments_,
                  [stride = stride_](const auto& kept) { return !keeps(kept->pair, stride); });
  }
  moments_.push_back(std::move(moment));
}

void Timeline::clear() {
  const MutexLock lock(mutex_);
  moments_.clear();
  stride_ = 1;
}

std::shared_ptr<const Moment> Timeline::newest() const {
  const MutexLock lock(mutex_);
  return moments_.empty() ? nullptr : moments_.back();
}

std::size_t Timeline::index_of(std::int64_t pair) const {
  const auto after = std::upper_bound(
      moments_.begin(), moments_.end(), pair,
      [](std::int64_t p, const std::shared_ptr<const Moment>& moment) { return p < moment->pair; });
  return after == moments_.begin() ? 0 : static_cast<std::size_t>(after - moments_.begin()) - 1;
}

std::shared_ptr<const Moment> Timeline::at(std::int64_t pair) const {
  const MutexLock lock(mutex_);
  return moments_.empty() ? nullptr : moments_[index_of(pair)];
}

std::shared_ptr<const Moment> Timeline::first_of(std::string_view step) const {
  const MutexLock lock(mutex_);
  const auto found = std::find_if(moments_.begin(), moments_.end(), [step](const auto& moment) {
    return engine::name_of(moment->at).starts_with(step);
  });
  return found == moments_.end() ? nullptr : *found;
}

std::shared_ptr<const Moment> Timeline::before(std::int64_t pair) const {
  const MutexLock lock(mutex_);
  if (moments_.empty()) {
    return nullptr;
  }
  const std::size_t index = index_of(pair);
  return moments_[index == 0 ? 0 : index - 1];
}

std::shared_ptr<const Moment> Timeline::after(std::int64_t pair) const {
  const MutexLock lock(mutex_);
  if (moments_.empty()) {
    return nullptr;
  }
  return moments_[std::min(index_of(pair) + 1, moments_.size() - 1)];
}

}  // namespace orthonav::preview

#include "hal/hl2ss/scene_stream.h"

#include <algorithm>

namespace orthonav::hl2ss {

void SceneStream::show(const ObjectList& list) {
  {
    const MutexLock lock(mutex_);
    client_.want(list);
  }
  wake_up_.wake();
}

ObjectDisplayStatistics SceneStream::statistics() const {
  const MutexLock lock(mutex_);
  return client_.statistics();
}

std::vector<std::uint8_t> SceneStream::opening() {
  const MutexLock lock(mutex_);
  client_.connected(HostClock::now());
  return {};
}

Status SceneStream::received(std::size_t count, HostTime at) {
  have_ += count;
  const Bytes bytes = Bytes(answers_).first(have_);
  std::size_t used = 0;
  const MutexLock lock(mutex_);
  for (; have_ - used >= sizeof(std::uint32_t); used += sizeof(std::uint32_t)) {
    meter_.counted();
    const Status taken = client_.answered(number_at<std::uint32_t>(bytes, used), moment(at));
    if (!taken) {
      return taken;
    }
  }
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(used), bytes.end(), answers_.begin());
  have_ -= used;
  return {};
}

std::vector<std::uint8_t> SceneStream::more(HostTime now) {
  const MutexLock lock(mutex_);
  return client_.next(moment(now));
}

Status SceneStream::overdue(HostTime now) {
  const MutexLock lock(mutex_);
  const Status late = client_.overdue(now);
  if (!late) {
    client_.given_up();
  }
  return late;
}

}  // namespace orthonav::hl2ss

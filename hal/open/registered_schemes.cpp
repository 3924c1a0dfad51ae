#include "hal/open/registered_schemes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/mutex.h"

namespace orthonav {
namespace {

constexpr std::array<const char*, 4> kOurs = {"sim:", "replay:PATH", "hl2ss://HOST", "openxr:+URI"};

struct Schemes {
  Mutex mutex;
  std::vector<HeadsetScheme> list ORTHONAV_GUARDED_BY(mutex);
};

Schemes& schemes() {
  static Schemes all;
  return all;
}

bool is_well_formed(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
}

bool is_ours(const std::string& name) {
  return std::any_of(kOurs.begin(), kOurs.end(), [&name](const std::string& usage) {
    return usage.substr(0, usage.find(':')) == name;
  });
}

}  // namespace

Status register_scheme(HeadsetScheme scheme) {
  if (!is_well_formed(scheme.name)) {
    return Error{"scheme \"" + scheme.name + "\": must be lower-case letters and digits"};
  }
  if (!scheme.open) {
    return Error{"scheme \"" + scheme.name + "\": has nothing that opens it"};
  }
  Schemes& all = schemes();
  const MutexLock lock(all.mutex);
  const bool taken = std::any_of(all.list.begin(), all.list.end(), [&scheme](const auto& other) {
    return other.name == scheme.name;
  });
  if (taken || is_ours(scheme.name)) {
    return Error{"scheme \"" + scheme.name + "\": is taken"};
  }
  all.list.push_back(std::move(scheme));
  return {};
}

std::optional<HeadsetScheme> registered_scheme(const std::string& name) {
  Schemes& all = schemes();
  const MutexLock lock(all.mutex);
  for (const HeadsetScheme& scheme : all.list) {
    if (scheme.name == name) {
      return scheme;
    }
  }
  return std::nullopt;
}

std::string known_schemes() {
  std::vector<std::string> usages(kOurs.begin(), kOurs.end());
  {
    Schemes& all = schemes();
    const MutexLock lock(all.mutex);
    for (const HeadsetScheme& scheme : all.list) {
      usages.push_back(scheme.usage.empty() ? scheme.name + ":" : scheme.usage);
    }
  }
  std::string text = "known are ";
  for (std::size_t i = 0; i < usages.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == usages.size() ? " and " : ", ") + usages[i];
  }
  return text;
}

}  // namespace orthonav

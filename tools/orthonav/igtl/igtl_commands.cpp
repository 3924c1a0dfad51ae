#include "tools/orthonav/igtl/igtl_commands.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/session/text/wording.h"
#include "tools/orthonav/igtl/igtl_messages.h"
#include "tools/orthonav/igtl/igtl_requests.h"

namespace orthonav::tools {
void IgtlCommands::watch(engine::AssembledOperation& operation) {
  operation.observe(static_cast<engine::SessionObserver*>(this));
  operation.hear(this);
  const MutexLock lock(mutex_);
  watching_ = true;
  waiting_.clear();
  taken_until_.reset();
}

void IgtlCommands::said(const std::string& client, const std::string& device,
                        const std::string& text) {
  auto request = request_of(device, text);
  const MutexLock lock(mutex_);
  if (request && !watching_) {
    request = Error{"no operation runs yet"};
  } else if (request && waiting_.size() >= kMostWaiting) {
    request = Error{"too much was asked at once, limit " + std::to_string(kMostWaiting)};
  }
  if (request) {
    request->from = client;
    waiting_.push_back({std::move(*request), Stopwatch()});
  } else if (refused_.size() < kMostWaiting) {
    refused_.push_back({client, device, false, request.error().message});
  }
}

void IgtlCommands::take(Timestamp until, std::vector<engine::Request>& requests) {
  const MutexLock lock(mutex_);
  for (Waiting& each : waiting_) {
    // Dated back by its age, since pairs take a while to arrive; but not to before the last pair,
    // with which it would have been taken.
    const auto age = std::chrono::duration_cast<Duration>(each.since.elapsed());
    each.request.time = std::max(until - age, taken_until_.value_or(until - age));
    requests.push_back(std::move(each.request));
  }
  waiting_.clear();
  taken_until_ = until;
}

void IgtlCommands::request_answered(const engine::Request& request, bool taken,
                                    const engine::Message* why_not) {
  std::string why;
  if (why_not != nullptr) {
    engine::append(why, *why_not);
  } else if (!taken) {
    why = "\"" + request.text + "\" is not a command";
  }
  answered_.push_back({request.from, request.text, true, std::move(why)});
}

bool IgtlCommands::owe_answers() const {
  const MutexLock lock(mutex_);
  return !answered_.empty() || !refused_.empty();
}

std::vector<std::uint8_t> IgtlCommands::answers(const std::string& status, std::uint64_t stamp) {
  std::vector<Outcome> all = std::exchange(answered_, {});
  {
    const MutexLock lock(mutex_);
    std::move(refused_.begin(), refused_.end(), std::back_inserter(all));
    refused_.clear();
  }
  std::vector<std::uint8_t> out;
  for (const Outcome& each : all) {
    const bool taken = each.why_not.empty();
    nlohmann::ordered_json line = {
        {"client", each.client}, {"asked", each.asked}, {"taken", taken}};
    if (!taken) {
      line["why"] = each.why_not;
    }
    if (each.heard) {
      line["status"] = status;
    }
    const std::string what = each.client + ": " + each.asked;
    if (taken) {
      log_.say(what + ": taken");
    } else {
      log_.warn(what + ": not taken: " + each.why_not);
    }
    const auto message = igtl_answer(line, stamp);
    out.insert(out.end(), message.begin(), message.end());
  }
  return out;
}

}  // namespace orthonav::tools

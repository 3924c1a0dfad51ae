#include "tools/igtl_commands.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/igtl_messages.h"
#include "tools/igtl_requests.h"

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

void IgtlCommands::asked_from_outside(const engine::Request& request) {
  finish();
  asking_ = Outcome{request.from, request.text, false, {}};
  decided_ = false;
}

void IgtlCommands::happened(Timestamp /*time*/, engine::Step /*from*/, engine::Event event,
                            engine::Cell answer) {
  // Later events of the same step do not belong to this request.
  if (!asking_ || std::exchange(decided_, true)) {
    return;
  }
  asking_->taken = event != engine::Event::kSayReplan && answer.action != engine::Action::kRefuse &&
                   answer.action != engine::Action::kIgnore;
}

void IgtlCommands::not_understood(const Phrase& phrase) {
  decided_ = decided_ || (asking_ && phrase.text == asking_->asked);
}

void IgtlCommands::replanned(Timestamp /*time*/, const engine::LevelState& /*level*/,
                             const engine::Replan& /*asked*/,
                             const engine::ScrewReplanned& /*done*/) {
  if (asking_) {
    asking_->taken = true;
  }
}

void IgtlCommands::finish() {
  if (asking_) {
    heard_.push_back(std::move(*asking_));
    asking_.reset();
  }
}

bool IgtlCommands::owe_answers() const {
  const MutexLock lock(mutex_);
  return asking_ || !heard_.empty() || !refused_.empty();
}

std::vector<std::uint8_t> IgtlCommands::answers(const std::string& status, std::uint64_t stamp) {
  finish();
  std::vector<Outcome> all = std::exchange(heard_, {});
  {
    const MutexLock lock(mutex_);
    std::move(refused_.begin(), refused_.end(), std::back_inserter(all));
    refused_.clear();
  }
  std::vector<std::uint8_t> out;
  for (const Outcome& each : all) {
    nlohmann::ordered_json line = {
        {"client", each.client}, {"asked", each.asked}, {"taken", each.taken}};
    line[each.why.empty() ? "status" : "why"] = each.why.empty() ? status : each.why;
    const std::string what = each.client + ": " + each.asked;
    if (each.why.empty()) {
      log_.say(what + (each.taken ? ": taken" : ": not taken"));
    } else {
      log_.warn(what + ": refused: " + each.why);
    }
    const auto message = igtl_answer(line, stamp);
    out.insert(out.end(), message.begin(), message.end());
  }
  return out;
}

}  // namespace orthonav::tools

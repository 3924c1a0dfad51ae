#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/mutex.h"
#include "base/one_line.h"
#include "engine/case/case_writer.h"
#include "hal/igtl/message.h"
#include "hal/igtl/server.h"
#include "tools/orthonav/igtl/igtl_messages.h"
#include "tools/orthonav/igtl/igtl_stream.h"
#include "tools/orthonav/plan/plan_command.h"
#include "tools/orthonav/plan/received_plans.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/out_folder.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {
namespace {

constexpr auto kLookBetween = std::chrono::milliseconds(20);
/// Clients are told at every 25th look, twice a second, what was received.
constexpr int kStatusEvery = 25;
/// For the last answer to leave.
constexpr auto kLastWord = std::chrono::milliseconds(500);

struct ReceiveArguments {
  std::string case_folder;  ///< empty: the built-in phantom
  ScrewArguments screws;
  std::string out;
  IgtlArguments igtl;
};

enum class Ending : std::uint8_t { kNotYet, kSaved, kCancelled };

/// Takes plans and the two commands of clients, on the server's thread, and keeps the answers until
/// they are fetched.
class PlanDesk : public igtl::TextListener {
 public:
  PlanDesk(ReceivedPlans plans, std::string folder)
      : plans_(std::move(plans)), folder_(std::move(folder)) {}

  void said(const std::string& client, const std::string& device, const std::string& text) override
      ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    nlohmann::ordered_json answer = {{"client", client}};
    const Status done = device == "Plan" ? take_plan(text, answer) : obey(text, answer);
    answer["taken"] = done.ok();
    if (!done) {
      answer["why"] = done.error().message;
    }
    std::fprintf(stderr, "%s: %s: %s\n", client.c_str(),
                 one_line(answer["asked"].get<std::string>()).c_str(),
                 done ? "taken" : ("refused: " + one_line(done.error().message)).c_str());
    const auto message = igtl_answer(answer, 0);
    answers_.insert(answers_.end(), message.begin(), message.end());
  }

  [[nodiscard]] std::vector<std::uint8_t> fetch_answers() ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return std::exchange(answers_, {});
  }
  [[nodiscard]] Ending ending() const ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return ending_;
  }
  /// Every screw, where they have changed since the last call.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> fetch_screws() ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (!std::exchange(changed_, false)) {
      return std::nullopt;
    }
    std::vector<std::uint8_t> out;
    for (const engine::CaseLevel& level : plans_.subject().levels) {
      const auto screws = igtl_screws(level.label, level.screws, {});
      out.insert(out.end(), screws.begin(), screws.end());
    }
    return out;
  }
  [[nodiscard]] std::vector<std::uint8_t> status() const ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    igtl::StatusValues values;
    values.name = "plan";
    for (const std::string& label : plans_.received()) {
      values.message += (values.message.empty() ? "received: " : ", ") + label;
    }
    values.message += values.message.empty() ? "no plan received yet" : "; \"save\" ends";
    return igtl::packed({"orthonav", 0}, values);
  }
  /// Prints where the plans are, and every screw.
  void tell_saved() const ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    print_written(folder_, plans_.subject(), plans_.sizes());
  }

 private:
  Status take_plan(const std::string& text, nlohmann::ordered_json& answer)
      ORTHONAV_REQUIRES(mutex_) {
    answer["asked"] = "plan";
    const auto level = plans_.take(text);
    if (!level) {
      return level.error();
    }
    changed_ = true;
    answer["asked"] = "plan " + level->label;
    answer["screws"] = as_json(std::vector{*level})["levels"][0]["screws"];
    return {};
  }
  Status obey(const std::string& text, nlohmann::ordered_json& answer) ORTHONAV_REQUIRES(mutex_) {
    answer["asked"] = text;
    if (ending_ != Ending::kNotYet) {
      return Error{"it has ended"};
    }
    if (text == "cancel") {
      ending_ = Ending::kCancelled;
      return {};
    }
    if (text != "save") {
      return Error{"no command: \"save\" and \"cancel\" are"};
    }
    if (plans_.received().empty()) {
      return Error{"no plan was received yet"};
    }
    const Status saved = engine::save_case(folder_, plans_.subject());
    ending_ = saved ? Ending::kSaved : ending_;
    return saved;
  }

  mutable Mutex mutex_;
  ReceivedPlans plans_ ORTHONAV_GUARDED_BY(mutex_);
  const std::string folder_;
  std::vector<std::uint8_t> answers_ ORTHONAV_GUARDED_BY(mutex_);
  Ending ending_ ORTHONAV_GUARDED_BY(mutex_) = Ending::kNotYet;
  bool changed_ ORTHONAV_GUARDED_BY(mutex_) = true;
};

/// Until a client says that it is done, or a signal comes.
void attend(PlanDesk& desk, igtl::Server& server, const StopSignals& signals) {
  for (int look = 0; !signals.caught(); ++look) {
    if (auto screws = desk.fetch_screws()) {
      server.set_standing(*std::move(screws));
    }
    if (look % kStatusEvery == 0) {
      server.publish(desk.status());
    }
    const bool ended = desk.ending() != Ending::kNotYet;
    if (auto answers = desk.fetch_answers(); !answers.empty()) {
      server.tell(std::move(answers));
    }
    std::this_thread::sleep_for(ended ? kLastWord : kLookBetween);
    if (ended) {
      return;
    }
  }
}

int receive(PlanDesk& desk, const ReceiveArguments& arguments, StopSignals& signals) {
  const auto server = serve_igtl(arguments.igtl, &desk, "; its clients send plans");
  if (!server) {
    return bad_input(server.error().message);
  }
  signals.let_finish();
  attend(desk, **server, signals);
  if (desk.ending() == Ending::kSaved) {
    desk.tell_saved();
    return kDone;
  }
  std::fprintf(
      stderr, "orthonav: %s, nothing is written\n",
      signals.caught() ? ("stopped by " + *signals.caught()).c_str() : "cancelled by a client");
  return signals.caught() ? signals.exit_code() : kNo;
}

int run_receive(const ReceiveArguments& arguments, StopSignals& signals) {
  signals.outlast_terminal();
  const auto sizes = arguments.screws.sizes();
  if (!sizes) {
    return bad_input(sizes.error().message);
  }
  auto subject = load_checked_case(arguments.case_folder, engine::CaseUse::kPlanning);
  if (!subject) {
    return bad_input(subject.error().message);
  }
  if (Status s = engine::check_labels(*subject); !s) {
    return bad_input(s.error().message);
  }
  const auto folder = OutFolder::create("--out", arguments.out);
  const Status absent = folder ? folder->check_absent({"case.json"}) : Status{folder.error()};
  if (!absent) {
    return bad_input(absent.error().message);
  }
  PlanDesk desk(ReceivedPlans(*std::move(subject), *sizes), arguments.out);
  return receive(desk, arguments, signals);
}

}  // namespace

void add_plan_receive(CLI::App& plan, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<ReceiveArguments>();
  CLI::App* command = plan.add_subcommand(
      "receive", "Takes plans from other programs over OpenIGTLink, before an operation");
  add_case_option(*command, arguments->case_folder);
  command
      ->add_option("-o,--out", arguments->out,
                   "write the whole case, with the plans received, into a new folder")
      ->check(some_text())
      ->type_name("DIR")
      ->required();
  arguments->screws.add_to(*command);
  arguments->igtl.at = "18944";
  arguments->igtl.add_place_to(*command, "listen to plans");
  command->get_option("--igtl")->capture_default_str();
  command->footer(
      "\nA client sends each level's plan as a STRING \"Plan\", the text of a plan's file or of a\n"
      "markups file of 3D Slicer, and the STRING \"Command\" \"save\", or \"cancel\". Each is\n"
      "answered (docs/igtl.md). Exit code 1 where a client cancelled.");
  command->callback([arguments, &action, &signals] {
    action = [arguments, &signals] { return run_receive(*arguments, signals); };
  });
}

}  // namespace orthonav::tools

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/orthonav/command.h"
#include "tools/orthonav/doctor/headset_probe.h"
#include "tools/orthonav/doctor/machine.h"

namespace orthonav::tools {
namespace {

struct DoctorArguments {
  bool json = false;
  std::string root = "/";
  std::string headset;
};

const char* word_for(Finding finding) {
  switch (finding) {
    case Finding::kFound:
      return "found";
    case Finding::kMissing:
      return "missing";
    case Finding::kOptional:
      return "absent";
  }
  return "";
}

bool nothing_missing(const std::vector<Offer>& offers) {
  return std::none_of(offers.begin(), offers.end(),
                      [](const Offer& offer) { return offer.finding == Finding::kMissing; });
}

std::string offers_json(const std::vector<Offer>& offers, bool ready) {
  nlohmann::ordered_json out = {{"version", ORTHONAV_VERSION}, {"demo_can_run", ready}};
  out["offers"] = nlohmann::ordered_json::array();
  for (const Offer& offer : offers) {
    nlohmann::ordered_json entry = {
        {"name", offer.name}, {"finding", word_for(offer.finding)}, {"what", offer.what}};
    if (!offer.how.empty()) {
      entry["how_to_get_it"] = offer.how;
    }
    out["offers"].push_back(std::move(entry));
  }
  return out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string offers_text(const std::vector<Offer>& offers, bool ready) {
  std::string text = "orthonav " ORTHONAV_VERSION "\n";
  for (const Offer& offer : offers) {
    std::string left = std::string("  ") + word_for(offer.finding);
    left.resize(11, ' ');
    left += offer.name;
    left.resize(std::max<std::size_t>(left.size() + 2, 37), ' ');
    text += left + offer.what + "\n";
    if (!offer.how.empty()) {
      text += std::string(37, ' ') + "-> " + offer.how + "\n";
    }
  }
  return text + (ready ? "Everything that the demo needs is here.\n"
                       : "The demo can't run: see what is missing above.\n");
}

int run_doctor(const DoctorArguments& arguments) {
  std::vector<Offer> offers = offers_of_machine(arguments.root);
  const bool ready = nothing_missing(offers);
  bool answers = true;
  if (!arguments.headset.empty()) {
    const auto ports = offers_of_headset(arguments.headset);
    if (!ports) {
      return bad_input(ports.error().message);
    }
    answers = nothing_missing(*ports);
    offers.insert(offers.end(), ports->begin(), ports->end());
  }
  const std::string text = arguments.json ? offers_json(offers, ready) : offers_text(offers, ready);
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!answers) {
    std::fprintf(stderr, "orthonav: the headset's cameras do not answer\n");
  }
  return ready && answers ? kDone : kNo;
}

}  // namespace

void add_doctor_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<DoctorArguments>();
  CLI::App* command = app.add_subcommand(
      "doctor",
      "What this machine offers, what is missing and how to get it (exit 1: the demo "
      "can't run, or the headset's cameras do not answer)");
  command->add_flag("--json", arguments->json, "Everything as JSON");
  command->add_option("--headset", arguments->headset,
                      "hl2ss://HOST: which of the headset's ports answer; replay:PATH: what the "
                      "recording holds");
  command->add_option("--root", arguments->root, "Look at files under this folder")->group("");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_doctor(*arguments); }; });
}

}  // namespace orthonav::tools

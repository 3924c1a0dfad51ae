#include "tools/orthonav/igtl/igtl_stream.h"

#include <cstdio>

#include "base/how_many.h"
#include "base/joined.h"
#include "engine/session/text/wording.h"
#include "hal/net/host_port.h"
#include "tools/orthonav/igtl/igtl_messages.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/listening_place.h"

namespace orthonav::tools {
namespace {

constexpr Duration kStatusEvery = std::chrono::seconds(1);

bool same(const nav::ScrewPlan& a, const nav::ScrewPlan& b) {
  return a.side == b.side && a.entry.v == b.entry.v && a.target.v == b.target.v &&
         a.radius_m == b.radius_m;
}

std::vector<nav::ScrewPlan> screws_of(std::span<const engine::LevelState> levels) {
  std::vector<nav::ScrewPlan> out;
  for (const engine::LevelState& level : levels) {
    out.insert(out.end(), level.plan.screws.begin(), level.plan.screws.end());
  }
  return out;
}

}  // namespace

void IgtlArguments::add_place_to(CLI::App& command, const std::string& what) {
  command
      .add_option("--igtl", at,
                  what +
                      " over OpenIGTLink at this port of this machine alone, or at ADDRESS:PORT "
                      "(docs/igtl.md; usual port: 18944)")
      ->check(some_text())
      ->type_name("PORT");
  command
      .add_option("--igtl-allow", allow,
                  "who may connect besides this machine, as in 192.168.1.0/24,10.0.0.7; this or "
                  "--igtl-token is needed where --igtl names an address that other machines reach")
      ->check(some_text())
      ->type_name("NETWORKS");
  command
      .add_option(
          "--igtl-token", token_file,
          "file with the token that a client of --igtl must send first, made where there is "
          "none (docs/igtl.md)")
      ->check(some_text())
      ->type_name("FILE");
}

void IgtlArguments::add_to(CLI::App& command) {
  add_place_to(command, "serve tools, registration, screws and guidance");
  command.add_flag("--igtl-commands", commands,
                   "clients of --igtl may say commands and change the planned screw in work; "
                   "whoever may connect then steers the operation (docs/igtl.md)");
}

Result<igtl::ServerOptions> igtl_options(const IgtlArguments& arguments) {
  const std::string& at = arguments.at;
  igtl::ServerOptions options;
  options.allow = arguments.allow;
  auto token = token_asked_for("--igtl-token", arguments.token_file);
  if (!token) {
    return token.error();
  }
  options.token = *std::move(token);
  const auto place = listening_place("--igtl", at);
  if (!place) {
    return place.error();
  }
  options.address = place->host;
  options.port = place->port;
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{"--igtl \"" + at + "\": " + joined(problems)};
  }
  return options;
}

Result<std::unique_ptr<igtl::Server>> serve_igtl(const IgtlArguments& arguments,
                                                 igtl::TextListener* listener,
                                                 const char* clients) {
  const auto options = igtl_options(arguments);
  if (!options) {
    return options.error();
  }
  auto server = igtl::Server::start(*options, listener);
  if (!server) {
    return Error{"--igtl, --igtl-allow, --igtl-token: " + server.error().message,
                 server.error().code};
  }
  std::fprintf(stderr, "OpenIGTLink at %s:%d%s%s\n", net::before_port(options->address).c_str(),
               (*server)->port(), options->token.is_asked_for() ? "; clients bring the token" : "",
               clients);
  return server;
}

Status IgtlStream::open(const IgtlArguments& arguments) {
  if (arguments.at.empty()) {
    if (arguments.commands) {
      return Error{"--igtl-commands: needs --igtl"};
    }
    if (!arguments.token_file.empty()) {
      return Error{"--igtl-token: needs --igtl"};
    }
    return arguments.allow.empty() ? Status{} : Error{"--igtl-allow: needs --igtl"};
  }
  hears_ = arguments.commands;
  auto server = serve_igtl(arguments, hears_ ? &commands_ : nullptr,
                           hears_ ? "; its clients may command" : "");
  if (!server) {
    return server.error();
  }
  server_ = std::move(*server);
  return {};
}

void IgtlStream::watch(engine::AssembledOperation& operation) {
  if (server_) {
    session_ = &operation.session();
    const auto tools = session_->tracker().tools();
    for (std::size_t i = 0; i < tools.size(); ++i) {
      if (igtl_name_is_taken(tools, i, "Reference")) {
        std::fprintf(stderr,
                     "orthonav: warning: --igtl: %s is not sent: its name is another tool's in the "
                     "20 bytes of OpenIGTLink (%s)\n",
                     tools[i].name.c_str(), igtl_device(tools[i].name, "Reference").c_str());
      }
    }
    told_.clear();
    last_status_.reset();
    operation.observe(static_cast<engine::LoopObserver*>(this));
    if (hears_) {
      commands_.watch(operation);
    }
  }
}

void IgtlStream::stepped(const FrameHeader& /*frame*/, const engine::Inputs& /*inputs*/,
                         const engine::Guidance& guidance) {
  std::vector<nav::ScrewPlan> screws = screws_of(guidance.levels);
  if (!std::equal(screws.begin(), screws.end(), told_.begin(), told_.end(), same)) {
    server_->set_standing(igtl_screws(guidance.levels, guidance.frame_time));
    told_ = std::move(screws);
  }
  std::vector<std::uint8_t> frame = igtl_frame(*session_, guidance);
  // Only the newest frame is sent, so the status is added to each frame until one has been sent.
  const std::int64_t sent = server_->counts().frames;
  const bool due = !last_status_ || guidance.frame_time - *last_status_ >= kStatusEvery;
  if (due || sent == sent_at_status_) {
    const auto status = igtl_status(*session_, guidance);
    frame.insert(frame.end(), status.begin(), status.end());
    last_status_ = due ? guidance.frame_time : last_status_;
    sent_at_status_ = sent;
  }
  server_->publish(std::move(frame));
  if (hears_ && commands_.owe_answers()) {
    std::string status;
    engine::append_without_heard(status, guidance.status);
    server_->tell(commands_.answers(status, igtl_stamp(guidance.frame_time)));
  }
}

void IgtlStream::tell() const {
  if (!server_) {
    return;
  }
  const igtl::Server::Counts counts = server_->counts();
  std::fprintf(stderr, "OpenIGTLink: %s, %s", how_many(counts.served, "client").c_str(),
               how_many(counts.frames, "frame").c_str());
  if (counts.dropped > 0) {
    std::fprintf(stderr, "; %lld dropped, the last one %s", static_cast<long long>(counts.dropped),
                 counts.last_drop.c_str());
  }
  if (counts.refused > 0) {
    std::fprintf(stderr, "; %lld not let in", static_cast<long long>(counts.refused));
  }
  std::fprintf(stderr, "\n");
}

}  // namespace orthonav::tools

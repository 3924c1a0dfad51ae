#include "tools/orthonav/dashboard/dashboard.h"

#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/mutex.h"
#include "base/printed.h"
#include "base/stopwatch.h"
#include "base/translation.h"
#include "embedded/dashboard_html.h"
#include "engine/io/image_file.h"
#include "engine/session/text/wording.h"
#include "engine/session/work_watch.h"
#include "tools/orthonav/dashboard/camera_view.h"
#include "tools/orthonav/dashboard/dashboard_state.h"
#include "tools/orthonav/dashboard/web_access.h"

namespace orthonav::tools {
namespace {

constexpr std::size_t kMaxMessages = 50;
/// Browsers ask five times a second.
constexpr Duration kTellEvery = std::chrono::milliseconds(100);
/// An older view is no longer shown; the camera's image is shown instead.
constexpr auto kViewLasts = std::chrono::seconds(2);
/// Browsers ask for the view twice a second.
constexpr auto kLookLasts = std::chrono::seconds(2);

}  // namespace

/// Answers requests on its own thread from the latest state.
class Dashboard::Server {
 public:
  explicit Server(WebAccess access) : access_(std::move(access)) {}
  ~Server() {
    server_.stop();
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  Status start() {
    limit_what_is_taken();
    add_answers();
    const std::string& host = access_.host();
    port_ = access_.port() == 0                          ? server_.bind_to_any_port(host)
            : server_.bind_to_port(host, access_.port()) ? access_.port()
                                                         : -1;
    if (port_ < 0) {
      return Error{
          "--web " + std::to_string(access_.port()) + ": the port cannot be had at " + host,
          ErrorCode::kUnavailable};
    }
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      ended_ = true;
    });
    // It can't be stopped before it listens.
    while (!server_.is_running() && !ended_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return {};
  }

  void tell(std::string state, const GreyImage* left) {
    const MutexLock lock(mutex_);
    state_ = std::move(state);
    if (left != nullptr) {
      left_ = *left;
    }
    since_told_ = Stopwatch();
    stalled_.clear();
  }
  void tell_stall(std::string_view text) {
    const MutexLock lock(mutex_);
    stalled_ = text;
  }
  void look_through(const StereoCalibration& cameras) {
    const MutexLock lock(camera_mutex_);
    camera_.emplace(cameras);
  }
  void show(const RgbaImage& picture, const std::string& what) {
    const MutexLock lock(mutex_);
    view_ = picture;
    what_ = what;
    since_shown_ = Stopwatch();
  }
  [[nodiscard]] bool looked_at() const {
    const MutexLock lock(mutex_);
    return since_look_ && since_look_->elapsed() < kLookLasts;
  }
  [[nodiscard]] int port() const { return port_; }

 private:
  void limit_what_is_taken() {
    // By default the library would share its port with other programs.
    server_.set_socket_options([](int socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_payload_max_length(1024);
    server_.set_keep_alive_max_count(1000);
    server_.new_task_queue = [] { return new httplib::ThreadPool(2); };
    server_.set_pre_routing_handler([this](const httplib::Request& request,
                                           httplib::Response& answer) {
      answer.set_header(
          "Content-Security-Policy",
          "default-src 'self'; style-src 'unsafe-inline'; script-src 'unsafe-inline'");
      answer.set_header("Cache-Control", "no-store");
      if (request.method == "GET" &&
          access_.lets_in(request.get_header_value("Host"), request.get_header_value("Cookie"))) {
        return httplib::Server::HandlerResponse::Unhandled;
      }
      answer_stranger(request, answer);
      return httplib::Server::HandlerResponse::Handled;
    });
  }

  /// A request with the token gets a cookie, and a redirect to the address without the token.
  void answer_stranger(const httplib::Request& request, httplib::Response& answer) const {
    answer.set_header("Referrer-Policy", "no-referrer");
    if (request.method == "GET" && access_.is_token(request.get_param_value("token"))) {
      answer.set_header("Set-Cookie", access_.cookie());
      answer.set_redirect("/", 303);
      return;
    }
    answer.status = 403;
    if (access_.asks_for_a_token()) {
      answer.set_content("This page asks for a token: use the address that orthonav printed.\n",
                         "text/plain; charset=utf-8");
    }
  }

  void add_answers() {
    server_.Get("/", [](const httplib::Request&, httplib::Response& answer) {
      answer.set_content(std::string(embedded::dashboard_html()), "text/html; charset=utf-8");
    });
    server_.Get("/state", [this](const httplib::Request&, httplib::Response& answer) {
      answer.set_content(state(), "application/json");
    });
    server_.Get("/view.png", [this](const httplib::Request&, httplib::Response& answer) {
      look();
      answer_view(answer);
    });
  }

  void look() {
    const MutexLock lock(mutex_);
    since_look_ = Stopwatch();
  }

  /// The state with its age, so that an old one is not taken for new.
  std::string state() {
    const MutexLock lock(mutex_);
    const auto ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(since_told_.elapsed()).count();
    return "{\"age_ms\":" + std::to_string(ms) +
           ",\"view\":" + nlohmann::json(what_is_seen()).dump() +
           ",\"stalled\":" + nlohmann::json(stalled_).dump() +
           ",\"now\":" + (state_.empty() ? "null" : state_) + "}";
  }

  [[nodiscard]] bool has_view() const ORTHONAV_REQUIRES(mutex_) {
    return !view_.pixels.empty() && since_shown_.elapsed() < kViewLasts;
  }

  [[nodiscard]] std::string what_is_seen() const ORTHONAV_REQUIRES(mutex_) {
    return has_view() ? what_ : left_.pixels.empty() ? "no picture" : "left camera";
  }

  void answer_view(httplib::Response& answer) {
    RgbaImage view;
    GreyImage left;
    {
      const MutexLock lock(mutex_);
      if (has_view()) {
        view = view_;
      } else {
        left = left_;
      }
    }
    if (view.pixels.empty() && !left.pixels.empty()) {
      const MutexLock lock(camera_mutex_);
      view = camera_ ? camera_->picture_of(left) : RgbaImage{};
    }
    const auto png = view.pixels.empty() ? Result<std::string>(Error{"no picture yet"})
                                         : engine::png_bytes(view);
    if (png) {
      answer.set_content(*png, "image/png");
    } else {
      answer.status = 404;
    }
  }

  mutable Mutex mutex_;
  std::string state_ ORTHONAV_GUARDED_BY(mutex_);
  std::string stalled_ ORTHONAV_GUARDED_BY(mutex_);  ///< empty: nothing hangs
  GreyImage left_ ORTHONAV_GUARDED_BY(mutex_);
  RgbaImage view_ ORTHONAV_GUARDED_BY(mutex_);
  std::string what_ ORTHONAV_GUARDED_BY(mutex_);
  Stopwatch since_told_ ORTHONAV_GUARDED_BY(mutex_);
  Stopwatch since_shown_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Stopwatch> since_look_ ORTHONAV_GUARDED_BY(mutex_);
  Mutex camera_mutex_;  ///< held while a picture is drawn
  std::optional<UprightCamera> camera_ ORTHONAV_GUARDED_BY(camera_mutex_);
  WebAccess access_;
  httplib::Server server_;
  int port_ = -1;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

Dashboard::Dashboard() = default;
Dashboard::~Dashboard() = default;

Status Dashboard::open(const DashboardArguments& arguments) {
  if (arguments.at.empty()) {
    return arguments.token_file.empty() ? Status{} : Error{"--token: needs --web"};
  }
  auto access = WebAccess::of(arguments.at, arguments.token_file);
  if (!access) {
    return access.error();
  }
  auto server = std::make_unique<Server>(*access);
  if (const Status started = server->start(); !started) {
    return started;
  }
  server_ = std::move(server);
  std::fprintf(stderr, "dashboard at %s\n", access->url(port()).c_str());
  return {};
}

int Dashboard::port() const { return server_ ? server_->port() : -1; }

void Dashboard::watch(engine::AssembledOperation& operation, const engine::GradeLimits& limits) {
  if (server_) {
    watch(operation.session(), limits);
    operation.observe(static_cast<engine::LoopObserver*>(this));
  }
}

void Dashboard::watch(const engine::Session& session, const engine::GradeLimits& limits) {
  limits_ = limits;
  session_ = &session;
}

void Dashboard::look_through(const StereoCalibration& cameras) {
  if (server_) {
    server_->look_through(cameras);
  }
}

bool Dashboard::looked_at() const { return server_ && server_->looked_at(); }

void Dashboard::show(const RgbaImage& picture, const std::string& what) {
  if (server_) {
    server_->show(picture, what);
  }
}

// The page shows the very texts that the surgeon reads.

void Dashboard::part_stalled(engine::Part part) {
  const WearersLanguage language;
  server_->tell_stall(engine::stalled_text(part));
}

void Dashboard::withdrawn(const engine::Guidance& guidance) {
  if (!guidance.blank) {
    const WearersLanguage language;
    server_->tell_stall(engine::detail_text(guidance.status));
  }
}

void Dashboard::note_changes() {
  const std::string& step = changes_.new_step();
  const std::string& message = changes_.new_message();
  if (step.empty() && message.empty()) {
    return;
  }
  const char* between = step.empty() || message.empty() ? "" : ": ";
  messages_.push_front(printed("%.1f s  ", changes_.time_s()) + step + between + message);
  if (messages_.size() > kMaxMessages) {
    messages_.pop_back();
  }
}

void Dashboard::stepped(const FrameHeader& frame, const engine::Inputs& /*inputs*/,
                        const engine::Guidance& guidance) {
  const WearersLanguage language;
  changes_.look(frame.time, guidance.status);
  note_changes();
  if (told_at_ && frame.time - *told_at_ < kTellEvery) {
    return;
  }
  told_at_ = frame.time;
  server_->tell(dashboard_state(*session_, guidance, limits_, changes_.time_s(), messages_), left_);
}

}  // namespace orthonav::tools

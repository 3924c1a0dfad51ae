#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/live/assembled_operation.h"
#include "hal/igtl/server.h"
#include "tools/orthonav/igtl/igtl_commands.h"

namespace orthonav::tools {

/// `--igtl`, of the commands that run an operation.
struct IgtlArguments {
  std::string at;          ///< "PORT" or "ADDRESS:PORT"; empty: nothing is served
  std::string allow;       ///< networks that may connect in addition to this machine
  std::string token_file;  ///< with the token that clients must bring; empty: none
  bool commands = false;   ///< clients may command and plan

  void add_to(CLI::App& command);
  /// All but `--igtl-commands`; `what` says what is served.
  void add_place_to(CLI::App& command, const std::string& what);
};

/// Serves an operation over OpenIGTLink (tools/orthonav/igtl/igtl_messages.h) for as long as it
/// lives, once it is open.
class IgtlStream : public engine::LoopObserver {
 public:
  /// Requests of clients and their outcomes are written to `log`, which is borrowed.
  explicit IgtlStream(EventLog& log) : commands_(log) {}
  /// Starts listening if the arguments say where, and reports it on standard error.
  Status open(const IgtlArguments& arguments);
  /// From now on serves this operation, which must outlive its run; it replaces an earlier one,
  /// which must have ended.
  void watch(engine::AssembledOperation& operation);

  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  /// Reports on standard error how many clients there were, and why any was dropped.
  void tell() const;

 private:
  IgtlCommands commands_;
  bool hears_ = false;                    ///< clients may command and plan
  std::unique_ptr<igtl::Server> server_;  ///< null: not serving
  const engine::Session* session_ = nullptr;
  std::vector<nav::ScrewPlan> told_;  ///< the screws that stand
  std::optional<Timestamp> last_status_;
  std::int64_t sent_at_status_ = -1;  ///< frames that had gone when the last one was made
};

/// "18944"; or "0.0.0.0:18944" with "192.168.1.0/24" allowed.
Result<igtl::ServerOptions> igtl_options(const IgtlArguments& arguments);

/// Listens where the arguments say, and reports it on standard error; `clients` ends that line with
/// what they may do. `listener` must outlive the server; may be null.
Result<std::unique_ptr<igtl::Server>> serve_igtl(const IgtlArguments& arguments,
                                                 igtl::TextListener* listener, const char* clients);

}  // namespace orthonav::tools

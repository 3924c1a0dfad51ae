#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/live/frame_loop.h"
#include "engine/session/known_errors.h"
#include "engine/session/log/observer_list.h"
#include "engine/session/method.h"
#include "nav/tracking/anchored_tracker.h"

namespace orthonav::engine {

/// Options for assembling an operation.
struct AssemblyOptions {
  /// Visible tools are searched for around their predictions, and the whole image only every tenth
  /// pair.
  nav::TrackerOptions tracker{.full_search_interval = 10};
  /// Its errors that all strokes share are decided by `errors`.
  SessionOptions session;
  KnownErrors errors;
  /// Everything is relative to the patient reference among the tools instead of the headset's map.
  /// The published method has no reference and is refused with this option.
  bool use_reference = false;
  /// Where references lie in the World of a resumed operation.
  std::vector<nav::ReferencePlace> reference_places;
  LoopOptions loop;
  VisibilityRules visibility;

  /// Every problem at once; empty when all is well. The tracker's own problems are found by its
  /// method.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// An operation on a headset, ready to run: the session, the appearance of its guidance, and the
/// loop that feeds it pairs. All arguments are borrowed and must outlive it.
class AssembledOperation {
 public:
  AssembledOperation(Headset& headset, std::unique_ptr<Session> session, const ErrorsInUse& errors,
                     const VisibilityRules& visibility, const LoopOptions& loop);
  AssembledOperation(const AssembledOperation&) = delete;
  AssembledOperation& operator=(const AssembledOperation&) = delete;

  /// Adds an observer of the session, called after those added before; null is ignored.
  void observe(SessionObserver* observer) { observers_.add(observer); }
  /// Adds an observer of each pair and its results, called after those added before; null is
  /// ignored.
  void observe(LoopObserver* observer) { loop_.observe(observer); }
  /// As `Session::resume`; before `run`.
  Status resume(const LoggedOperation& logged) { return session_->resume(logged); }
  /// Sets the source of what the status line says about saving; null: nothing.
  void show_saving(const SaveWatch* saving) { session_->show_saving(saving); }
  /// Where frames are drawn; null: nowhere. Before `run`: the surfaces to be drawn are made here.
  void draw_into(SnapshotSink* sink);
  /// Requests from other programs, in addition to clicker and voice; null: none. Borrowed.
  void hear(Requests* requests) { loop_.hear(requests); }
  /// From now on everything goes through `wrapper`, which forwards to the original headset. For a
  /// recorder, which must start only when nothing else can fail, since its files stay. Call it
  /// before `run`.
  void go_through(Headset& wrapper) { loop_.use(wrapper); }

  /// As `FrameLoop::run`. Call it only once.
  [[nodiscard]] LoopReport run() { return loop_.run(); }
  /// Ends early, from any thread.
  void stop() { loop_.stop(); }

  [[nodiscard]] const Session& session() const { return *session_; }
  /// What the session counts with of the errors that all strokes share.
  [[nodiscard]] const ErrorsInUse& errors() const { return errors_; }

 private:
  ObserverList observers_;
  std::unique_ptr<Session> session_;
  ErrorsInUse errors_;
  SceneBuilder builder_;
  FrameLoop loop_;
};

/// The only way to assemble an operation: the method's tracker for the headset's cameras (or the
/// poses of tools that the headset measures itself), a session, and a loop between the two. `tools`
/// are as described, which differs slightly from the real ones. An Error names what is wrong with
/// the options, the tools or the operation.
Result<std::unique_ptr<AssembledOperation>> assemble_operation(
    Headset& headset, Operation operation, const Method& method,
    const std::vector<nav::ToolGeometry>& tools, const AssemblyOptions& options = {});

}  // namespace orthonav::engine

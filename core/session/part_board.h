#pragma once
/// How far each partition of a search has got, written by the job, read by its owner.
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/run_context.h"

namespace hewn {

/// How far one partition has got.
struct PartProgress {
  enum class State { Waiting, Running, Done, Failed, Stopped };
  std::string name;
  State state = State::Waiting;
  std::string stage = {};   ///< running: what is being done
  double share = 0;         ///< running: of the stage, [0, 1]
  double seconds = 0;       ///< done, failed: since it began
  int size = 0;             ///< done: nodes of its tree
  int literals = 0;         ///< done
  double error = 0;         ///< done: share of fresh points that its tree gets wrong
  std::string reason = {};  ///< failed: why, and what to try

  bool has_ended() const { return state != State::Waiting && state != State::Running; }
};

/// Thread-safe.
class PartBoard {
 public:
  /// Replaces what is known of the part, or adds it. What is done or failed stays so.
  void update(const PartProgress& progress);
  /// The job was stopped: parts that have not ended are marked so.
  void stop();
  /// Stops the search of one part alone, also when it has not begun.
  void stop(const std::string& name);
  /// What stops the part: to be called by the job before it begins with it. `whole`: what stops the
  /// job.
  std::shared_ptr<CancelToken> token_for(const std::string& name,
                                         const std::shared_ptr<CancelToken>& whole);
  /// In the order in which they came first.
  std::vector<PartProgress> parts() const;

 private:
  mutable std::mutex mutex_;
  std::vector<PartProgress> parts_;
  std::map<std::string, std::shared_ptr<CancelToken>> tokens_;  ///< of parts that have begun
};

}  // namespace hewn

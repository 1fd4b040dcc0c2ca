#pragma once
/// Unlimited undo and redo over whole documents, which share what they have in common.
#include <cstdint>
#include <deque>
#include <string>

#include "core/session/document.h"

namespace hewn {

class History {
 public:
  /// Forgets everything and starts at `initial`.
  void reset(Document initial);
  /// A new step named `title`; steps that were undone are forgotten.
  void push(std::string title, Document next);
  /// What a job has read or derived for the current step; no step of its own.
  void amend(Document current);
  /// False when there is no such step.
  bool undo();
  bool redo();

  /// Stays where it is while later steps come and go.
  const Document& current() const { return steps_[at_].document; }
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < steps_.size(); }
  /// The title of what `undo` takes back or `redo` does again. Requires: `can_...`.
  const std::string& undo_title() const { return steps_[at_].title; }
  const std::string& redo_title() const { return steps_[at_ + 1].title; }
  /// Grows whenever `current` becomes another document.
  std::uint64_t edition() const { return edition_; }
  /// Steps done so far.
  std::size_t depth() const { return at_; }

 private:
  struct Step {
    std::string title;  ///< of the command that led here
    Document document;
  };
  std::deque<Step> steps_ = {Step{}};
  std::size_t at_ = 0;
  std::uint64_t edition_ = 1;
};

}  // namespace hewn

#include "app/hewn/interrupt.h"

#include <csignal>
#include <ctime>
#include <string_view>

#include <pthread.h>
#include <unistd.h>

#include "app/hewn/exit_code.h"
#include "core/base/temporary_folder.h"

namespace hewn {
namespace {

/// SIGUSR1 only wakes the thread up when its work is over.
sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGUSR1);
  return set;
}

/// Most stages stop sooner; one that does not look up (a library's) is not waited for. Leaves time
/// to give back a gigabyte within a tenth of a second.
constexpr timespec kGrace{0, 40'000'000};

}  // namespace

Interrupt::Interrupt(std::shared_ptr<CancelToken> cancel) : cancel_(std::move(cancel)) {
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  thread_ = std::thread([this] { wait_for_signals(); });
}

Interrupt::~Interrupt() {
  is_ending_ = true;
  pthread_kill(thread_.native_handle(), SIGUSR1);
  thread_.join();
}

void Interrupt::wait_for_signals() {
  const sigset_t set = watched_signals();
  int signal = 0;
  do {
    if (sigwait(&set, &signal) != 0 || is_ending_) return;
  } while (signal == SIGUSR1);
  cancel_->cancel();
  sigtimedwait(&set, nullptr, &kGrace);
  if (is_ending_) return;
  const std::lock_guard lock(publishing_);
  constexpr std::string_view kMessage = "\nhewn: stopped on request\n";
  [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  TemporaryFolder::remove_all_of_process();
  ::_exit(static_cast<int>(ExitCode::Cancelled));
}

}  // namespace hewn

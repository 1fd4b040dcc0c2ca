#pragma once
/// A disk without room, for as long as it lives.
#include <csignal>

#include <sys/resource.h>

namespace hewn {

/// Files of this process cannot grow beyond `room` bytes: writing fails as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t room = 0) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit none{room, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    static_cast<void>(std::signal(SIGXFSZ, old_handler_));
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

}  // namespace hewn

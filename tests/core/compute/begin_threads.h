#pragma once
#include <chrono>
#include <thread>

#include "core/compute/first_loops.h"

namespace hewn {

/// From then on, loops share their work with other threads however short they are.
inline void begin_threads() {
  begin_alone(1000, 1, [](std::size_t, std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
}

}  // namespace hewn

#pragma once
/// The first loops of a process, which are over before its threads would have begun.
#include <cstddef>
#include <functional>

namespace hewn {

/// Calls `body(begin, end)` on the first of the ranges, each at most `grain` long, that cover
/// [0, n), all on the calling thread, until loops begun like this have taken as long, in the whole
/// process, as the threads take to begin. Returns where the loop is to go on, n if it is done.
/// So a process whose loops are all short never begins threads, and any other one loses at most
/// that time, or a single range's. Takes no time once the threads may begin.
std::size_t begin_alone(std::size_t n, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace hewn

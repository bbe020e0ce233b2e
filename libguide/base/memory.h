#pragma once

#include <cstddef>

namespace waylight {

// What this process may use: the machine's memory, or less where its control group or its limit of
// address space (ulimit -v) says so. Systems grant larger allocations and kill who touches them, so
// who is about to make a large one compares first.
size_t memory_limit_bytes();

}  // namespace waylight

#include "libguide/base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace waylight {
namespace {

constexpr size_t kNoLimit = ~size_t{0};

size_t machine_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGE_SIZE);
  return pages > 0 && page > 0 ? size_t(pages) * size_t(page) : kNoLimit;
}

size_t address_space_bytes() {
  struct rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
  return limit.rlim_cur;
}

// Of a container, which sees its own group as the root. The file holds a number or "max".
size_t control_group_bytes() {
  size_t limit = kNoLimit;
  for (const char* path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(path);
    if (size_t bytes = 0; file >> bytes) limit = std::min(limit, bytes);
  }
  return limit;
}

}  // namespace

size_t memory_limit_bytes() {
  return std::min({machine_bytes(), address_space_bytes(), control_group_bytes()});
}

}  // namespace waylight

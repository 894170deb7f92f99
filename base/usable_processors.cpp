#include "base/usable_processors.h"

#include <sched.h>
#include <algorithm>
#include <cerrno>
#include <cmath>

#include "base/cgroup.h"

namespace swarmsmith {
namespace {

/// Uses a larger mask until it fits: the kernel refuses one that is too short for its processors.
int processors_of_mask() {
  constexpr int kMost = 1 << 20;
  for (int room = CPU_SETSIZE; room <= kMost; room *= 2) {
    cpu_set_t* mask = CPU_ALLOC(static_cast<std::size_t>(room));
    if (mask == nullptr) break;
    const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(room));
    const bool known = sched_getaffinity(0, size, mask) == 0;
    const int error = errno;
    const int processors = known ? CPU_COUNT_S(size, mask) : 0;
    CPU_FREE(mask);
    if (known) return processors;
    if (error != EINVAL) break;
  }
  return 1;
}

}  // namespace

int usable_processors(const std::filesystem::path& root) {
  return processors_within(processors_of_mask(), cgroup_limits(root).processors);
}

int processors_within(int processors, std::optional<double> quota) {
  if (quota && *quota < processors) processors = static_cast<int>(std::lround(*quota));
  return std::max(1, processors);
}

}  // namespace swarmsmith

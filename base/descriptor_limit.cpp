#include "base/descriptor_limit.h"

#include <sys/resource.h>
#include <algorithm>

namespace swarmsmith {

void raise_descriptor_limit(int wanted) {
  struct rlimit limit = {};
  const auto number = static_cast<rlim_t>(wanted);
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= number) return;
  limit.rlim_cur = std::min(limit.rlim_max, number);
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace swarmsmith

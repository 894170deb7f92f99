#include "base/process_limits.h"

#include <sys/resource.h>
#include <algorithm>
#include <filesystem>
#include <iterator>

#include "base/cgroup.h"

namespace swarmsmith {
namespace {

std::string in_mib(std::uint64_t bytes) {
  return std::to_string(bytes >> 20U) + " MiB";
}

std::int64_t open_descriptors() {
  std::error_code trouble;
  const std::filesystem::directory_iterator all("/proc/self/fd", trouble);
  return trouble ? 0 : std::distance(begin(all), end(all));
}

}  // namespace

Expected<void> provide_descriptors(std::int64_t needed, std::int64_t wanted,
                                   const std::string& who) {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return {};
  const auto number = static_cast<rlim_t>(std::max(needed, wanted));
  if (limit.rlim_cur < number) {
    limit.rlim_cur = std::min(limit.rlim_max, number);
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  const std::int64_t open = open_descriptors();
  if (limit.rlim_cur >= static_cast<rlim_t>(open + needed)) return {};
  return unexpected(ErrorKind::Unavailable,
                    who + " needs " + std::to_string(needed) +
                        " open files and connections beside the " + std::to_string(open) +
                        " that are open, and this process may have " +
                        std::to_string(limit.rlim_cur) + " in all: raise the limit (ulimit -n " +
                        std::to_string(std::max<std::int64_t>(1024, open + needed)) +
                        ", or LimitNOFILE of its service)");
}

Expected<void> check_memory(std::uint64_t bytes, std::uint64_t memory, const std::string& who) {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < bytes) {
    return unexpected(ErrorKind::Unavailable,
                      who + " needs " + in_mib(bytes) + " of address space, and this process may " +
                          "have " + in_mib(limit.rlim_cur) + ": raise the limit (ulimit -v " +
                          std::to_string(bytes >> 10U) + ", or unlimited)");
  }
  const auto granted = cgroup_limits().memory_bytes;
  if (!granted || *granted >= memory) return {};
  return unexpected(ErrorKind::Unavailable, who + " needs " + in_mib(memory) +
                                                " of memory, and its control group (of a "
                                                "container, job or service) grants " +
                                                in_mib(*granted));
}

}  // namespace swarmsmith

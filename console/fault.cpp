#include "console/fault.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <typeinfo>
#include <variant>

namespace swarmsmith {
namespace {

constexpr std::uint64_t kMegabyte = 1U << 20U;
/// With less free memory than this, the command has probably used it up with many small objects.
constexpr std::uint64_t kLittle = 512 * kMegabyte;

struct Memory {
  std::uint64_t held = 0;
  std::uint64_t left = std::numeric_limits<std::uint64_t>::max();
};

/// Memory of this process, from the kernel.
Memory memory_now() {
  Memory memory;
  std::uint64_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  memory.held = resident * page;
  std::ifstream host("/proc/meminfo");
  std::string name, unit;
  for (std::uint64_t kilobytes = 0; host >> name >> kilobytes;) {
    std::getline(host, unit);
    if (name == "MemAvailable:") memory.left = kilobytes * 1024;
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t mapped = pages * page;
    memory.left =
        std::min<std::uint64_t>(memory.left, limit.rlim_cur > mapped ? limit.rlim_cur - mapped : 0);
  }
  return memory;
}

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(bytes / kMegabyte) + " MB";
}

std::string sentence_of_own_fault(const std::exception& fault) {
  return std::string("internal error: ") + fault.what() +
         "; this is a bug in the program, not in your input: please report it with the command and "
         "its files";
}

std::string sentence_of_refused_memory() {
  const Memory memory = memory_now();
  const std::string numbers = "this process has " + megabytes(memory.held) + ", and " +
                              megabytes(memory.left) + " are left for it";
  if (memory.left < kLittle) {
    return "there is not enough memory for this (" + numbers +
           "); try a smaller budget, fewer seeds or fewer rows";
  }
  return "memory was refused (" + numbers +
         "): a number in the command or in a file is far too large, or this is a bug: then please "
         "report it with the command and its files";
}

template <class... Types>
bool is_any_of(const std::exception& fault) {
  return ((dynamic_cast<const Types*>(&fault) != nullptr) || ...);
}

}  // namespace

std::string sentence_of_fault(const std::exception& fault) {
  // Such an error is a fault of the program, however much memory there is.
  if (is_any_of<std::bad_array_new_length, std::logic_error, std::bad_optional_access,
                std::bad_variant_access, std::bad_cast, std::bad_typeid, std::bad_function_call>(
          fault)) {
    return sentence_of_own_fault(fault);
  }
  if (is_any_of<std::bad_alloc>(fault)) return sentence_of_refused_memory();
  return fault.what();
}

}  // namespace swarmsmith

#include "worker/slots.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string_view>

#include "base/assert.h"
#include "base/usable_processors.h"

namespace swarmsmith {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

int number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

/// Several Slurm nodes may be on one host, so the node's name has priority.
std::string host_of_this_process() {
  if (std::string node = environment("SLURMD_NODENAME"); !node.empty()) return node;
  std::array<char, HOST_NAME_MAX + 2> host{};  // the last character stays zero
  if (gethostname(host.data(), host.size() - 1) != 0) return "unknown";
  return host.data();
}

/// In squeue's form, "12" or "12_3" for an element of an array; "12_3 restart 1" after Slurm has
/// requeued it once.
std::string job_of_this_process() {
  std::string job = environment("SLURM_JOB_ID");
  if (const std::string array = environment("SLURM_ARRAY_JOB_ID"); !array.empty()) {
    job = array + "_" + environment("SLURM_ARRAY_TASK_ID");
  }
  const std::string restarts = environment("SLURM_RESTART_COUNT");
  if (!job.empty() && number_in(restarts) > 0) job += " restart " + restarts;
  return job;
}

/// Scores must not depend on the processor, but if they do, people will want to know its model.
std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

int in_limits(int slots) {
  return std::clamp(slots, 1, static_cast<int>(kMaxSlots));
}

}  // namespace

int available_slots() {
  if (const int slots = number_in(environment("SLURM_CPUS_PER_TASK")); slots > 0) {
    return in_limits(slots);
  }
  return in_limits(usable_processors());
}

WorkerIdentity identity_of_this_process(int slots, std::string build) {
  SWARMSMITH_ASSERT(slots >= 1 && slots <= static_cast<int>(kMaxSlots),
                    "the wire takes so many slots");
  // A unique name for this process, so it is not drawn from the campaign's random streams.
  std::random_device device;
  std::string id;
  for (std::size_t i = 0; i < kWorkerIdBytes; ++i)
    id += static_cast<char>(device() & 0xffU);
  return {.id = std::move(id),
          .build = std::move(build),
          .slots = slots,
          .host = host_of_this_process(),
          .pid = getpid(),
          .job = job_of_this_process(),
          .cpu = cpu_model()};
}

}  // namespace swarmsmith

#include "worker/slots.h"

#include <sched.h>
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string_view>

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

/// Scores must not depend on it, and when they do, people will want to know it.
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
  cpu_set_t mask;
  CPU_ZERO(&mask);
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) return 1;
  return in_limits(CPU_COUNT(&mask));
}

WorkerIdentity identity_of_this_process(int slots, std::string build) {
  // A name, not a draw of the campaign: it has to differ between processes.
  std::random_device device;
  std::string id;
  for (std::size_t i = 0; i < kWorkerIdBytes; ++i)
    id += static_cast<char>(device() & 0xffU);
  std::string host(HOST_NAME_MAX + 1, '\0');
  if (gethostname(host.data(), host.size()) != 0) host = "unknown";
  host.resize(host.find_first_of('\0') == std::string::npos ? host.size() : host.find('\0'));
  std::string job = environment("SLURM_JOB_ID");
  if (const std::string index = environment("SLURM_ARRAY_TASK_ID"); !index.empty()) {
    job += "_" + index;
  }
  return {.id = std::move(id),
          .build = std::move(build),
          .engine_version = 0,
          .self_test = {},
          .slots = slots,
          .host = std::move(host),
          .pid = getpid(),
          .job = std::move(job),
          .cpu = cpu_model()};
}

}  // namespace swarmsmith

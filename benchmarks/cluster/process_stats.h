#pragma once

#include <cstdint>

namespace swarmsmith::bench {

/// CPU time of this process's threads so far, by their task, in seconds.
struct CpuByThread {
  double main = 0;
  double io = 0;      ///< ZeroMQ's
  double writer = 0;  ///< all other threads, which belong to the store
  double all() const { return main + io + writer; }
};

/// Covers the threads that exist; to be called before they end.
CpuByThread cpu_by_thread();
/// CPU time of the children that have ended and were waited for, in seconds.
double cpu_of_children();
/// Resident memory of this process in MB.
double resident_mb();
/// Raises the limit of open files as far as the system allows; returns the limit.
std::int64_t raise_descriptor_limit();

}  // namespace swarmsmith::bench

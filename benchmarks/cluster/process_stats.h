#pragma once

#include <cstdint>

namespace swarmsmith::bench {

/// CPU of this process's threads so far, by their task, in seconds.
struct CpuByThread {
  double main = 0;
  double io = 0;      ///< ZeroMQ's
  double writer = 0;  ///< all others: the store's
  double all() const { return main + io + writer; }
};

/// Of the threads that live; take it before they end.
CpuByThread cpu_by_thread();
/// CPU of children that ended and were waited for, in seconds.
double cpu_of_children();
/// Resident memory of this process in MB.
double resident_mb();
/// As many open files as the system allows; how many that is.
std::int64_t raise_descriptor_limit();

}  // namespace swarmsmith::bench

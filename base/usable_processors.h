#pragma once

#include <filesystem>
#include <optional>

namespace swarmsmith {

/// The number of processors that this process may use, at least 1: those of its affinity mask, but
/// not more than its control groups allow (base/cgroup.h). All code that decides how much to do in
/// parallel uses this function.
int usable_processors(const std::filesystem::path& root = "/");

/// The number of usable ones among `processors` with a quota, rounded to the nearest integer: half
/// a processor is one slot, and one and a half are two. With too many, the kernel would stop them
/// again and again; with too few, a part would be unused.
int processors_within(int processors, std::optional<double> quota);

}  // namespace swarmsmith

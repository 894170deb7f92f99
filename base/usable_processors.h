#pragma once

#include <filesystem>
#include <optional>

namespace swarmsmith {

/// How many processors this process may keep busy, at least 1: those of its affinity mask, but not
/// more than its control groups grant (base/cgroup.h). Code that decides how much to do at a time
/// asks this function, and no other.
int usable_processors(const std::filesystem::path& root = "/");

/// Of `processors`, with a quota: rounded to the nearest number, so that half a processor is one
/// slot, and one and a half are two. Too many would be stopped by the kernel again and again, too
/// few would leave a part unused.
int processors_within(int processors, std::optional<double> quota);

}  // namespace swarmsmith

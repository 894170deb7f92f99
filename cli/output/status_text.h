#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "coordinator/service/live_status.h"

namespace swarmsmith::cli {

/// The size of a terminal.
struct Screen {
  std::size_t width = 80;
  std::size_t height = 24;
};

/// A running coordinator, for people: campaigns, the use of the slots' time, designs, and hosts
/// with the worst first. At most `height` lines of at most `width` columns. Pure.
std::vector<std::string> status_lines(const LiveStatus& status, const Screen& screen);

/// The most important facts of the status in one line, for logs.
std::string status_summary(const LiveStatus& status);

}  // namespace swarmsmith::cli

#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith::cli {

/// "1h02m", "3m20s", "12s".
std::string duration_text(double seconds);
/// 1234567 as "1 234 567".
std::string grouped(std::int64_t number);

}  // namespace swarmsmith::cli

#pragma once

#include <cstdint>
#include <string>

namespace swarmsmith::cli {

enum class LongestUnit { Hour, Day };

/// "1h02m", "3m20s", "12s"; "2d03h" if days are the longest unit. Negative times count as zero.
std::string duration_text(double seconds, LongestUnit unit = LongestUnit::Hour);
/// "01:02:05"; hours may have more than two digits.
std::string clock_text(double seconds);
/// 1234567 as "1 234 567".
std::string grouped(std::int64_t number);

}  // namespace swarmsmith::cli

#include "console/seeds.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>

#include "base/plain_text.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kLargestSeed = 2'147'483'647;
constexpr std::size_t kMostSeeds = 10'000'000;

/// Accepts the range of irace's seeds.
std::optional<std::int64_t> parse_seed(std::string_view text) {
  std::int64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, seed);
  if (error != std::errc() || stop != end || seed < 1 || seed > kLargestSeed) return std::nullopt;
  return seed;
}

}  // namespace

Expected<std::vector<std::int64_t>> parse_seeds(std::string_view text) {
  std::vector<std::int64_t> seeds;
  const auto wrong = [&] {
    return bad_input("seeds are written like 1-10 or 1,4,7-9, from 1 to 2147483647; this is \"" +
                         std::string(text) + "\"",
                     "--seeds");
  };
  for (const std::string_view part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const auto first = parse_seed(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : parse_seed(part.substr(dash + 1));
    if (!first || !last || *last < *first) return wrong();
    if (static_cast<std::size_t>(*last - *first) + seeds.size() >= kMostSeeds) {
      return bad_input("these are more than ten million seeds; give fewer", "--seeds");
    }
    for (std::int64_t seed = *first; seed <= *last; ++seed)
      seeds.push_back(seed);
  }
  // One run would count more than once in means and intervals.
  std::vector<std::int64_t> sorted = seeds;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    return bad_input("seed " + std::to_string(*twice) + " occurs twice", "--seeds");
  return seeds;
}

}  // namespace swarmsmith

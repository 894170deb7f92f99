#include "irace_core/search/options.h"

#include <array>
#include <cstddef>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kCount = std::variant_size_v<SearchOptions>;

template <std::size_t... I>
std::array<SearchOptions, kCount> all_options(std::index_sequence<I...> /*kinds*/) {
  return {SearchOptions(std::in_place_index<I>)...};
}

constexpr auto kAll = [] {
  std::array<SearchKind, kCount> kinds{};
  for (std::size_t i = 0; i < kCount; ++i)
    kinds[i] = static_cast<SearchKind>(i);
  return kinds;
}();

}  // namespace

std::span<const SearchKind> all_searches() {
  return kAll;
}

SearchOptions search_of(SearchKind kind) {
  static const auto kOptions = all_options(std::make_index_sequence<kCount>());
  const auto index = static_cast<std::size_t>(kind);
  SWARMSMITH_ASSERT(index < kCount, "a search is one of the list");
  return kOptions[index];
}

SearchKind kind_of(const SearchOptions& options) {
  return static_cast<SearchKind>(options.index());
}

const SearchWords& words_of(SearchKind kind) {
  return std::visit([](const auto& options) -> const SearchWords& { return options.kWords; },
                    search_of(kind));
}

std::vector<SearchFault> faults_of(const SearchOptions& options) {
  return std::visit(
      [](const auto& kind) -> std::vector<SearchFault> {
        if constexpr (requires { kind.faults(); }) return kind.faults();
        return {};
      },
      options);
}

}  // namespace swarmsmith

#include "irace_core/search/options.h"

#include <algorithm>
#include <array>

#include "base/assert.h"

namespace swarmsmith {
namespace {

constexpr std::array kWords = {
    SearchWords{SearchKind::Irace, "irace", "iteration", "racing", "race", "configuration", true},
    SearchWords{SearchKind::Random, "random", "part", "searching", "final stage", "configuration"},
    SearchWords{
        SearchKind::FRace, "f-race", "race", "racing", "race", "configuration", true,
        "f-race cannot be extended: its configurations are drawn once, and how many follows "
        "from the whole budget. Run the campaign with the larger budget into a new store"},
    SearchWords{SearchKind::Evolution, "evolution", "generation", "searching", "final stage",
                "member"},
    SearchWords{SearchKind::CmaEs, "cma-es", "generation", "searching", "final stage", "member"},
    SearchWords{SearchKind::Annealing, "annealing", "part", "searching", "final stage",
                "configuration", false,
                "annealing cannot be extended: its temperatures follow from the whole budget. Run "
                "the campaign with the larger budget into a new store"},
};

constexpr auto kAll = [] {
  std::array<SearchKind, kWords.size()> kinds{};
  std::ranges::transform(kWords, kinds.begin(), &SearchWords::kind);
  return kinds;
}();

}  // namespace

std::span<const SearchKind> all_searches() {
  return kAll;
}

const SearchWords& words_of(SearchKind kind) {
  const auto* found = std::ranges::find(kWords, kind, &SearchWords::kind);
  SWARMSMITH_ASSERT(found != kWords.end(), "each kind has its words");
  return *found;
}

int version_of(SearchKind) {
  return 1;
}

}  // namespace swarmsmith

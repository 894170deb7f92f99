#include "irace_core/search/options.h"

#include <array>

#include "base/assert.h"

namespace swarmsmith {
namespace {

constexpr std::array kAll = {SearchKind::Irace,     SearchKind::Random, SearchKind::FRace,
                             SearchKind::Evolution, SearchKind::CmaEs,  SearchKind::Annealing};

}  // namespace

std::span<const SearchKind> all_searches() {
  return kAll;
}

std::string_view name_of(SearchKind kind) {
  switch (kind) {
    case SearchKind::Irace:
      return "irace";
    case SearchKind::Random:
      return "random";
    case SearchKind::FRace:
      return "f-race";
    case SearchKind::Evolution:
      return "evolution";
    case SearchKind::CmaEs:
      return "cma-es";
    case SearchKind::Annealing:
      break;
  }
  return "annealing";
}

int version_of(SearchKind) {
  return 1;
}

}  // namespace swarmsmith

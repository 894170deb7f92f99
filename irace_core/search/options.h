#pragma once

#include <span>
#include <string_view>

#include "irace_core/search/search_parts.h"
#include "irace_core/search/searches.h"

namespace swarmsmith {

/// All searches, in the order in which they are listed.
std::span<const SearchKind> all_searches();

/// The search with the default values of all its options.
SearchOptions search_of(SearchKind kind);

SearchKind kind_of(const SearchOptions& options);

const SearchWords& words_of(SearchKind kind);
inline const SearchWords& words_of(const SearchOptions& options) {
  return words_of(kind_of(options));
}

/// The name in campaign files.
inline std::string_view name_of(SearchKind kind) {
  return words_of(kind).name;
}

/// Calls `visitor(SearchField, member)` for each key of the search's table.
template <class Options, class Visitor>
void visit_search_fields(Options& options, Visitor& visitor) {
  std::visit([&]<class Kind>(Kind& kind) { kind.fields(kind, visitor); }, options);
}

/// The errors in combinations of options.
std::vector<SearchFault> faults_of(const SearchOptions& options);

}  // namespace swarmsmith

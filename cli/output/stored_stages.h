#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "cli/output/query_output.h"
#include "irace_core/search/stage.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// How the designs of a store are searched for, where it is not by iterated racing, and how far
/// they are. Empty for a store of races: nothing is read but the campaigns' files.
class StoredStages {
 public:
  /// Of all designs, or of `only`. A campaign file that this version cannot read says nothing of
  /// its searches.
  static Expected<StoredStages> read(StoreReader& store, std::optional<DesignId> only = {});

  bool empty() const { return designs_.empty(); }
  /// Null for a race by irace. `design` as a number, or with its d.
  const SearchOptions* search(std::string_view design) const;
  /// "generation 41 of 90"; "iteration 5" of races by irace.
  std::string stage(std::string_view design, std::string_view iteration) const;
  /// The part of the search that the iteration was: "generation 4", "final stage".
  std::string round(std::string_view design, std::string_view iteration) const;
  /// The one that the design is in, or ended with.
  std::string round(std::string_view design) const;
  /// What the part began with: "generation 4 of 22: 20 members, 5 runs each".
  std::string round_line(std::string_view design, std::int64_t iteration) const;
  bool is_final(std::string_view design, std::int64_t iteration) const;

  /// For people: the column `iteration` of rows with a `design` becomes where each search is, and
  /// nothing races where nothing is tested.
  void tell(Rows& rows) const;

 private:
  struct Design {
    SearchOptions search;
    SearchPoint now;
    std::map<std::int64_t, SearchPoint> iterations;  ///< as they were when they ended
  };
  const Design* find(std::string_view design) const;
  std::string part(std::string_view design, std::int64_t iteration, bool with_size) const;

  std::map<std::int64_t, Design> designs_;
};

/// A column is called otherwise from here on; nothing without it.
void rename_column(Rows& rows, std::string_view from, std::string_view to);
void remove_column(Rows& rows, std::string_view name);

}  // namespace swarmsmith::cli

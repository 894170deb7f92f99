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

/// The searches of a store's designs other than iterated racing, and how far they are. Empty for a
/// store that has only races; then nothing but the campaigns' files is read.
class StoredStages {
 public:
  /// For all designs, or only for `only`. Searches in a campaign file that this version cannot read
  /// are left out.
  static Expected<StoredStages> read(StoreReader& store, std::optional<DesignId> only = {});

  bool empty() const { return designs_.empty(); }
  /// Null for a race by irace. `design`: the number, with or without the letter d.
  const SearchOptions* search(std::string_view design) const;
  /// "generation 41 of 90"; "iteration 5" for races by irace.
  std::string stage(std::string_view design, std::string_view iteration) const;
  /// The name of an iteration in the search's own terms: "generation 4", "final stage".
  std::string round(std::string_view design, std::string_view iteration) const;
  /// The name of the design's current iteration, or of its last one.
  std::string round(std::string_view design) const;
  /// How the iteration began: "generation 4 of 22: 20 members, 5 runs each".
  std::string round_line(std::string_view design, std::int64_t iteration) const;
  bool is_final(std::string_view design, std::int64_t iteration) const;

  /// Changes rows for people: if there are columns `design` and `iteration`, the iteration becomes
  /// the stage of the search, and the state "racing" becomes the search's own word for it.
  void tell(Rows& rows) const;

 private:
  struct Design {
    SearchOptions search;
    SearchPoint now;
    std::map<std::int64_t, SearchPoint> iterations;  ///< each as it was at its end
  };
  const Design* find(std::string_view design) const;
  std::string part(std::string_view design, std::int64_t iteration, bool with_size) const;

  std::map<std::int64_t, Design> designs_;
};

/// Renames a column, if there is one with this name.
void rename_column(Rows& rows, std::string_view from, std::string_view to);
void remove_column(Rows& rows, std::string_view name);

}  // namespace swarmsmith::cli

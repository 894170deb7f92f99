#pragma once

#include <string>
#include <vector>

#include "analysis/report/html.h"
#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// How the cells of a column are shown.
enum class Show {
  Text,
  Name,       ///< with blanks: "color selection"
  Count,      ///< an integer as it is
  Number,     ///< four significant digits
  Percent,    ///< a part of one
  Design,     ///< "d3"
  Candidate,  ///< "c812"
  YesNo,
};

struct ViewColumn {
  std::string title;
  Show show = Show::Text;
};

/// The rows of a statement over the store's views; a column of the statement for each one here,
/// null as "-". Beyond `most` rows the caption says how many there are.
Expected<HtmlTable> view_table(StoreReader& store, const std::string& caption,
                               const std::vector<ViewColumn>& columns, const std::string& sql,
                               std::size_t most = 200);

/// Names and values: a statement with two columns.
Expected<std::vector<std::pair<std::string, std::string>>> view_facts(StoreReader& store,
                                                                      const std::string& sql);

}  // namespace swarmsmith

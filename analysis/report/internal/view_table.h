#pragma once

#include <string>
#include <vector>

#include "analysis/report/html.h"
#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// The format of a column's cells.
enum class Show {
  Text,
  Name,       ///< with blanks: "color selection"
  Count,      ///< a whole number
  Number,     ///< four significant digits
  Percent,    ///< a fraction, shown as a percentage
  Design,     ///< "d3"
  Candidate,  ///< "c812"
  YesNo,
};

struct ViewColumn {
  std::string title;
  Show show = Show::Text;
};

/// The rows of a statement over the store's views. The statement must return one column for each of
/// `columns`; null is shown as "-". If there are more than `most` rows, the caption says how many.
Expected<HtmlTable> view_table(StoreReader& store, const std::string& caption,
                               const std::vector<ViewColumn>& columns, const std::string& sql,
                               std::size_t most = 200);

/// Names and values from a statement with two columns.
Expected<std::vector<std::pair<std::string, std::string>>> view_facts(StoreReader& store,
                                                                      const std::string& sql);

}  // namespace swarmsmith

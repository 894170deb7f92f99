#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/internal/page_image.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What was found of one table (the fields are those of SalvagedTable in storage/recover.h).
struct TableFind {
  std::string name;
  std::int64_t rows = 0;
  std::int64_t lost_pages = 0;  ///< pages that its tree names, but that are not its pages
  std::int64_t broken = 0;      ///< incomplete rows on its pages
  bool tree_is_lost = false;    ///< the table's first page is unknown: it may have had more rows
};

struct PageFind {
  std::int64_t schema = 0;
  bool schema_is_guessed = false;  ///< the header does not give it
  std::int64_t pages = 0;
  std::int64_t unplaced = 0;  ///< rows on pages that no tree names, and that might be of two tables
  std::vector<TableFind> tables;
};

/// Copies every complete row on the pages into an empty database. The database gets the tables of
/// the schema that the file had, and is then migrated to the newest. Pages are found by the trees
/// of the tables, or, where these are broken, by their content. Throws SqliteError when the new
/// file fails.
PageFind salvage_pages(PageImage& image, sqlite::Connection& into);

}  // namespace swarmsmith

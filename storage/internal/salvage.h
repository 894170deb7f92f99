#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/internal/page_image.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// What was found of one table.
struct TableFind {
  std::string name;
  std::int64_t rows = 0;
  std::int64_t lost_pages = 0;  ///< that its tree names, and that are not pages of it
  std::int64_t broken = 0;      ///< rows of its pages that are not whole
  bool tree_is_lost = false;    ///< where it begins is not known: there may have been more
};

struct PageFind {
  std::int64_t schema = 0;
  bool schema_is_guessed = false;  ///< the header says none
  std::int64_t pages = 0;
  std::int64_t unplaced = 0;  ///< rows on pages that no tree names, and that might be of two tables
  std::vector<TableFind> tables;
};

/// Puts every whole row that is on the pages into an empty database, which gets the tables of the
/// schema that the file had, and is then brought to the newest. Pages are found by the tables'
/// trees, and where these are broken by what is on them. Throws SqliteError when the new file
/// fails.
PageFind salvage_pages(PageImage& image, sqlite::Connection& into);

}  // namespace swarmsmith

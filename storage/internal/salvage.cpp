#include "storage/internal/salvage.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "storage/internal/btree_page.h"
#include "storage/internal/schema.h"
#include "storage/internal/table_shape.h"

namespace swarmsmith {
namespace {

using sqlite::Connection;
using sqlite::Statement;

std::vector<TableShape> shapes_made(std::int64_t schema) {
  std::vector<TableShape> shapes;
  // From the earliest schema on: a record may lack columns that a later schema added.
  std::map<std::pair<std::string, bool>, std::size_t> first_columns;
  for (std::int64_t earlier = 1; earlier <= schema; ++earlier) {
    Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    create_tables(memory, earlier);
    shapes = table_shapes(memory);
    for (const TableShape& shape : shapes)
      first_columns.try_emplace({shape.tree, shape.has_rowids}, shape.columns.size());
  }
  for (TableShape& shape : shapes)
    shape.least_columns = first_columns.at({shape.tree, shape.has_rowids});
  return shapes;
}

/// The shapes of a schema, made once: a guess uses those of each schema, for each page size.
const std::vector<TableShape>& shapes_of_schema(std::int64_t schema) {
  static std::mutex mutex;
  static std::map<std::int64_t, std::vector<TableShape>> made;
  const std::scoped_lock lock(mutex);
  const auto known = made.find(schema);
  return known != made.end() ? known->second
                             : made.emplace(schema, shapes_made(schema)).first->second;
}

/// A row of sqlite_schema that names a table or an index: its name, and the first page of its tree.
std::optional<std::pair<std::string, std::uint32_t>> root_in(const StoredRecord& record) {
  using Type = StoredValue::Type;
  const auto& values = record.values;
  const bool is_schema_row = record.rowid && values.size() == 5 && values[0].type == Type::Text &&
                             values[1].type == Type::Text && values[3].type == Type::Integer &&
                             (values[0].bytes == "table" || values[0].bytes == "index");
  if (!is_schema_row || values[3].integer < 2) return std::nullopt;
  return std::pair(values[1].bytes, static_cast<std::uint32_t>(values[3].integer));
}

/// Reads the rows from the pages, table by table.
class Salvager {
 public:
  Salvager(const PageImage& image, std::vector<TableShape> shapes)
      : image_(image),
        numbers_(image.numbers()),
        chained_(kReadings * image.bytes()),
        shapes_(std::move(shapes)),
        finds_(shapes_.size()) {
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      finds_[i].name = shapes_[i].name;
    for (const std::uint32_t page : image_.free_pages())
      seen_.insert(page);
    find_roots();
  }

  /// Calls on_row(shape, record) with every complete row.
  template <class OnRow>
  void each_row(OnRow on_row) {
    for (std::size_t table = 0; table < shapes_.size(); ++table) {
      const auto root = roots_.find(shapes_[table].tree);
      finds_[table].tree_is_lost = root == roots_.end();
      if (root != roots_.end()) walk(table, root->second, on_row);
    }
    // After the trees: a tree says to which table its pages belong, and for a stray page this is a
    // guess.
    for (const std::uint32_t number : numbers_) {
      if (!seen_.contains(number)) take_stray(number, on_row);
    }
  }

  const std::vector<TableFind>& finds() const { return finds_; }
  std::int64_t unplaced() const { return unplaced_; }

 private:
  void find_roots() {
    for (const std::uint32_t number : numbers_) {
      if (seen_.contains(number)) continue;
      const auto page = read_btree_page(image_, number, chained_);
      if (!page) continue;
      for (const StoredRecord& record : page->records) {
        if (const auto root = root_in(record)) roots_.insert(*root);
      }
    }
  }

  template <class OnRow>
  void walk(std::size_t table, std::uint32_t root, OnRow& on_row) {
    std::vector<std::uint32_t> open{root};
    while (!open.empty()) {
      const std::uint32_t number = open.back();
      open.pop_back();
      if (seen_.contains(number)) continue;
      const auto page = read_btree_page(image_, number, chained_);
      if (!page || page->has_rowids != shapes_[table].has_rowids) {
        ++finds_[table].lost_pages;
        continue;
      }
      seen_.insert(number);
      open.insert(open.end(), page->children.rbegin(), page->children.rend());
      finds_[table].broken += page->broken;
      for (const StoredRecord& whole : page->records) {
        // In a known tree, columns that other programs added are left out.
        const std::size_t columns = shapes_[table].columns.size();
        StoredRecord cut;
        if (whole.values.size() > columns) {
          cut = whole;
          cut.values.resize(columns);
        }
        const StoredRecord& record = whole.values.size() > columns ? cut : whole;
        if (shapes_[table].fits(record)) {
          ++finds_[table].rows;
          on_row(table, record);
        } else {
          ++finds_[table].broken;
        }
      }
    }
  }

  /// A page to which no tree leads: its rows are used if only one table can have them.
  template <class OnRow>
  void take_stray(std::uint32_t number, OnRow& on_row) {
    const auto page = read_btree_page(image_, number, chained_);
    if (!page) return;
    for (const StoredRecord& record : page->records) {
      std::optional<std::size_t> place;
      int places = 0;
      for (std::size_t table = 0; table < shapes_.size(); ++table) {
        // Rows of one index cannot be told from those of another.
        const bool is_table = shapes_[table].tree == shapes_[table].name;
        if (!is_table || !shapes_[table].fits(record)) continue;
        place = table;
        ++places;
      }
      if (places == 1) {
        ++finds_[*place].rows;
        on_row(*place, record);
      } else if (places > 1) {
        ++unplaced_;
      }
    }
  }

  /// A complete record is read at most three times: in the search for roots, by its tree, and as a
  /// stray. The rest is for broken records, whose chains may lead anywhere.
  static constexpr std::uint64_t kReadings = 16;

  const PageImage& image_;
  std::vector<std::uint32_t> numbers_;
  std::uint64_t chained_;
  std::vector<TableShape> shapes_;
  std::vector<TableFind> finds_;
  std::map<std::string, std::uint32_t> roots_;
  std::set<std::uint32_t> seen_;
  std::int64_t unplaced_ = 0;
};

std::int64_t rows_found(const PageImage& image, std::int64_t schema) {
  Salvager salvager(image, shapes_of_schema(schema));
  std::int64_t rows = 0;
  salvager.each_row([&](std::size_t, const StoredRecord&) { ++rows; });
  return rows;
}

/// For a file without a header: sets the page size, and returns the schema, that give the most
/// rows.
std::int64_t guess(PageImage& image) {
  // The project's own page size is first, so that it is used if another gives as many rows.
  constexpr std::array<std::size_t, 8> kSizes{8192, 4096, 1024, 16384, 2048, 512, 32768, 65536};
  std::size_t best_size = kSizes.front();
  std::int64_t most = -1;
  if (image.knows_page_size()) best_size = image.page_size();
  for (const std::size_t size : kSizes) {
    if (image.knows_page_size() && size != image.page_size()) continue;
    image.set_page_size(size);
    const std::int64_t rows = rows_found(image, kSchemaVersion);
    if (rows > most) best_size = size;
    most = std::max(most, rows);
  }
  image.set_page_size(best_size);
  std::int64_t best = kSchemaVersion;
  for (std::int64_t schema = kSchemaVersion - 1; schema >= 1; --schema) {
    const std::int64_t rows = rows_found(image, schema);
    if (rows <= most) continue;
    most = rows;
    best = schema;
  }
  return best;
}

void bind(sqlite3_stmt* statement, int at, const StoredValue& value) {
  using Type = StoredValue::Type;
  const auto size = static_cast<sqlite3_uint64>(value.bytes.size());
  switch (value.type) {
    case Type::Null:
      sqlite3_bind_null(statement, at);
      return;
    case Type::Integer:
      sqlite3_bind_int64(statement, at, value.integer);
      return;
    case Type::Real:
      sqlite3_bind_double(statement, at, value.real);
      return;
    case Type::Text:
      sqlite3_bind_text64(statement, at, value.bytes.data(), size, SQLITE_STATIC, SQLITE_UTF8);
      return;
    case Type::Blob:
      sqlite3_bind_blob64(statement, at, value.bytes.data(), size, SQLITE_STATIC);
      return;
  }
}

/// Inserts rows into the tables of a new database.
class Filler {
 public:
  Filler(Connection& into, const std::vector<TableShape>& shapes) : into_(into), shapes_(shapes) {}

  /// False when there is a row with that key.
  bool put(std::size_t table, const StoredRecord& record) {
    const TableShape& shape = shapes_[table];
    const std::size_t columns = record.values.size();
    const auto known = statements_.try_emplace({table, columns}, into_, shape.insertion(columns));
    Statement& insertion = known.first->second;
    insertion.reset();
    for (std::size_t i = 0; i < columns; ++i)
      bind(insertion.handle(), static_cast<int>(i) + 1, record.values[i]);
    if (shape.alias >= 0) sqlite3_bind_int64(insertion.handle(), shape.alias + 1, *record.rowid);
    insertion.step();
    return into_.changes() > 0;
  }

 private:
  Connection& into_;
  const std::vector<TableShape>& shapes_;
  std::map<std::pair<std::size_t, std::size_t>, Statement> statements_;
};

}  // namespace

PageFind salvage_pages(PageImage& image, Connection& into) {
  const std::int64_t said = image.user_version();
  PageFind found;
  found.schema_is_guessed = said < 1 || said > kSchemaVersion;
  found.schema = found.schema_is_guessed ? guess(image) : said;
  found.pages = static_cast<std::int64_t>(image.numbers().size());
  const std::vector<TableShape>& shapes = shapes_of_schema(found.schema);
  Salvager salvager(image, shapes);
  std::vector<std::int64_t> doubled(shapes.size());
  {
    sqlite::Transaction transaction(into);
    create_tables(into, found.schema);
    Filler filler(into, shapes);
    salvager.each_row([&](std::size_t table, const StoredRecord& record) {
      if (!filler.put(table, record)) ++doubled[table];
    });
    finish_schema(into, found.schema);
    transaction.commit();
  }
  upgrade(into, migrations());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    TableFind find = salvager.finds()[i];
    find.rows -= doubled[i];
    if (shapes[i].tree == shapes[i].name) {
      found.tables.push_back(find);
    } else {  // rows that the table itself had lost
      std::ranges::find(found.tables, find.name, &TableFind::name)->rows += find.rows;
    }
  }
  found.unplaced = salvager.unplaced();
  return found;
}

}  // namespace swarmsmith

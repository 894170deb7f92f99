#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "base/text/document.h"

namespace swarmsmith {

/// Everything that is wrong with a file, in the order of the file.
class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  void add(FilePlace place, std::string message);
  /// Something wrong in another file, which `place` names.
  void add_foreign(FilePlace place, Error error);
  bool empty() const { return complaints_.empty(); }
  std::size_t count() const { return complaints_.size(); }
  /// Sorted by place; those without one come last.
  std::vector<Error> take();

 private:
  std::string file_;
  std::vector<std::pair<FilePlace, Error>> complaints_;
};

/// "2 min" or "2min" as 120; units are ms, s, min and h.
std::optional<double> parse_seconds(std::string_view text);

/// Ends of a range, both included.
template <class Number>
struct Limits {
  Number least;
  Number most;
};

/// Takes a table apart by key and remembers what was asked for, so that `finish` can complain about
/// the rest. A getter gives nothing when the key is missing, and also, after a complaint, when its
/// value is none of what it should be; `has` tells the two apart.
class TableReader {
 public:
  /// `path` is the table's place in the file, such as `mission.arena`; empty for the whole file.
  /// `table` must outlive the reader.
  TableReader(const Node& table, std::string path, Complaints& complaints, bool in_list = false);

  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// What sentences call the table: [campaign], [[mission]], or "the file".
  std::string name() const;
  FilePlace place() const { return table_->place; }
  /// Where the key's value is, else where the table is.
  FilePlace place_of(std::string_view key) const;
  void complain(std::string_view key, std::string message);
  /// How much was wrong so far, in all tables of the file.
  std::size_t complaints() const { return complaints_->count(); }
  /// Something wrong in another file, which the key names; when that is not there, the key's value
  /// is what is wrong.
  void complain_foreign(std::string_view key, Error error);

  std::optional<bool> boolean(std::string_view key);
  std::optional<std::int64_t> integer(std::string_view key, Limits<std::int64_t> limits);
  /// Integers are numbers, too.
  std::optional<double> number(std::string_view key, Limits<double> limits);
  std::optional<std::string> text(std::string_view key);
  /// A text out of `choices`; those in `not_yet` are refused with a sentence of their own.
  std::optional<std::string> choice(std::string_view key, std::span<const std::string> choices,
                                    std::span<const std::string> not_yet = {});
  /// "30 s", "2 min", "500 ms", "1 h" as seconds.
  std::optional<double> seconds(std::string_view key, Limits<double> limits);
  /// 2027-01-31, without quotes.
  std::optional<std::chrono::year_month_day> date(std::string_view key);
  std::optional<std::vector<std::string>> texts(std::string_view key);
  std::optional<Limits<double>> interval(
      std::string_view key, std::string_view wanted = "a range of two numbers, such as [1, 100]");
  /// A list of lists of `width` numbers each; `example` shows one in complaints.
  std::optional<std::vector<std::vector<double>>> number_rows(std::string_view key,
                                                              std::size_t width,
                                                              Limits<double> limits,
                                                              std::string_view example);
  /// A table below this one; its own reader must `finish` as well.
  std::optional<TableReader> table(std::string_view key);
  std::vector<TableReader> tables(std::string_view key);

  /// The key, whatever is in it, as asked for.
  const Node* take(std::string_view key);
  /// Keys that were not asked for, now as readers of tables (for tables with names as keys).
  std::vector<std::pair<std::string, const Node*>> take_all();

  /// Complains about keys that were not asked for. `not_yet` names keys that exist elsewhere and
  /// that this version lacks.
  void finish(std::span<const std::string> not_yet = {});

 private:
  const Table::Entry* find(std::string_view key) const;
  std::string path_of(std::string_view key) const;
  void complain_type(const Node& node, std::string_view key, std::string_view wanted);

  const Node* table_;
  std::string path_;
  bool in_list_;
  Complaints* complaints_;
  std::set<std::string, std::less<>> asked_;
};

/// Whether a word that could be a name is meant as a file: it ends in .toml or has a slash.
bool names_a_file(const std::string& word);

/// Whether a name is good for stores, command lines and files: letters, digits, `_`, `-`, `.`.
bool is_name(std::string_view name);

/// Complains under `name` and says so when it is none, or when it is in `taken`.
bool check_name(TableReader& reader, const std::string& name,
                const std::vector<std::string>& taken);

/// Files begin with `format = 1`; one of a later format is refused before its unknown keys confuse
/// anybody.
void read_format(TableReader& root);

}  // namespace swarmsmith

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

/// All errors in a file, in the order of the file.
class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  void add(FilePlace place, std::string message);
  /// Adds an error in another file, which this file names at `place`.
  void add_foreign(FilePlace place, Error error);
  bool empty() const { return complaints_.empty(); }
  std::size_t count() const { return complaints_.size(); }
  /// Sorted by place; errors without a place come last.
  std::vector<Error> take();

 private:
  std::string file_;
  std::vector<std::pair<FilePlace, Error>> complaints_;
};

/// "2 min" or "2min" as 120; units are ms, s, min and h.
std::optional<double> parse_seconds(std::string_view text);

/// Both ends of a range, which belong to it.
template <class Number>
struct Limits {
  Number least;
  Number most;
};

/// Reads a table key by key and remembers which keys were read, so that `finish` can complain about
/// the others. A getter returns empty when the key is missing, and also, after a complaint, when
/// its value is not valid; `has` distinguishes the two cases.
class TableReader {
 public:
  /// `path` is the table's path in the file, such as `mission.arena`; empty for the whole file.
  /// `table` must outlive the reader.
  TableReader(const Node& table, std::string path, Complaints& complaints, bool in_list = false);

  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// The table's name in messages: [campaign], [[mission]], or "the file".
  std::string name() const;
  FilePlace place() const { return table_->place; }
  /// The place of the key's value, or of the table if the key is missing.
  FilePlace place_of(std::string_view key) const;
  void complain(std::string_view key, std::string message);
  /// Number of errors so far, in all tables of the file.
  std::size_t complaints() const { return complaints_->count(); }
  /// Adds an error in another file, which the key names. If that file does not exist, the error is
  /// in the key's value.
  void complain_foreign(std::string_view key, Error error);

  std::optional<bool> boolean(std::string_view key);
  std::optional<std::int64_t> integer(std::string_view key, Limits<std::int64_t> limits);
  /// Integers are accepted, too.
  std::optional<double> number(std::string_view key, Limits<double> limits);
  std::optional<std::string> text(std::string_view key);
  /// One of the texts in `choices`; those in `not_yet` are refused with another message.
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

  /// Returns the key's value, whatever it is, and counts it as read.
  const Node* take(std::string_view key);
  /// The keys that were not read, as for tables whose keys are names; they count as read from now
  /// on.
  std::vector<std::pair<std::string, const Node*>> take_all();

  /// Complains about keys that were not read. `not_yet` names keys that exist elsewhere but not in
  /// this version.
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

/// Whether a word that could be a name means a file: it ends in .toml or has a slash.
bool names_a_file(const std::string& word);

/// Whether a name is valid in stores, command lines and files: letters, digits, `_`, `-`, `.`.
bool is_name(std::string_view name);

/// Returns whether the name is valid and not in `taken`, and complains under `name` if not.
bool check_name(TableReader& reader, const std::string& name,
                const std::vector<std::string>& taken);

/// Files begin with `format = 1`. A file of a later format is refused before its unknown keys cause
/// confusing messages.
void read_format(TableReader& root);

}  // namespace swarmsmith

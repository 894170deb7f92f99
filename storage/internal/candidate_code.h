#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/rows.h"

namespace swarmsmith {

/// How the texts of candidates are stored. The texts of a campaign's candidates are very similar,
/// so a text is cut into phrases, and each phrase is stored once in the table `phrase`:
///
///   parameters  {"S0":"exploration","RWM0":56,"NumConnections0":1,"N0x0":0,"P0x0":0.5}
///   machine     --s0 0 --rwm0 56 --n0 1 --n0x0 0 --p0x0 0.5
///   phrases     1: "S0":"exploration","RWM0":                  --s0 0 --rwm0
///               2: "NumConnections0":1,"N0x0":0,"P0x0":        --n0 1 --n0x0 0 --p0x0
///   code        {"1":"56","2":"0.5"}
///
/// A code is a list of phrases in order, each with the number that follows it in both texts (no
/// number after a phrase of choices alone). The parameters are the phrases joined by commas and put
/// in braces; the machine is the phrases joined by blanks. The views do the same in SQL. `modules`
/// has its own code, an array of phrases.

/// A part of a text that candidates share; a field is empty if the phrase is not part of that text.
struct Phrase {
  std::optional<std::string> machine;
  std::optional<std::string> parameters;
  std::optional<std::string> modules;

  friend bool operator==(const Phrase&, const Phrase&) = default;
};

/// The texts of a candidate as they are in its row. Without a code, a text is stored as it is; with
/// a code, an empty text has to be made from the code.
struct StoredTexts {
  std::string machine;
  std::string parameters;
  std::string modules;
  std::optional<std::string> code;  ///< of the parameters, and of the machine if that is empty
  std::optional<std::string> module_code;  ///< of modules
};

/// The phrases of a store, a dictionary that grows with the rows. Every text can be stored: a text
/// that cannot be cut into phrases is stored as it is. Not thread-safe.
class PhraseBook {
 public:
  using OnNew = std::function<void(std::int64_t number, const Phrase& phrase)>;

  /// Reads every phrase of the table. Throws SqliteError.
  void load(const sqlite::Connection& connection);
  void clear();

  /// The form in which the row is stored. Calls `on_new` for each phrase that the table does not
  /// have yet.
  StoredTexts encode(const CandidateRow& row, const OnNew& on_new);

  /// Fills in the three texts of `row`. False when a code does not fit the phrases, or when it
  /// would make a text, or all texts together, longer than allowed: the store is damaged, or was
  /// made to fill memory.
  bool decode(const StoredTexts& stored, CandidateRow& row);

 private:
  /// For one text that a code makes. Texts of real candidates have a few kB.
  static constexpr std::size_t kMostTextBytes = 8 << 20;
  /// For all texts of a store, as a multiple of its file size: those of real candidates have twice
  /// the size of the file.
  static constexpr std::int64_t kMostTimesFile = 64;
  static constexpr std::int64_t kAlwaysAllowed = 64 << 20;

  struct Piece {
    Phrase phrase;
    std::string number;
  };
  void add(std::int64_t number, Phrase phrase);
  std::optional<std::vector<Piece>> cut_parameters(const std::string& parameters,
                                                   const std::string& machine);
  std::optional<std::vector<std::int64_t>> numbers_of(const std::vector<Piece>& pieces,
                                                      const OnNew& on_new);
  void encode_parameters(const OnNew& on_new, StoredTexts& stored);
  void encode_modules(const OnNew& on_new, StoredTexts& stored);

  std::unordered_map<std::int64_t, Phrase> phrases_;
  std::unordered_map<std::string, std::int64_t> numbers_;  ///< the key is all texts of the phrase
  std::int64_t last_ = 0;
  /// How many bytes codes may still make.
  std::int64_t left_ = kAlwaysAllowed;
  /// Parameters whose numbers follow a phrase, since they have too many values to be part of one.
  std::unordered_set<std::string> open_;
};

}  // namespace swarmsmith

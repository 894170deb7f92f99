#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/store.h"

namespace swarmsmith {

/// Rows found and lost of one table of a damaged store.
struct SalvagedTable {
  std::string name;
  std::int64_t rows = 0;        ///< whole ones
  std::int64_t lost_pages = 0;  ///< that held more of them, and cannot be read
  std::int64_t broken = 0;      ///< rows that lost a part
  bool tree_is_lost = false;    ///< where it began is not known: there may have been more
};

struct Salvaged {
  /// Evaluations that are not those that were written: another program, or damage, changed them.
  /// They are left out.
  std::int64_t changed_evaluations = 0;
  std::int64_t schema = 0;
  bool header_is_damaged = false;  ///< sizes and schema were concluded from the pages
  std::int64_t pages = 0;
  std::int64_t unplaced = 0;  ///< rows whose table is unknown
  std::vector<SalvagedTable> tables;
};

/// What of one campaign's rows follows from its scores (coordinator/design/rebuild.h), and what has
/// to go.
struct DerivedRows {
  std::vector<Row> rows;  ///< by the ids of a store of its own
  /// Scores that would count anywhere but were not requested (of tests): they are removed.
  std::vector<EvaluationKey> unasked;
};

/// A new store made from the readable parts of a damaged one: page by page, without SQLite, every
/// complete row, including those of the write-ahead log. The damaged file is only read. The order
/// of calls: `begin`; `put_campaign` if there is none; `put_designs` and `replace_derived` for each
/// campaign whose races can be replayed; `finish`.
class Recovery {
 public:
  /// Errors: BadInput (no such file, or the new name exists), Corrupt (it has no part of a store),
  /// Newer (by its header), Unavailable (the disk refuses).
  static Expected<std::unique_ptr<Recovery>> begin(const std::filesystem::path& damaged,
                                                   const std::filesystem::path& into);
  virtual ~Recovery() = default;

  virtual const Salvaged& found() const = 0;
  /// Campaigns whose row was found; may be none.
  virtual std::vector<StoredCampaign> campaigns() = 0;
  /// Takes away what workers of a key said (of a host without keys: of its address), and all that
  /// rests on it alone: `replace_derived` derives the rest anew. The key is in quarantine from then
  /// on, at every address. Before `scores`. NotFound with the names that there are when none of
  /// them said anything.
  struct Without {
    std::int64_t evaluations = 0;  ///< that were taken away
    std::int64_t workers = 0;      ///< that said them
  };
  virtual Expected<Without> drop_words_of(const std::string& key) = 0;
  /// Gives the store the row of its only campaign, if that is lost.
  virtual void put_campaign(const CampaignRow& campaign) = 0;
  /// Gives a campaign the rows of its designs that are lost. Conflict when designs were found that
  /// are not the campaign's.
  virtual Expected<void> put_designs(const StoredCampaign& campaign,
                                     const std::vector<DesignRow>& designs) = 0;
  /// Of one campaign, by the ids of a store of its own.
  virtual std::vector<StoredScore> scores(const StoredCampaign& campaign) = 0;
  virtual std::vector<StoredStep> steps(const StoredCampaign& campaign) = 0;
  virtual std::vector<CommandRow> commands(const StoredCampaign& campaign) = 0;
  /// Replaces all rows that follow from scores by these. `source` is for scores that have lost
  /// theirs.
  /// Returns how many scores it took away on which `derived` may rest (after `drop_words_of`: of
  /// other machines): then the rows are to be derived again.
  virtual std::int64_t replace_derived(const StoredCampaign& campaign, const DerivedRows& derived,
                                       const std::string& source) = 0;

  struct End {
    std::string digest;
    std::int64_t evaluations = 0;  ///< that the new store has
    std::int64_t orphans = 0;      ///< rows left out since what they belong to is lost
    /// Why the scores of the new store are not to be relied on; empty when they are.
    std::string doubt;
  };
  /// Removes rows that belong to nothing, checks the file, and gives it its name.
  virtual Expected<End> finish() = 0;
};

}  // namespace swarmsmith

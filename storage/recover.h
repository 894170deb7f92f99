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

/// How many rows of one table of a damaged store were found and lost.
struct SalvagedTable {
  std::string name;
  std::int64_t rows = 0;        ///< complete rows
  std::int64_t lost_pages = 0;  ///< pages with more rows that cannot be read
  std::int64_t broken = 0;      ///< rows that lost a part
  bool tree_is_lost = false;    ///< the table's first page is unknown: it may have had more rows
};

struct Salvaged {
  /// Number of evaluations that damage or another program changed after they were written. They
  /// are left out.
  std::int64_t changed_evaluations = 0;
  std::int64_t schema = 0;
  bool header_is_damaged = false;  ///< page size and schema were inferred from the pages
  std::int64_t pages = 0;
  std::int64_t unplaced = 0;  ///< rows whose table is unknown
  std::vector<SalvagedTable> tables;
};

/// The rows of one campaign that follow from its scores (coordinator/design/rebuild.h), and the
/// scores to remove.
struct DerivedRows {
  std::vector<Row> rows;  ///< with the ids that they have when the campaign is alone in a store
  /// Scores of tests that nothing requested, and that would count in results: they are removed.
  std::vector<EvaluationKey> unasked;
};

/// Makes a new store from the readable parts of a damaged one. It reads the file page by page
/// without SQLite, and takes every complete row, including those in the write-ahead log. The
/// damaged file is not changed. The order of calls: `begin`; `put_campaign` if no campaign was
/// found; `put_designs` and `replace_derived` for each campaign whose races can be replayed;
/// `finish`.
class Recovery {
 public:
  /// Errors: BadInput (no such file, or the new name exists), Corrupt (the file has no part of a
  /// store), Newer (its header names a newer schema), Unavailable (the disk cannot be written).
  static Expected<std::unique_ptr<Recovery>> begin(const std::filesystem::path& damaged,
                                                   const std::filesystem::path& into);
  virtual ~Recovery() = default;

  virtual const Salvaged& found() const = 0;
  /// The campaigns whose row was found; may be empty.
  virtual std::vector<StoredCampaign> campaigns() = 0;
  /// Removes the results of the workers of one key (without keys: of one host's address), and
  /// everything that follows from these results alone; `replace_derived` derives the rest again.
  /// The key is in quarantine from then on, at every address. Call it before `scores`. NotFound,
  /// with the names of the keys, when the store has no result of this key.
  struct Without {
    std::int64_t evaluations = 0;  ///< number of removed evaluations
    std::int64_t workers = 0;      ///< number of workers that had made them
  };
  virtual Expected<Without> drop_words_of(const std::string& key) = 0;
  /// Adds the row of the store's only campaign, if that row is lost.
  virtual void put_campaign(const CampaignRow& campaign) = 0;
  /// Adds the lost rows of a campaign's designs. Conflict when the file has designs that are not
  /// the campaign's.
  virtual Expected<void> put_designs(const StoredCampaign& campaign,
                                     const std::vector<DesignRow>& designs) = 0;
  /// Rows of one campaign, with the ids that they have when it is alone in a store.
  virtual std::vector<StoredScore> scores(const StoredCampaign& campaign) = 0;
  virtual std::vector<StoredStep> steps(const StoredCampaign& campaign) = 0;
  virtual std::vector<CommandRow> commands(const StoredCampaign& campaign) = 0;
  /// Replaces all rows that follow from scores with `derived`. Scores that lost their source get
  /// `source`. Returns the number of scores that it removed and that `derived` may depend on (after
  /// `drop_words_of`: scores of other machines); if it is not 0, the caller must derive the rows
  /// again.
  virtual std::int64_t replace_derived(const StoredCampaign& campaign, const DerivedRows& derived,
                                       const std::string& source) = 0;

  struct End {
    std::string digest;
    std::int64_t evaluations = 0;  ///< number in the new store
    std::int64_t orphans = 0;      ///< rows that were left out because their parent row is lost
    /// Candidates of imports that were kept although the candidate from which they came is lost.
    std::int64_t without_parent = 0;
    /// The reason not to trust the scores of the new store; empty when there is none.
    std::string doubt;
  };
  /// Removes rows whose parent row is lost, checks the file, and gives it its name.
  virtual Expected<End> finish() = 0;
};

}  // namespace swarmsmith

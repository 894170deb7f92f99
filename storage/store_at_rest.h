#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "storage/real_runs.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A design from outside of this store.
struct ImportedDesign {
  DesignRow row;     ///< with the id that it gets in this store
  std::string name;  ///< its name where it was made; may be empty
};

/// Rows that are added to a store together: all or nothing.
struct Addition {
  /// A new campaign with the state "imported", and its designs, with ids after the existing ones.
  std::optional<CampaignRow> campaign;
  std::vector<ImportedDesign> designs;
  std::vector<EvaluationKey> removed;  ///< evaluations that rows below replace
  std::vector<Row> rows;
  /// Texts of the profiles, by name, with which `rows` were simulated and that no campaign of the
  /// store has. Conflict when the store has another text under the same name.
  std::map<std::string, std::string> profiles;
};

/// A store that no campaign is writing, opened to add results from outside of its races: later
/// scores, imported designs, and real runs. It holds the store's lock as long as it exists. To read
/// the store, use a StoreReader as well.
class StoreAtRest {
 public:
  enum class IfMissing { Refuse, Make };

  /// Opens the store of any campaign, and migrates it. `designs`, from the campaign's file, give
  /// the flavours, which stores before schema 4 lack. A new store has no campaign; it is deleted
  /// again if nothing is added. Errors: those of Store::open; NotFound with `Refuse`.
  static Expected<std::unique_ptr<StoreAtRest>> open(const std::filesystem::path& named,
                                                     IfMissing if_missing,
                                                     const std::vector<DesignRow>& designs = {});
  virtual ~StoreAtRest() = default;

  /// Whether open() made the file and nothing has been added yet.
  virtual bool is_new() const = 0;

  /// Commits all rows or none, and waits for the disk. Existing rows stay unchanged. Conflict when
  /// the ids of the designs do not follow the existing ones; Unavailable when the disk cannot be
  /// written. Throws std::invalid_argument when a number is NaN or infinite.
  virtual Expected<void> add(const Addition& addition) = 0;

  /// Adds a real run in the same way. A run with a known key and the same inputs (candidate,
  /// mission, arena file, log, calibrations) stays unchanged. Conflict when its inputs differ (use
  /// `rescore_real_run`); NotFound when the store has no such candidate. A new store gets a
  /// campaign without designs, since it has no races. Throws std::invalid_argument when a number is
  /// NaN or infinite, or when a video or robot names a calibration that is not among the rows.
  virtual Expected<RealRunWritten> add_real_run(const RealRunRows& rows) = 0;
  /// Replaces the inputs of a run, its start among them, and everything that follows from its
  /// sightings and inputs, and adds the score to its history. Corners of tags, frame times and
  /// floor tags stay unchanged: BadInput when `rows` has other ones. Conflict when another run has
  /// the key. NotFound when the store has no such run. A person's verdict stays only if inputs,
  /// score, verdict and reasons are the same.
  virtual Expected<void> rescore_real_run(RealRunId id, const RealRunRows& rows) = 0;
  /// Adds a user's verdict on the last scoring. BadInput for an unknown verdict, or without a name
  /// or a reason; NotFound.
  virtual Expected<void> add_override(const RealOverrideRow& row) = 0;
};

}  // namespace swarmsmith

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

/// A design that was made elsewhere.
struct ImportedDesign {
  DesignRow row;     ///< with the id that it gets here
  std::string name;  ///< as it was called there; may be empty
};

/// Rows that are added to a store together: all or nothing.
struct Addition {
  /// A new campaign with the state "imported", and its designs, with ids after the existing ones.
  std::optional<CampaignRow> campaign;
  std::vector<ImportedDesign> designs;
  std::vector<EvaluationKey> removed;  ///< evaluations that give way to rows below
  std::vector<Row> rows;
  /// Texts of profiles, by name, that `rows` were simulated under and no campaign of the store has.
  /// A name stays one profile: Conflict when the store has another text for it.
  std::map<std::string, std::string> profiles;
};

/// A store that no campaign is writing, opened to add results from outside of its races: later
/// scores, designs from elsewhere, and real runs. Holds the store's lock while it lives. Use a
/// StoreReader beside it to read.
class StoreAtRest {
 public:
  enum class IfMissing { Refuse, Make };

  /// Opens the store of any campaign, and migrates it; `designs`, from the campaign's file, give
  /// the flavours, which stores before schema 4 lack. A new store has no campaign; it is deleted
  /// again if nothing is added. Errors as of Store::open; NotFound with `Refuse`.
  static Expected<std::unique_ptr<StoreAtRest>> open(const std::filesystem::path& named,
                                                     IfMissing if_missing,
                                                     const std::vector<DesignRow>& designs = {});
  virtual ~StoreAtRest() = default;

  /// Whether open() made the file and nothing has been added yet.
  virtual bool is_new() const = 0;

  /// Commits everything or nothing, and waits for the disk. Existing rows stay unchanged. Conflict
  /// when the ids of the designs do not follow the existing ones; Unavailable when the disk
  /// refuses. Throws std::invalid_argument when a number is NaN or infinite.
  virtual Expected<void> add(const Addition& addition) = 0;

  /// The same for a real run. A run with a known key and the same inputs (candidate, mission, arena
  /// file, log, calibrations) stays unchanged. Conflict when its inputs differ (use `rescore`);
  /// NotFound when the store has no such candidate. A new store gets a campaign without designs,
  /// which says that nothing raced there. Throws std::invalid_argument when a number is NaN or
  /// infinite, or a calibration is named that is not among the rows.
  virtual Expected<RealRunWritten> add_real_run(const RealRunRows& rows) = 0;
  /// Replaces the inputs of a run and all that follows from its sightings and inputs, and adds the
  /// score to its history. Sightings, frame times and floor tags stay unchanged: BadInput when
  /// `rows` is another run (by its key) or has other sightings. NotFound when there is none.
  virtual Expected<void> rescore_real_run(RealRunId id, const RealRunRows& rows) = 0;
  /// A person's verdict. BadInput for an unknown verdict, or without a name or a reason; NotFound.
  virtual Expected<void> add_override(const RealOverrideRow& row) = 0;
};

}  // namespace swarmsmith

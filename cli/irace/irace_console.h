#pragma once

#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/irace/call_log.h"
#include "cli/irace/candidate_table.h"
#include "cli/output/run_listener.h"
#include "console/output.h"
#include "irace_core/scenario.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The facts about a run that the console needs besides its rows.
struct IraceRun {
  Scenario race;
  ParameterSpace space;
  std::uint64_t seed = 0;
  std::int64_t n_iterations = 0;  ///< planned at the start
  std::int64_t budget = 0;        ///< experiments; 0 with max_time, for which the run estimates it
  std::int64_t debug_level = 0;
  swarmsmith::Target target{};  ///< the program that is called, for debugLevel 2
  InstanceTexts instances{};    ///< its instances
};

/// Date, time and zone as at the beginning of irace's lines: the current time, or the given one.
std::string irace_date();
std::string irace_date(std::time_t time);

/// "the sum of ranks" or "the mean value": the order in which configurations are listed.
std::string irace_order(const Scenario& scenario);

/// Shows the progress of a run to irace's users: prints irace's lines from the rows of the run
/// (irace facts, 24). Shows costs, not scores. Writes to standard output, as irace does; nothing
/// with --quiet.
class IraceConsole final : public RunListener {
 public:
  /// `date` returns the date for each line.
  IraceConsole(
      Output& output, IraceRun run, TimePoint begin,
      std::function<std::string()> date = [] { return irace_date(); });

  /// The first block, which describes the run.
  void write_begin();
  /// Prints the stored part of a run that continues: one line per iteration, and the table of the
  /// last iteration.
  Expected<void> go_on_from(StoreReader& store);

  void restore(std::size_t campaign, const StoredProgress& stored) override;
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override;
  void update(const LiveStatus& live, TimePoint now) override;
  void finish(const LiveStatus& live) override;

 private:
  void write(const std::string& text);
  void begin_iteration(const IterationRow& row);
  void add_step(const RaceStepRow& row, std::optional<double> wall_s);
  /// Ends the table of a race, and prints its best configuration and its elites once they are
  /// known.
  void end_race();
  void add_state(const DesignStateRow& row);
  void add_run(const EvaluationRow& row);
  void add_event(const EventRow& event);
  /// Counts an extension; a command comes again when it takes effect.
  void take(const CommandRow& command);
  /// The rest of the budget with its extensions.
  std::int64_t left_after(std::int64_t used) const;

  Output& output_;
  IraceRun run_;
  std::function<std::string()> date_;
  CandidateTable candidates_;
  CallLog calls_;
  bool bounds_;  ///< whether there is a column for bounds
  bool in_table_ = false;
  std::optional<RaceStepRow> last_step_;
  std::vector<EliteRow> elites_;                     ///< of the race that ends
  std::int64_t used_ = 0;                            ///< experiments that the run has used
  std::int64_t iteration_ = 0;                       ///< the current one
  std::map<std::int64_t, std::int64_t> extensions_;  ///< experiments, by number of the command
  std::int64_t used_before_ = 0;                     ///< experiments used before the current race
  std::optional<std::int64_t> remaining_;            ///< experiments, estimated from max_time
  TimePoint last_;      ///< when the last line of the table was written
  std::string reason_;  ///< why the race ended, once that was printed
  std::string trouble_;
};

}  // namespace swarmsmith::cli

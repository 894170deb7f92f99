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

/// What the console must know of a run besides its rows.
struct IraceRun {
  Scenario race;
  ParameterSpace space;
  std::uint64_t seed = 0;
  std::int64_t n_iterations = 0;  ///< planned at the start
  std::int64_t budget = 0;        ///< experiments; 0 with max_time, where the run finds it
  std::int64_t debug_level = 0;
  swarmsmith::Target target{};  ///< what is called, for debugLevel 2
  InstanceTexts instances{};    ///< what it is called for
};

/// Date, time and zone, as they begin irace's lines: now, or of a time.
std::string irace_date();
std::string irace_date(std::time_t time);

/// "the sum of ranks" or "the mean value": by what configurations are listed.
std::string irace_order(const Scenario& scenario);

/// Tells irace's users how a run goes: irace's lines, from the rows that the run makes (irace
/// facts, 24). Costs, not scores. Writes to standard output, as irace does; with --quiet nothing.
class IraceConsole final : public RunListener {
 public:
  /// `date` gives the date of each line.
  IraceConsole(
      Output& output, IraceRun run, TimePoint begin,
      std::function<std::string()> date = [] { return irace_date(); });

  /// The block that says what will be done.
  void write_begin();
  /// What a store knows of a run that goes on: a line an iteration, the table of the last one.
  Expected<void> go_on_from(StoreReader& store);

  void restore(std::size_t campaign, const Row& row) override;
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override;
  void update(const LiveStatus& live, TimePoint now) override;
  void finish(const LiveStatus& live) override;

 private:
  void write(const std::string& text);
  void begin_iteration(const IterationRow& row);
  void add_step(const RaceStepRow& row, std::optional<double> wall_s);
  /// The end of a race's table, its best and its elites, once they are known.
  void end_race();
  void add_state(const DesignStateRow& row);
  void add_run(const EvaluationRow& row);
  void add_event(const EventRow& event);

  Output& output_;
  IraceRun run_;
  std::function<std::string()> date_;
  CandidateTable candidates_;
  CallLog calls_;
  bool bounds_;  ///< whether there is a column for them
  bool in_table_ = false;
  std::optional<RaceStepRow> last_step_;
  std::vector<EliteRow> elites_;           ///< of the race that ends
  std::int64_t used_ = 0;                  ///< experiments of the run
  std::int64_t iteration_ = 0;             ///< that runs
  std::int64_t used_before_ = 0;           ///< the current race
  std::optional<std::int64_t> remaining_;  ///< experiments, as max_time is good for
  TimePoint last_;                         ///< when the last line of the table was written
  std::string reason_;                     ///< why it ended, once that was said
  std::string trouble_;
};

}  // namespace swarmsmith::cli

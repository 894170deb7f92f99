#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/clock.h"
#include "cli/output/run_listener.h"
#include "console/output.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/service/progress_model.h"

namespace swarmsmith::cli {

/// The facts about a campaign that the output shows.
struct ToldCampaign {
  std::string name;  ///< in front of its lines; empty when it is the only one
  std::vector<DesignRow> designs;
  bool costs = false;  ///< programs evaluate: people want to see the costs that they print
  Searches searches{};
};

/// Shows the progress of campaigns to a person or a program, from their rows.
///
/// On a terminal: a status line that is redrawn, above it the lines of the races. Elsewhere: a line
/// every 30 s and one at each change of a design's state; with `-v` the lines of the races, too.
/// With --json: events on standard output, one a line. With --quiet: nothing but errors.
///
/// Not thread-safe: rows and updates come from one thread.
class Progress final : public RunListener {
 public:
  /// `width` gives the columns of the terminal; asked again for each line.
  Progress(Output& output, const std::vector<ToldCampaign>& campaigns, TimePoint begin,
           std::function<std::size_t()> width = terminal_width);
  /// Of one campaign.
  Progress(Output& output, std::span<const DesignRow> designs, TimePoint begin,
           std::function<std::size_t()> width = terminal_width);

  /// Prints nothing.
  void restore(std::size_t campaign, const Row& row) override { models_[campaign].add(row); }
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override;
  /// Redraws at most ten times a second.
  void update(const LiveStatus& live, TimePoint now) override;
  /// Writes the last status and leaves the line.
  void finish(const LiveStatus& live) override;

  const ProgressModel& model(std::size_t campaign = 0) const { return models_[campaign]; }

  static std::size_t terminal_width();

 private:
  enum class Form { Silent, Json, Terminal, Plain };

  /// A race reports its state after each step; only a change is printed.
  static bool repeats_state(const ProgressModel& model, const Row& row);
  void add_line(const std::string& line);
  void write_row(std::size_t campaign, const std::string& name, const Row& row, TimePoint now);
  void write_events(const LiveStatus& live);
  void draw(const LiveStatus& live);

  Output& output_;
  std::vector<std::string> names_;
  std::vector<ProgressModel> models_;
  TimePoint begin_;
  std::function<std::size_t()> width_;
  Form form_;
  bool race_lines_;
  std::string drawn_;  ///< the status line that stands on the terminal
  std::string trouble_;
  std::string launcher_note_;
  std::optional<TimePoint> last_;
  std::int64_t lines_since_headline_ = 0;
};

}  // namespace swarmsmith::cli

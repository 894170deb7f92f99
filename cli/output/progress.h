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
  std::string name;  ///< printed before its lines; empty if there is only one campaign
  std::vector<DesignRow> designs;
  bool costs = false;  ///< the scores come from programs: show the costs that they print
  Searches searches{};
};

/// Shows the progress of campaigns to a person or a program, from their rows.
///
/// On a terminal: a status line that is redrawn, and above it the lines of the races. Otherwise: a
/// line every 30 s and a line for each change of a design's state; with `-v` also the lines of the
/// races. With --json: events on standard output, one per line. With --quiet: only errors.
///
/// Not thread-safe: rows and updates must come from one thread.
class Progress final : public RunListener {
 public:
  /// `width` returns the number of columns of the terminal; it is called for each line.
  Progress(Output& output, const std::vector<ToldCampaign>& campaigns, TimePoint begin,
           std::function<std::size_t()> width = terminal_width);
  /// For one campaign.
  Progress(Output& output, std::span<const DesignRow> designs, TimePoint begin,
           std::function<std::size_t()> width = terminal_width);

  /// Prints nothing.
  void restore(std::size_t campaign, const StoredProgress& stored) override {
    std::visit([&](const auto& part) { models_[campaign].add(part); }, stored);
  }
  void add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) override;
  /// Redraws at most ten times a second.
  void update(const LiveStatus& live, TimePoint now) override;
  /// Writes the last status and ends the line.
  void finish(const LiveStatus& live) override;

  const ProgressModel& model(std::size_t campaign = 0) const { return models_[campaign]; }

  static std::size_t terminal_width();

 private:
  enum class Form { Silent, Json, Terminal, Plain };

  /// A race reports its state after each step; only changes are printed.
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
  std::string drawn_;  ///< the status line that the terminal shows now
  std::string trouble_;
  std::string launcher_note_;
  std::optional<TimePoint> last_;
  std::int64_t lines_since_headline_ = 0;
};

}  // namespace swarmsmith::cli

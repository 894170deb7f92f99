#include "cli/output/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <utility>
#include <variant>

#include "cli/output/progress_text.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

/// How often each output format shows the state.
constexpr auto kRedrawEvery = std::chrono::milliseconds(100);
constexpr auto kPlainEvery = std::chrono::seconds(30);
constexpr auto kEventEvery = std::chrono::seconds(1);
constexpr std::int64_t kHeadlineEvery = 40;

}  // namespace

Progress::Progress(Output& output, std::span<const DesignRow> designs, TimePoint begin,
                   std::function<std::size_t()> width)
    : Progress(output, {{.name = {}, .designs = {designs.begin(), designs.end()}}}, begin,
               std::move(width)) {}

Progress::Progress(Output& output, const std::vector<ToldCampaign>& campaigns, TimePoint begin,
                   std::function<std::size_t()> width)
    : output_(output), begin_(begin), width_(std::move(width)) {
  for (const ToldCampaign& campaign : campaigns) {
    names_.push_back(campaign.name);
    models_.emplace_back(campaign.designs, campaign.costs, campaign.searches);
  }
  form_ = output.err_is_terminal ? Form::Terminal : Form::Plain;
  if (output.quiet) form_ = Form::Silent;
  if (output.json) form_ = Form::Json;
  race_lines_ = form_ == Form::Terminal || output.verbose;
}

std::size_t Progress::terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col - 1U : 79U;
}

bool Progress::repeats_state(const ProgressModel& model, const Row& row) {
  const auto* state = std::get_if<DesignStateRow>(&row);
  return state != nullptr && model.design(state->design).state == state->state;
}

void Progress::add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) {
  const std::size_t index = campaign.value_or(0);
  const std::string name = campaign ? names_[index] : "";
  const bool news = !repeats_state(models_[index], row);
  models_[index].add(row);
  if (form_ == Form::Silent || !news) return;
  if (form_ == Form::Json) {
    const std::string event = event_json(row, name);
    if (!event.empty()) output_.out << event << '\n' << std::flush;
    return;
  }
  write_row(index, name.empty() ? "" : name + ": ", row, now);
}

/// Lines for people. Other rows change only the status line.
void Progress::write_row(std::size_t campaign, const std::string& name, const Row& row,
                         TimePoint now) {
  const ProgressModel& model = models_[campaign];
  if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_line(name + state_line(*state, model.design(state->design), best_text(model, *state)));
  } else if (const auto* command = std::get_if<CommandRow>(&row)) {
    add_line(name + command_line(*command));
  } else if (const auto* event = std::get_if<EventRow>(&row)) {
    if (event->severity != "info" || output_.verbose) add_line(name + event_line(*event));
  }
  if (!race_lines_) return;
  if (const auto* iteration = std::get_if<IterationRow>(&row)) {
    add_line(name + iteration_line(*iteration, model.design(iteration->design)));
  } else if (const auto* elite = std::get_if<EliteRow>(&row)) {
    const DesignProgress& progress = model.design(elite->design);
    // Other searches have many elites, and no test selected them; only the best one is printed.
    if (elite->rank == 1 || has_tests(progress))
      add_line(name + elite_line(*elite, progress, mean_text(model, elite->mean)));
  } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
    if (!has_tests(model.design(step->design))) return;
    if (lines_since_headline_++ % kHeadlineEvery == 0) add_line(race_headline());
    add_line(name + race_line(*step, mean_text(model, step->mean_best),
                              std::chrono::duration<double>(now - begin_).count()));
  }
}

/// Prints a permanent line above the status line.
void Progress::add_line(const std::string& line) {
  if (!drawn_.empty()) output_.err << kClearLine;
  output_.err << line << '\n' << drawn_ << std::flush;
}

void Progress::write_events(const LiveStatus& live) {
  for (std::size_t i = 0; i < models_.size(); ++i)
    output_.out << progress_json(models_[i], live, names_[i]) << '\n';
  output_.out << std::flush;
}

/// Replaces the current status line.
void Progress::draw(const LiveStatus& live) {
  drawn_ = status_line(models_, live, width_());
  output_.err << kClearLine << drawn_ << std::flush;
}

void Progress::update(const LiveStatus& live, TimePoint now) {
  if (live.trouble != trouble_) {
    trouble_ = live.trouble;
    // Printed even with --quiet: the run stops until a person has helped.
    if (!trouble_.empty()) add_line("warning: nothing can be stored: " + trouble_);
  }
  if (live.launcher.note != launcher_note_) {
    launcher_note_ = live.launcher.note;
    if (!launcher_note_.empty() && !output_.quiet) add_line(to_text(live.launcher));
  }
  if (form_ == Form::Silent) return;
  const TimePoint last = last_.value_or(begin_);
  const auto since = now - last;
  if (form_ == Form::Terminal && (!last_ || since >= kRedrawEvery)) {
    last_ = now;
    draw(live);
  } else if (form_ == Form::Plain && since >= kPlainEvery) {
    last_ = now;
    add_line(plain_status(models_, live));
  } else if (form_ == Form::Json && since >= kEventEvery) {
    last_ = now;
    write_events(live);
  }
}

void Progress::finish(const LiveStatus& live) {
  for (ProgressModel& model : models_)
    model.drop_open_steps();
  switch (form_) {
    case Form::Silent:
      break;
    case Form::Json:
      write_events(live);
      break;
    case Form::Plain:
      add_line(plain_status(models_, live));
      break;
    case Form::Terminal:
      draw(live);
      output_.err << '\n' << std::flush;
      drawn_.clear();
      break;
  }
}

}  // namespace swarmsmith::cli

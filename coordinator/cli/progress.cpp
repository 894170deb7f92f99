#include "coordinator/cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <utility>
#include <variant>

#include "coordinator/cli/progress_text.h"

namespace swarmsmith::cli {
namespace {

/// How often each form tells of the state without being asked.
constexpr auto kRedrawEvery = std::chrono::milliseconds(100);
constexpr auto kPlainEvery = std::chrono::seconds(30);
constexpr auto kEventEvery = std::chrono::seconds(1);
constexpr std::int64_t kHeadlineEvery = 40;
constexpr const char* kClearLine = "\r\x1b[2K";

}  // namespace

Progress::Progress(Output& output, std::span<const DesignRow> designs, TimePoint begin,
                   std::function<std::size_t()> width)
    : output_(output), model_(designs), begin_(begin), width_(std::move(width)) {
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

bool Progress::repeats_state(const Row& row) const {
  const auto* state = std::get_if<DesignStateRow>(&row);
  return state != nullptr && model_.design(state->design).state == state->state;
}

void Progress::add(const Row& row, TimePoint now) {
  const bool news = !repeats_state(row);
  model_.add(row);
  if (form_ == Form::Silent || !news) return;
  if (form_ == Form::Json) {
    const std::string event = event_json(row);
    if (!event.empty()) output_.out << event << '\n' << std::flush;
    return;
  }
  write_row(row, now);
}

/// Lines for people. A row that is not told of here changes the status line.
void Progress::write_row(const Row& row, TimePoint now) {
  if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    add_line(state_line(*state, model_.design(state->design)));
  } else if (const auto* event = std::get_if<EventRow>(&row)) {
    if (event->severity != "info" || output_.verbose) add_line(event_line(*event));
  }
  if (!race_lines_) return;
  if (const auto* iteration = std::get_if<IterationRow>(&row)) {
    add_line(iteration_line(*iteration, model_.design(iteration->design)));
  } else if (const auto* elite = std::get_if<EliteRow>(&row)) {
    add_line(elite_line(*elite));
  } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
    if (lines_since_headline_++ % kHeadlineEvery == 0) add_line(race_headline());
    add_line(race_line(*step, std::chrono::duration<double>(now - begin_).count()));
  }
}

/// A line that stays, above the status line.
void Progress::add_line(const std::string& line) {
  if (!drawn_.empty()) output_.err << kClearLine;
  output_.err << line << '\n' << drawn_ << std::flush;
}

/// Instead of the line that stands there.
void Progress::draw(const LiveStatus& live) {
  drawn_ = status_line(model_, live, width_());
  output_.err << kClearLine << drawn_ << std::flush;
}

void Progress::update(const LiveStatus& live, TimePoint now) {
  if (live.trouble != trouble_) {
    trouble_ = live.trouble;
    // Even when quiet: nothing goes on until a person has helped.
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
    add_line(plain_status(model_, live));
  } else if (form_ == Form::Json && since >= kEventEvery) {
    last_ = now;
    output_.out << progress_json(model_, live) << '\n' << std::flush;
  }
}

void Progress::finish(const LiveStatus& live) {
  switch (form_) {
    case Form::Silent:
      break;
    case Form::Json:
      output_.out << progress_json(model_, live) << '\n' << std::flush;
      break;
    case Form::Plain:
      add_line(plain_status(model_, live));
      break;
    case Form::Terminal:
      draw(live);
      output_.err << '\n' << std::flush;
      drawn_.clear();
      break;
  }
}

}  // namespace swarmsmith::cli

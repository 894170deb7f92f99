#include "analysis/figures/machine_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/figures/internal/controller_table.h"
#include "analysis/figures/internal/design_flavour.h"
#include "analysis/figures/makers.h"
#include "analysis/machines/controller_drawing.h"
#include "analysis/machines/machine_layout.h"
#include "analysis/records/names.h"
#include "sim/control/controller.h"

namespace swarmsmith {
namespace {

Error useless(std::string_view option) {
  return {ErrorKind::BadInput, fmt::format("a machine has no {}; leave it out", option), ""};
}

/// The selected candidates: the named one, or the best ones of the designs.
Expected<std::vector<CandidateId>> chosen_candidates(StoreReader& store,
                                                     const FigureOptions& options) {
  if (options.candidate) return std::vector{*options.candidate};
  const auto known = designs(store, options.filter);
  if (!known) return Unexpected(known.error());
  if (known->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no such design; `swarmsmith ls designs` shows what it has");
  }
  std::vector<CandidateId> best;
  for (const DesignRecord& design : *known)
    if (design.best) best.push_back(*design.best);
  if (!best.empty()) return best;
  return unexpected(
      ErrorKind::NotFound,
      known->size() == 1
          ? to_string(known->front().design) +
                " has no best machine yet; its first iteration must end first"
          : "no design has a best machine yet; the first iteration of one must end first");
}

/// The first schema that stores the flavour of machines.
constexpr std::int64_t kFlavoursSchema = 4;

/// A controller drawn for a figure.
struct Drawn {
  MachineRecord record;
  StoredController stored;
  ControllerDrawing drawing;
};

Expected<Drawn> drawn(StoreReader& store, CandidateId id, double width) {
  auto record = candidate(store, id);
  if (!record) return Unexpected(record.error());
  auto stored = controller_of(*record, store);
  if (!stored) return Unexpected(stored.error());
  ControllerDrawing drawing =
      drawing_of(stored->controller, *stored->flavour, width, title_of(*record));
  return Drawn{std::move(*record), std::move(*stored), std::move(drawing)};
}

/// The two lines above a machine on a sheet.
std::array<std::string, 2> words_of(const MachineRecord& record) {
  return {fmt::format("{} {}", to_string(record.design), to_string(record.candidate)),
          fmt::format("{}, {}, repetition {}", as_words(record.mission), record.method,
                      record.repetition)};
}

/// "state machines", "behaviour trees", "neural networks", or a word for all kinds.
std::string_view what_is_drawn(std::span<const Drawn> machines) {
  const Architecture first = architecture_of(machines.front().stored.controller);
  for (const Drawn& machine : machines)
    if (architecture_of(machine.stored.controller) != first) return "controllers";
  switch (first) {
    case Architecture::Machine:
      return "state machines";
    case Architecture::Tree:
      return "behaviour trees";
    case Architecture::Network:
      break;
  }
  return "neural networks";
}

/// One sentence for each kind of controller among them.
std::string explanations(std::span<const Drawn> machines) {
  std::set<Architecture> kinds;
  for (const Drawn& machine : machines)
    kinds.insert(architecture_of(machine.stored.controller));
  std::string text;
  for (const Architecture kind : kinds)
    text.append(text.empty() ? "" : ". ").append(explanation_of(kind));
  return text;
}

constexpr double kAbove = 2 * kLineHeight + 1;
constexpr double kBelow = 4;

/// Machines side by side in rows, each below its name.
std::string drawn_sheet(std::span<const Drawn> machines, std::size_t columns, double column) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    if (i % columns == 0) rows.push_back(0);
    rows.back() = std::max(rows.back(), machines[i].drawing.svg.height() + kAbove + kBelow);
  }
  Svg svg(static_cast<double>(columns) * column, std::accumulate(rows.begin(), rows.end(), kMargin),
          fmt::format("{} {}", machines.size(), what_is_drawn(machines)), explanations(machines));
  double top = kMargin;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const double left = static_cast<double>(i % columns) * column;
    const auto [name, rest] = words_of(machines[i].record);
    const double room = column - 2 * kMargin;
    svg.text({left + kMargin, top + kTextSize}, fitted_text(name, kTextSize * kBolder, room),
             {.bold = true});
    svg.text({left + kMargin, top + kTextSize + kLineHeight}, fitted_text(rest, kTextSize, room),
             {});
    svg.add(machines[i].drawing.svg, {left, top + kAbove});
    if (i % columns == columns - 1) top += rows[i / columns];
  }
  return svg.finish();
}

/// The rows of a sheet divided into pages, as many rows as fit on each.
std::vector<std::string> drawn_pages(std::span<const Drawn> machines, std::size_t columns,
                                     double column) {
  std::vector<std::string> pages;
  std::size_t first = 0;
  double height = kMargin;
  for (std::size_t i = 0; i < machines.size(); i += columns) {
    double row = 0;
    for (std::size_t k = i; k < std::min(i + columns, machines.size()); ++k)
      row = std::max(row, machines[k].drawing.svg.height() + kAbove + kBelow);
    if (i > first && height + row > kFigurePage_mm) {
      pages.push_back(drawn_sheet(machines.subspan(first, i - first), columns, column));
      first = i;
      height = kMargin;
    }
    height += row;
  }
  if (first > 0) pages.push_back(drawn_sheet(machines.subspan(first), columns, column));
  return pages;
}

/// A sheet for a paper's appendix: all machines, in rows.
Expected<Figure> machine_sheet(StoreReader& store, const std::vector<CandidateId>& candidates,
                               double width) {
  constexpr double kGoodWidth = 84;
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor(width / kGoodWidth)));
  const double column = width / static_cast<double>(columns);
  std::vector<Drawn> machines;
  ControllerTable table{.columns = {"design", "candidate"}, .rows = {}};
  Figure figure;
  for (const CandidateId id : candidates) {
    auto machine = drawn(store, id, column);
    if (!machine) return Unexpected(machine.error());
    const auto [name, rest] = words_of(machine->record);
    figure.tex += fmt::format("% {}: {}\n{}\n", name, rest, machine->drawing.tikz);
    table.add(controller_table(machine->stored), {std::to_string(machine->record.design.value),
                                                  std::to_string(machine->record.candidate.value)});
    machines.push_back(std::move(*machine));
  }
  figure.csv = table.text();
  const std::size_t across = std::min(columns, machines.size());
  figure.svg = drawn_sheet(machines, across, column);
  figure.pages = drawn_pages(machines, across, column);
  return figure;
}

/// A table of weights has a title, like other figures with numbers; drawings of machines and trees
/// have none.
Svg with_heading(const Drawn& machine, const FigureOptions& options) {
  const bool is_table = architecture_of(machine.stored.controller) == Architecture::Network;
  const Svg& picture = machine.drawing.svg;
  if (!is_table || options.paper) return picture;
  const std::string title = title_of(machine.record);
  constexpr double kRoom = kTitleSize + 2;
  Svg svg(picture.width(), picture.height() + kRoom, title, explanation_of(Architecture::Network));
  draw_heading(svg, title, {});
  svg.add(picture, {0, kRoom});
  return svg;
}

}  // namespace

Expected<StoredController> controller_of(const MachineRecord& candidate, StoreReader& store) {
  const Flavour* flavour = flavour_of_design(store, candidate.design, candidate.flavour);
  return controller_of(candidate, store.schema(), flavour);
}

Expected<StoredController> controller_of(const MachineRecord& candidate, std::int64_t schema,
                                         const Flavour* own) {
  const std::string id = to_string(candidate.candidate);
  // A program's parameters may have the same switches as machines.
  const bool is_machine = architecture_of_text(candidate.machine).has_value();
  if (!is_machine || (candidate.flavour.empty() && schema >= kFlavoursSchema)) {
    return bad_input(id +
                     " is a configuration of a program, not a machine: the method's candidates are "
                     "the parameters of its file");
  }
  if (candidate.flavour.empty()) {
    return bad_input(
        "the store has an older version without the flavour of its machines; `swarmsmith backup "
        "OLD NEW` makes a copy that has it");
  }
  const auto flavour = find_flavour(candidate.flavour, own);
  if (!flavour) {
    return bad_input(id + " is written in the flavour " + candidate.flavour +
                     ", which this version does not have");
  }
  auto controller = parse_controller(candidate.machine, **flavour);
  if (!controller) {
    return unexpected(controller.error().kind, controller.error().message,
                      id + ", " + controller.error().where);
  }
  return StoredController{std::move(*controller), *flavour};
}

std::string controller_csv(const StoredController& stored) {
  return controller_table(stored).text();
}

std::string title_of(const MachineRecord& candidate) {
  return fmt::format("{} {}, {}, {}", to_string(candidate.design), to_string(candidate.candidate),
                     candidate.mission, candidate.method);
}

Expected<Figure> machine_figure(StoreReader& store, const FigureOptions& options) {
  if (!options.by.empty()) return Unexpected(useless("--by"));
  if (!options.source.empty()) return Unexpected(useless("--source"));
  if (options.iteration) return Unexpected(useless("--iteration"));
  if (!options.parameter.empty()) return Unexpected(useless("--parameter"));
  if (options.width_mm < kNarrowestMachine_mm) {
    return bad_input(fmt::format("a machine needs a width of at least {} mm", kNarrowestMachine_mm),
                     "--width");
  }
  const auto candidates = chosen_candidates(store, options);
  if (!candidates) return Unexpected(candidates.error());
  if (candidates->size() > 1) return machine_sheet(store, *candidates, options.width_mm);
  const auto machine = drawn(store, candidates->front(), options.width_mm);
  if (!machine) return Unexpected(machine.error());
  return Figure{.svg = with_heading(*machine, options).finish(),
                .csv = controller_csv(machine->stored),
                .tex = machine->drawing.tikz,
                .dot = machine->drawing.dot};
}

}  // namespace swarmsmith

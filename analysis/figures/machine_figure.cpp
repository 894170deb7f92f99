#include "analysis/figures/machine_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "analysis/figures/makers.h"
#include "analysis/machines/machine_drawing.h"
#include "analysis/records/names.h"
#include "sim/control/controller.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// "beta=0.45 label=yellow"
std::string parameters_text(Module module, std::span<const double> values, const Flavour& flavour) {
  std::string text;
  const ModuleSpec& spec = *flavour.find(module);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterSpec& parameter = spec.parameters[i];
    const bool label = parameter.type == ParameterSpec::Type::Label;
    text += fmt::format("{}{}=", i > 0 ? " " : "", parameter.name);
    if (label) {
      text += name_of(static_cast<ColorLabel>(static_cast<int>(values[i])));
    } else {
      text += fmt::format("{}", values[i]);
    }
  }
  return text;
}

Error useless(std::string_view option) {
  return {ErrorKind::BadInput, fmt::format("a machine has no {}; leave it out", option), ""};
}

/// The ones that are meant: the named candidate, or the best ones of the designs.
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
  return unexpected(ErrorKind::NotFound,
                    known->size() == 1 ? to_string(known->front().design) +
                                             " has no best machine yet; its first iteration has "
                                             "to end first"
                                       : "no design has a best machine yet; the first iteration of "
                                         "one has to end first");
}

/// A machine laid out for a figure.
struct LaidOut {
  MachineRecord record;
  StoredMachine stored;
  MachineLayout layout;
};

Expected<LaidOut> laid_out(StoreReader& store, CandidateId id, double width) {
  auto record = candidate(store, id);
  if (!record) return Unexpected(record.error());
  auto stored = machine_of(*record);
  if (!stored) return Unexpected(stored.error());
  MachineLayout layout = lay_out(stored->machine, *stored->flavour, width);
  return LaidOut{std::move(*record), std::move(*stored), std::move(layout)};
}

/// What stands above a machine of a sheet, on two lines.
std::array<std::string, 2> words_of(const MachineRecord& record) {
  return {fmt::format("{} {}", to_string(record.design), to_string(record.candidate)),
          fmt::format("{}, {}, repetition {}", as_words(record.mission), record.method,
                      record.repetition)};
}

/// Machines side by side, in rows, each below its name.
std::string drawn_sheet(const std::vector<LaidOut>& machines, std::size_t columns, double column) {
  constexpr double kAbove = 2 * kLineHeight + 1;
  constexpr double kBelow = 4;
  std::vector<double> rows;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    if (i % columns == 0) rows.push_back(0);
    rows.back() = std::max(rows.back(), machines[i].layout.height + kAbove + kBelow);
  }
  Svg svg(static_cast<double>(columns) * column, std::accumulate(rows.begin(), rows.end(), kMargin),
          fmt::format("{} state machines", machines.size()),
          "Probabilistic finite state machines: circles are behaviours, the double one is the "
          "initial state; pointed boxes are conditions");
  double top = kMargin;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const double left = static_cast<double>(i % columns) * column;
    const auto [name, rest] = words_of(machines[i].record);
    const double room = column - 2 * kMargin;
    svg.text({left + kMargin, top + kTextSize}, fitted_text(name, kTextSize * kBolder, room),
             {.bold = true});
    svg.text({left + kMargin, top + kTextSize + kLineHeight}, fitted_text(rest, kTextSize, room),
             {});
    svg.add(drawing_of(machines[i].layout, ""), {left, top + kAbove});
    if (i % columns == columns - 1) top += rows[i / columns];
  }
  return svg.finish();
}

/// The appendix of a paper: every machine, in rows.
Expected<Figure> machine_sheet(StoreReader& store, const std::vector<CandidateId>& candidates,
                               double width) {
  constexpr double kGoodWidth = 84;
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor(width / kGoodWidth)));
  const double column = width / static_cast<double>(columns);
  std::vector<LaidOut> machines;
  Figure figure;
  for (const CandidateId id : candidates) {
    auto machine = laid_out(store, id, column);
    if (!machine) return Unexpected(machine.error());
    const auto [name, rest] = words_of(machine->record);
    figure.tex += fmt::format("% {}: {}\n{}\n", name, rest, tikz_of(machine->layout));
    const std::string csv = machine_csv(machine->stored);
    std::size_t end = csv.find('\n');
    if (figure.csv.empty()) figure.csv = "design,candidate," + csv.substr(0, end + 1);
    for (std::size_t at = end + 1; at < csv.size(); at = end + 1) {
      end = csv.find('\n', at);
      figure.csv += fmt::format("{},{},{}\n", machine->record.design.value,
                                machine->record.candidate.value, csv.substr(at, end - at));
    }
    machines.push_back(std::move(*machine));
  }
  figure.svg = drawn_sheet(machines, std::min(columns, machines.size()), column);
  return figure;
}

}  // namespace

Expected<StoredMachine> machine_of(const MachineRecord& candidate) {
  const std::string id = to_string(candidate.candidate);
  const auto architecture = architecture_of_text(candidate.machine);
  if (!architecture) return bad_input(id + " is a configuration of a program, not a machine");
  if (*architecture != Architecture::Machine) {
    return bad_input(id + " is a " + std::string(name_of(*architecture)) +
                     ", and only state machines can be drawn so far");
  }
  if (candidate.flavour.empty()) {
    return bad_input(
        "the store has an older version without the flavour of its machines; `swarmsmith backup "
        "OLD NEW` makes a copy that has it");
  }
  const auto flavours = all_flavours();
  const auto flavour = std::ranges::find_if(
      flavours, [&](const Flavour* known) { return known->name == candidate.flavour; });
  if (flavour == flavours.end()) {
    return bad_input(id + " is written in the flavour " + candidate.flavour +
                     ", which this version does not have");
  }
  auto machine = parse_machine(candidate.machine, **flavour);
  if (!machine) {
    return unexpected(machine.error().kind, machine.error().message,
                      id + ", " + machine.error().where);
  }
  return StoredMachine{std::move(*machine), *flavour};
}

std::string machine_csv(const StoredMachine& stored) {
  std::string csv =
      "state,behaviour,behaviour_parameters,transition,target,condition,condition_parameters\n";
  for (std::size_t i = 0; i < stored.machine.states.size(); ++i) {
    const State& state = stored.machine.states[i];
    const Module behaviour = module_of(state.behaviour);
    const std::string begin =
        fmt::format("{},{},{}", i, id_of(behaviour),
                    parameters_text(behaviour, parameters_of(state.behaviour), *stored.flavour));
    csv += begin + ",,,,\n";
    for (std::size_t j = 0; j < state.transitions.size(); ++j) {
      const Transition& transition = state.transitions[j];
      const Module condition = module_of(transition.condition);
      csv += fmt::format(
          "{},{},{},{},{}\n", begin, j, transition.target, id_of(condition),
          parameters_text(condition, parameters_of(transition.condition), *stored.flavour));
    }
  }
  return csv;
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
    return bad_input(fmt::format("a machine needs a width of {} mm at least", kNarrowestMachine_mm),
                     "--width");
  }
  const auto candidates = chosen_candidates(store, options);
  if (!candidates) return Unexpected(candidates.error());
  if (candidates->size() > 1) return machine_sheet(store, *candidates, options.width_mm);
  const auto machine = laid_out(store, candidates->front(), options.width_mm);
  if (!machine) return Unexpected(machine.error());
  return Figure{.svg = svg_of(machine->layout, title_of(machine->record)),
                .csv = machine_csv(machine->stored),
                .tex = tikz_of(machine->layout)};
}

}  // namespace swarmsmith

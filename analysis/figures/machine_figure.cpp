#include "analysis/figures/machine_figure.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "analysis/figures/makers.h"
#include "analysis/machines/machine_drawing.h"
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

/// The one that is meant: the named candidate, or the best one of the only design.
Expected<CandidateId> chosen_candidate(StoreReader& store, const FigureOptions& options) {
  if (options.candidate) return *options.candidate;
  const auto known = designs(store, options.filter);
  if (!known) return Unexpected(known.error());
  if (known->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no such design; `swarmsmith ls designs` shows what it has");
  }
  if (known->size() > 1) {
    return bad_input(fmt::format(
        "{} designs have a best machine each; name one, for instance {}, or a candidate such as {}",
        known->size(), to_string(known->front().design),
        to_string(known->front().best.value_or(CandidateId{1}))));
  }
  if (!known->front().best) {
    return unexpected(ErrorKind::NotFound, to_string(known->front().design) +
                                               " has no best machine yet; its first iteration has "
                                               "to end first");
  }
  return *known->front().best;
}

}  // namespace

Expected<StoredMachine> machine_of(const MachineRecord& candidate) {
  const std::string id = to_string(candidate.candidate);
  if (!candidate.machine.starts_with("--nstates")) {
    return bad_input(id + " is a configuration of a program, and no machine");
  }
  if (candidate.flavour.empty()) {
    return bad_input(
        "the store is of an older version and does not say in which flavour its machines are "
        "written; `swarmsmith backup OLD NEW` makes a copy that does");
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
  const auto id = chosen_candidate(store, options);
  if (!id) return Unexpected(id.error());
  const auto found = candidate(store, *id);
  if (!found) return Unexpected(found.error());
  const auto stored = machine_of(*found);
  if (!stored) return Unexpected(stored.error());
  const MachineLayout layout = lay_out(stored->machine, *stored->flavour, options.width_mm);
  return Figure{
      .svg = svg_of(layout, title_of(*found)), .csv = machine_csv(*stored), .tex = tikz_of(layout)};
}

}  // namespace swarmsmith

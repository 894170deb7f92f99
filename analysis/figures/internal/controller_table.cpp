#include "analysis/figures/internal/controller_table.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <variant>

#include <fmt/format.h>

#include "base/text/csv.h"

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

std::string parameters_text(const Behaviour& behaviour, const Flavour& flavour) {
  return parameters_text(module_of(behaviour), parameters_of(behaviour), flavour);
}

std::string parameters_text(const Condition& condition, const Flavour& flavour) {
  return parameters_text(module_of(condition), parameters_of(condition), flavour);
}

template <class Part>
std::string id_text(const Part& part, const Flavour& flavour) {
  return flavour.find(module_of(part))->id;
}

/// Makes the table of any kind of controller.
struct TableOf {
  const Flavour* flavour;

  ControllerTable operator()(const Machine& machine) const {
    ControllerTable table{.columns = {"state", "behaviour", "behaviour_parameters", "transition",
                                      "target", "condition", "condition_parameters"},
                          .rows = {}};
    for (std::size_t i = 0; i < machine.states.size(); ++i) {
      const State& state = machine.states[i];
      const std::vector<std::string> begin = {std::to_string(i), id_text(state.behaviour, *flavour),
                                              parameters_text(state.behaviour, *flavour)};
      table.rows.push_back(begin);
      table.rows.back().resize(table.columns.size());
      for (std::size_t j = 0; j < state.transitions.size(); ++j) {
        const Transition& transition = state.transitions[j];
        table.rows.push_back({begin[0], begin[1], begin[2], std::to_string(j),
                              std::to_string(transition.target),
                              id_text(transition.condition, *flavour),
                              parameters_text(transition.condition, *flavour)});
      }
    }
    return table;
  }

  ControllerTable operator()(const Tree& tree) const {
    ControllerTable table{
        .columns = {"subtree", "condition", "condition_parameters", "action", "action_parameters"},
        .rows = {}};
    for (const Subtree& subtree : tree.subtrees) {
      table.rows.push_back({std::to_string(table.rows.size()), id_text(subtree.condition, *flavour),
                            parameters_text(subtree.condition, *flavour),
                            id_text(subtree.action, *flavour),
                            parameters_text(subtree.action, *flavour)});
    }
    return table;
  }

  ControllerTable operator()(const Network& network) const {
    ControllerTable table{.columns = {"input", "left_weight", "right_weight"}, .rows = {}};
    const std::vector<std::string> names = input_names(network.inputs);
    for (std::size_t i = 0; i < names.size(); ++i) {
      table.rows.push_back({names[i], fmt::format("{}", network.weights[i]),
                            fmt::format("{}", network.weights[names.size() + i])});
    }
    return table;
  }
};

}  // namespace

void ControllerTable::add(const ControllerTable& other, const std::vector<std::string>& begin) {
  std::vector<std::size_t> places;
  for (const std::string& column : other.columns) {
    const auto known = std::ranges::find(columns, column);
    places.push_back(static_cast<std::size_t>(known - columns.begin()));
    if (known == columns.end()) columns.push_back(column);
  }
  for (const auto& fields : other.rows) {
    rows.push_back(begin);
    rows.back().resize(columns.size());
    for (std::size_t i = 0; i < fields.size(); ++i)
      rows.back()[places[i]] = fields[i];
  }
}

std::string ControllerTable::text() const {
  std::string text = csv_line(columns);
  for (std::vector<std::string> fields : rows) {
    fields.resize(columns.size());
    text += csv_line(fields);
  }
  return text;
}

ControllerTable controller_table(const StoredController& stored) {
  return std::visit(TableOf{stored.flavour}, stored.controller);
}

}  // namespace swarmsmith

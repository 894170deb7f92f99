#include "sim/control/machine_text.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/control/flavour.h"
#include "sim/control/internal/fields.h"

namespace swarmsmith {
namespace {

class Parser {
 public:
  explicit Parser(const Flavour& flavour) : flavour_(flavour) {}

  Expected<Machine> machine(std::span<const Field> fields, const Token& end) {
    if (fields.empty() || fields[0].name.text != "--nstates") {
      const Token& found = fields.empty() ? end : fields[0].name;
      return Unexpected(error_at(found, "a machine begins with `--nstates`"));
    }
    const Expected<int> states = integer_of(fields[0], 1, kMaxStates);
    if (!states) return Unexpected(states.error());
    states_ = *states;
    Machine machine;
    std::size_t first = 1;
    for (int i = 0; i < states_; ++i) {
      const std::string name = "--s" + std::to_string(i);
      if (first == fields.size() || fields[first].name.text != name) {
        const Token& found = first == fields.size() ? end : fields[first].name;
        return Unexpected(error_at(found, "expected " + quoted(name)));
      }
      std::size_t last = first + 1;
      while (last < fields.size() && fields[last].stem != "s")
        ++last;
      const Token& block_end = last == fields.size() ? end : fields[last].name;
      Expected<State> state = this->state(i, fields.subspan(first, last - first), block_end);
      if (!state) return Unexpected(std::move(state.error()));
      machine.states.push_back(std::move(*state));
      first = last;
    }
    if (first == fields.size()) return machine;
    return Unexpected(error_at(
        fields[first].name, "expected the end, since `--nstates` is " + std::to_string(states_)));
  }

 private:
  Expected<State> state(int index, std::span<const Field> fields, const Token& end) {
    Block own(std::to_string(index), end);
    std::vector<Block> transitions;
    if (auto error = sort(index, fields, end, own, transitions)) return Unexpected(*error);
    const Expected<Field> selector = own.need("s");
    if (!selector) return Unexpected(selector.error());
    const Expected<const ModuleSpec*> spec = module_of_field(*selector, flavour_.behaviours);
    if (!spec) return Unexpected(spec.error());
    const Expected<std::vector<double>> values = parameters(**spec, own);
    if (!values) return Unexpected(values.error());
    if (auto error = check_count(own, transitions)) return Unexpected(*error);
    if (auto error = own.check_empty(id_of((*spec)->module))) return Unexpected(*error);
    State state{.behaviour = make_behaviour((*spec)->module, *values), .transitions = {}};
    for (Block& block : transitions) {
      const Expected<Transition> transition = this->transition(index, block);
      if (!transition) return Unexpected(transition.error());
      state.transitions.push_back(*transition);
    }
    return state;
  }

  /// Sorts the fields of a state into its own and those of its transitions.
  static std::optional<Error> sort(int index, std::span<const Field> fields, const Token& end,
                                   Block& own, std::vector<Block>& transitions) {
    for (const Field& field : fields) {
      if (field.state != index) {
        return error_at(field.name, quoted(field.name.text) +
                                        " does not belong into the block of state " +
                                        std::to_string(index));
      }
      if (field.transition < 0) {
        if (auto error = own.add(field)) return error;
        continue;
      }
      const int next = static_cast<int>(transitions.size());
      if (field.stem == "n" && field.transition == next) {
        if (!transitions.empty()) transitions.back().end_at(field.name);
        transitions.emplace_back(std::string(field.name.text.substr(3)), end);
      } else if (field.transition != next - 1) {
        return error_at(
            field.name,
            quoted(field.name.text) +
                " is outside the block of its transition, which begins with " +
                quoted("--n" + std::to_string(index) + "x" + std::to_string(field.transition)));
      }
      if (auto error = transitions.back().add(field)) return error;
    }
    return std::nullopt;
  }

  /// Compares the number of transitions with the announced one.
  std::optional<Error> check_count(Block& own, const std::vector<Block>& transitions) const {
    const std::optional<Field> announced = own.take("n");
    const std::string name = "--n" + own.suffix();
    if (!announced) {
      if (transitions.empty()) return std::nullopt;
      return error_at(own.end(), "expected " + quoted(name) + " before this place");
    }
    if (states_ == 1) {
      return error_at(announced->name, "the only state of a machine has no transitions");
    }
    const Expected<int> count = integer_of(*announced, 1, kMaxTransitions);
    if (!count) return count.error();
    if (static_cast<std::size_t>(*count) == transitions.size()) return std::nullopt;
    return error_at(announced->value, quoted(name) + " says " + std::to_string(*count) +
                                          " transitions, but " +
                                          std::to_string(transitions.size()) + " follow");
  }

  Expected<Transition> transition(int state, Block& block) {
    const Expected<Field> other = block.need("n");
    if (!other) return Unexpected(other.error());
    const Expected<int> destination = integer_of(*other, 0, states_ - 2);
    if (!destination) return Unexpected(destination.error());
    const Expected<Field> selector = block.need("c");
    if (!selector) return Unexpected(selector.error());
    const Expected<const ModuleSpec*> spec = module_of_field(*selector, flavour_.conditions);
    if (!spec) return Unexpected(spec.error());
    const Expected<std::vector<double>> values = parameters(**spec, block);
    if (!values) return Unexpected(values.error());
    if (auto error = block.check_empty(id_of((*spec)->module))) return Unexpected(*error);
    return Transition{.condition = make_condition((*spec)->module, *values),
                      .target = *destination < state ? *destination : *destination + 1};
  }

  Expected<const ModuleSpec*> module_of_field(const Field& field,
                                              const std::vector<ModuleSpec>& table) const {
    const Expected<int> number = integer_of(field);
    if (!number) return Unexpected(number.error());
    std::string known;
    for (const ModuleSpec& spec : table) {
      if (spec.number == *number) return &spec;
      known += (known.empty() ? "" : ", ") + std::to_string(spec.number) + " " +
               std::string(id_of(spec.module));
    }
    return Unexpected(error_at(field.value, "the flavour " + flavour_.name + " has no module " +
                                                std::to_string(*number) + " for " +
                                                quoted(field.name.text) + "; it has " + known));
  }

  Expected<std::vector<double>> parameters(const ModuleSpec& spec, Block& block) const {
    std::vector<double> values;
    for (const ParameterSpec& parameter : spec.parameters) {
      const Expected<Field> field = block.need(parameter.token);
      if (!field) return Unexpected(field.error());
      const Expected<double> value = this->value(parameter, *field);
      if (!value) return Unexpected(value.error());
      values.push_back(*value);
    }
    return values;
  }

  Expected<double> value(const ParameterSpec& parameter, const Field& field) const {
    double value = 0;
    if (parameter.type == ParameterSpec::Type::Real) {
      if (!read_number(field.value.text, value)) {
        return Unexpected(error_at(field.value, quoted(field.name.text) + " wants a number, not " +
                                                    quoted(field.value.text)));
      }
    } else {
      const Expected<int> number = integer_of(field);
      if (!number) return Unexpected(number.error());
      if (parameter.type == ParameterSpec::Type::Label) return label(field, *number);
      value = *number;
    }
    if (const auto complaint = complaint_about(parameter, value)) {
      return Unexpected(error_at(field.value, quoted(field.name.text) + ": " + *complaint +
                                                  ", not " + std::string(field.value.text)));
    }
    return value;
  }

  Expected<double> label(const Field& field, int number) const {
    std::string known;
    for (const LabelSpec& spec : flavour_.floor.labels) {
      if (spec.number == number) return static_cast<double>(spec.label);
      known += (known.empty() ? "" : ", ") + std::to_string(spec.number) + " " +
               std::string(name_of(spec.label));
    }
    return Unexpected(error_at(field.value, quoted(field.name.text) + " has no label " +
                                                std::to_string(number) + "; labels are " + known));
  }

  const Flavour& flavour_;
  int states_ = 0;
};

/// Shortest text that reads back to the same value, without an exponent of another locale.
std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

void append(std::string& text, std::string_view stem, std::string_view suffix,
            std::string_view value) {
  if (!text.empty()) text += ' ';
  text.append("--").append(stem).append(suffix).append(" ").append(value);
}

void append_parameters(std::string& text, const ModuleSpec& spec, const std::vector<double>& values,
                       const std::string& suffix, const Flavour& flavour) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    double value = values[i];
    if (spec.parameters[i].type == ParameterSpec::Type::Label) {
      for (const LabelSpec& label : flavour.floor.labels) {
        if (static_cast<double>(label.label) == values[i]) value = label.number;
      }
    }
    append(text, spec.parameters[i].token, suffix, shortest(value));
  }
}

}  // namespace

Expected<Machine> parse_machine(std::string_view text, const Flavour& flavour) {
  const std::vector<Token> tokens = tokens_of(text);
  std::span<const Token> rest = tokens;
  if (rest[0].text == "--fsm-config") rest = rest.subspan(1);
  const Expected<std::vector<Field>> fields = fields_of(rest);
  if (!fields) return Unexpected(fields.error());
  return Parser(flavour).machine(*fields, tokens.back());
}

std::string print_machine(const Machine& machine, const Flavour& flavour) {
  if (const auto error = check(machine, flavour)) throw std::invalid_argument(to_string(*error));
  std::string text = "--nstates " + std::to_string(machine.states.size());
  for (std::size_t i = 0; i < machine.states.size(); ++i) {
    const State& state = machine.states[i];
    const std::string suffix = std::to_string(i);
    const ModuleSpec& behaviour = *flavour.find(module_of(state.behaviour));
    append(text, "s", suffix, std::to_string(behaviour.number));
    append_parameters(text, behaviour, parameters_of(state.behaviour), suffix, flavour);
    if (!state.transitions.empty()) {
      append(text, "n", suffix, std::to_string(state.transitions.size()));
    }
    for (std::size_t j = 0; j < state.transitions.size(); ++j) {
      const Transition& transition = state.transitions[j];
      const std::string own = suffix + "x" + std::to_string(j);
      const int skip = transition.target > static_cast<int>(i) ? 1 : 0;
      const ModuleSpec& condition = *flavour.find(module_of(transition.condition));
      append(text, "n", own, std::to_string(transition.target - skip));
      append(text, "c", own, std::to_string(condition.number));
      append_parameters(text, condition, parameters_of(transition.condition), own, flavour);
    }
  }
  return text;
}

}  // namespace swarmsmith

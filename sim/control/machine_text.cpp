#include "sim/control/machine_text.h"

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/plain_text.h"
#include "sim/control/flavour.h"
#include "sim/control/internal/fields.h"
#include "sim/control/internal/module_text.h"

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
    const Expected<int> states = integer_of(fields[0]);
    if (!states) return Unexpected(states.error());
    if (*states < 1 || *states > flavour_.most_states) {
      return Unexpected(error_at(fields[0].value, "a machine of " + std::to_string(*states) +
                                                      " states; machines of 1 to " +
                                                      std::to_string(flavour_.most_states) +
                                                      " states are read"));
    }
    states_ = *states;
    Machine machine;
    std::size_t first = 1;
    for (int i = 0; i < states_; ++i) {
      const std::string name = "--s" + std::to_string(i);
      if (first == fields.size() || fields[first].name.text != name) {
        const Token& found = first == fields.size() ? end : fields[first].name;
        return Unexpected(expected_error(name, found));
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
    const Expected<const ModuleSpec*> spec = read_module(*selector, flavour_.behaviours, flavour_);
    if (!spec) return Unexpected(spec.error());
    const Expected<std::vector<double>> values = read_parameters(**spec, own, flavour_);
    if (!values) return Unexpected(values.error());
    if (auto error = check_count(own, transitions)) return Unexpected(*error);
    if (auto error = own.check_empty((*spec)->id)) return Unexpected(*error);
    State state{.behaviour = make_behaviour((*spec)->module, *values), .transitions = {}};
    for (Block& block : transitions) {
      const Expected<Transition> transition = this->transition(index, block);
      if (!transition) return Unexpected(transition.error());
      state.transitions.push_back(*transition);
    }
    return state;
  }

  /// Sorts the fields of a state's block: some belong to the state, the others to its transitions.
  static std::optional<Error> sort(int index, std::span<const Field> fields, const Token& end,
                                   Block& own, std::vector<Block>& transitions) {
    for (const Field& field : fields) {
      if (field.state != index) {
        return error_at(field.name, quoted(field.name.text) +
                                        " does not belong to the block of state " +
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

  /// Compares the number of transitions with the announced number.
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
    const Expected<int> count = integer_of(*announced, 1, flavour_.most_transitions);
    if (!count) return count.error();
    if (static_cast<std::size_t>(*count) == transitions.size()) return std::nullopt;
    return error_at(announced->value, quoted(name) + " says " + counted(*count, "transition") +
                                          ", but " + std::to_string(transitions.size()) +
                                          " follow");
  }

  Expected<Transition> transition(int state, Block& block) {
    const Expected<Field> other = block.need("n");
    if (!other) return Unexpected(other.error());
    const Expected<int> destination = integer_of(*other, 0, states_ - 2);
    if (!destination) return Unexpected(destination.error());
    const Expected<Field> selector = block.need("c");
    if (!selector) return Unexpected(selector.error());
    const Expected<const ModuleSpec*> spec = read_module(*selector, flavour_.conditions, flavour_);
    if (!spec) return Unexpected(spec.error());
    const Expected<std::vector<double>> values = read_parameters(**spec, block, flavour_);
    if (!values) return Unexpected(values.error());
    if (auto error = block.check_empty((*spec)->id)) return Unexpected(*error);
    return Transition{.condition = make_condition((*spec)->module, *values),
                      .target = *destination < state ? *destination : *destination + 1};
  }

  const Flavour& flavour_;
  int states_ = 0;
};

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
    append_switch(text, "s", suffix, std::to_string(behaviour.number));
    append_parameters(text, behaviour, parameters_of(state.behaviour), suffix, flavour);
    if (!state.transitions.empty()) {
      append_switch(text, "n", suffix, std::to_string(state.transitions.size()));
    }
    for (std::size_t j = 0; j < state.transitions.size(); ++j) {
      const Transition& transition = state.transitions[j];
      const std::string own = suffix + "x" + std::to_string(j);
      const int skip = transition.target > static_cast<int>(i) ? 1 : 0;
      const ModuleSpec& condition = *flavour.find(module_of(transition.condition));
      append_switch(text, "n", own, std::to_string(transition.target - skip));
      append_switch(text, "c", own, std::to_string(condition.number));
      append_parameters(text, condition, parameters_of(transition.condition), own, flavour);
    }
  }
  return text;
}

}  // namespace swarmsmith

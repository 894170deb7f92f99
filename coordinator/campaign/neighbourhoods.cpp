#include "coordinator/campaign/neighbourhoods.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// Draws modules from the distribution of the space by drawing whole controllers, so that ranges
/// and digits are right.
class MachineModules {
 public:
  MachineModules(const MachineSpace& space, Rng& rng) : space_(space), rng_(rng) {}

  Behaviour behaviour() const { return machine().states.front().behaviour; }

  /// Requires a space that has machines with two states.
  Condition condition() const {
    while (true) {
      const Machine drawn = machine();
      const std::vector<Transition>& transitions = drawn.states.front().transitions;
      if (!transitions.empty()) return transitions.front().condition;
    }
  }

 private:
  Machine machine() const {
    // The domains of targets depend only on the number of states and are never empty.
    return space_.to_machine(sample_uniform(space_.parameters(), rng_).value());
  }

  const MachineSpace& space_;
  Rng& rng_;
};

class TreeModules {
 public:
  TreeModules(const TreeSpace& space, Rng& rng) : space_(space), rng_(rng) {}

  Behaviour behaviour() const { return subtree().action; }
  Condition condition() const { return subtree().condition; }
  Subtree subtree() const {
    return space_.to_tree(sample_uniform(space_.parameters(), rng_).value()).subtrees.front();
  }

 private:
  const TreeSpace& space_;
  Rng& rng_;
};

/// Replaces the module by another one of its kind; false if there is no other.
template <class Module, class Draw>
bool exchange_module(Module& module, std::size_t known, Draw draw) {
  if (known < 2) return false;
  const auto before = module_of(module);
  while (module_of(module) == before)
    module = draw();
  return true;
}

Behaviour made_again(const Behaviour& like, std::span<const double> parameters) {
  return make_behaviour(module_of(like), parameters);
}
Condition made_again(const Condition& like, std::span<const double> parameters) {
  return make_condition(module_of(like), parameters);
}

/// Draws one of the module's parameters anew from its whole range; false if it has none.
template <class Module, class Draw>
bool draw_parameter(Module& module, Rng& rng, Draw draw) {
  std::vector<double> parameters = parameters_of(module);
  if (parameters.empty()) return false;
  const std::size_t index = rng.below(parameters.size());
  Module other = draw();
  while (module_of(other) != module_of(module))
    other = draw();
  parameters[index] = parameters_of(other)[index];
  module = made_again(module, parameters);
  return true;
}

/// The operators on a machine. Each one changes the machine and returns true, or leaves it
/// unchanged and returns false.
class MachineOperators {
 public:
  MachineOperators(Machine& machine, const Method& method, MachineModules modules, Rng& rng)
      : states_(machine.states), method_(method), modules_(modules), rng_(rng) {}

  static constexpr std::size_t kCount = 11;

  bool apply(std::size_t index) {
    switch (index) {
      case 0:
        return change_start();
      case 1:
        return add_state();
      case 2:
        return remove_state();
      case 3:
        return exchange_module(any_state().behaviour, method_.behaviours.size(),
                               [this] { return modules_.behaviour(); });
      case 4:
        return draw_parameter(any_state().behaviour, rng_, [this] { return modules_.behaviour(); });
      case 5:
        return add_transition();
      case 6:
        return remove_transition();
      case 7:
        return move_begin();
      case 8:
        return move_end();
      case 9:
        return change_condition(false);
      default:
        return change_condition(true);
    }
  }

 private:
  struct Place {
    std::size_t state;
    std::size_t transition;
  };

  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(rng_.below(count)); }
  State& any_state() { return states_[draw(states_.size())]; }
  bool has_room(const State& state) const {
    return static_cast<std::int64_t>(state.transitions.size()) < method_.max_transitions;
  }
  /// A random transition; all transitions have the same probability.
  std::optional<Place> any_transition() {
    std::vector<Place> places;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      for (std::size_t j = 0; j < states_[i].transitions.size(); ++j)
        places.push_back({i, j});
    }
    if (places.empty()) return std::nullopt;
    return places[draw(places.size())];
  }
  Transition& at(const Place& place) { return states_[place.state].transitions[place.transition]; }
  void erase(const Place& place) {
    auto& transitions = states_[place.state].transitions;
    transitions.erase(transitions.begin() + static_cast<std::ptrdiff_t>(place.transition));
  }
  /// A random state other than these two.
  std::optional<std::size_t> other_than(std::size_t a, std::size_t b) {
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (i != a && i != b) others.push_back(i);
    }
    if (others.empty()) return std::nullopt;
    return others[draw(others.size())];
  }

  bool change_start() {
    if (states_.size() < 2) return false;
    const std::size_t first = 1 + draw(states_.size() - 1);
    std::swap(states_[0], states_[first]);
    const auto moved = static_cast<int>(first);
    for (State& state : states_) {
      for (Transition& transition : state.transitions) {
        if (transition.target == 0) {
          transition.target = moved;
        } else if (transition.target == moved) {
          transition.target = 0;
        }
      }
    }
    return true;
  }

  bool add_state() {
    if (static_cast<std::int64_t>(states_.size()) >= method_.max_states) return false;
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (has_room(states_[i])) sources.push_back(i);
    }
    if (sources.empty()) return insert_state();
    const std::size_t source = sources[draw(sources.size())];
    const std::size_t target = draw(states_.size());
    const auto added = static_cast<int>(states_.size());
    // A machine's only state had no outgoing transition, and now needs one to the new state.
    states_[source].transitions.push_back({modules_.condition(), added});
    State state{modules_.behaviour(), {}};
    state.transitions.push_back({modules_.condition(), static_cast<int>(target)});
    states_.push_back(std::move(state));
    return true;
  }

  /// Puts a new state into a transition. With one transition a state, each state of a machine needs
  /// its own, so no operator could make room for another one.
  bool insert_state() {
    const auto place = any_transition();
    if (method_.max_transitions > 1 || !place) return false;
    Transition& into = at(*place);
    State state{modules_.behaviour(), {{modules_.condition(), into.target}}};
    into.target = static_cast<int>(states_.size());
    states_.push_back(std::move(state));
    return true;
  }

  bool remove_state() {
    if (states_.size() < 2) return false;
    std::vector<Machine> results;
    for (std::size_t i = 1; i < states_.size(); ++i) {
      if (auto without = machine_without(i)) results.push_back(std::move(*without));
    }
    if (results.empty()) return false;
    states_ = std::move(results[draw(results.size())].states);
    return true;
  }

  /// The machine without the state; none if other states could then not be reached, or would have
  /// no transitions left.
  std::optional<Machine> machine_without(std::size_t removed) const {
    Machine machine{states_};
    std::vector<State>& states = machine.states;
    states.erase(states.begin() + static_cast<std::ptrdiff_t>(removed));
    const auto gone = static_cast<int>(removed);
    for (State& state : states) {
      std::erase_if(state.transitions, [gone](const Transition& t) { return t.target == gone; });
      for (Transition& transition : state.transitions) {
        if (transition.target > gone) --transition.target;
      }
      if (states.size() > 1 && state.transitions.empty()) return std::nullopt;
    }
    const std::vector<bool> reached_before = reachable_states(Machine{states_});
    const std::vector<bool> reached = reachable_states(machine);
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached_before[i < removed ? i : i + 1] && !reached[i]) return std::nullopt;
    }
    return machine;
  }

  bool add_transition() {
    if (states_.size() < 2) return false;
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (has_room(states_[i])) sources.push_back(i);
    }
    if (sources.empty()) return false;
    const std::size_t source = sources[draw(sources.size())];
    const std::size_t target = *other_than(source, source);
    states_[source].transitions.push_back({modules_.condition(), static_cast<int>(target)});
    return true;
  }

  bool remove_transition() {
    const auto place = any_transition();
    // The state that it leaves must keep a transition that leaves it, and the state that it enters
    // one that enters it.
    if (!place || states_[place->state].transitions.size() < 2) return false;
    int incoming = 0;
    for (const State& state : states_) {
      incoming += static_cast<int>(
          std::ranges::count(state.transitions, at(*place).target, &Transition::target));
    }
    if (incoming < 2) return false;
    erase(*place);
    return true;
  }

  bool move_begin() {
    const auto place = any_transition();
    if (!place || states_[place->state].transitions.size() < 2) return false;
    const Transition moved = at(*place);
    const auto begin = other_than(place->state, static_cast<std::size_t>(moved.target));
    if (!begin || !has_room(states_[*begin])) return false;
    erase(*place);
    states_[*begin].transitions.push_back(moved);
    return true;
  }

  bool move_end() {
    const auto place = any_transition();
    if (!place) return false;
    const auto end = other_than(place->state, static_cast<std::size_t>(at(*place).target));
    if (!end) return false;
    at(*place).target = static_cast<int>(*end);
    return true;
  }

  bool change_condition(bool parameter_alone) {
    const auto place = any_transition();
    if (!place) return false;
    Condition& condition = at(*place).condition;
    const auto drawn = [this] { return modules_.condition(); };
    return parameter_alone ? draw_parameter(condition, rng_, drawn)
                           : exchange_module(condition, method_.conditions.size(), drawn);
  }

  std::vector<State>& states_;
  const Method& method_;
  MachineModules modules_;
  Rng& rng_;
};

class TreeOperators {
 public:
  TreeOperators(Tree& tree, const Method& method, TreeModules modules, Rng& rng)
      : subtrees_(tree.subtrees), method_(method), modules_(modules), rng_(rng) {}

  static constexpr std::size_t kCount = 7;

  bool apply(std::size_t index) {
    const std::size_t size = subtrees_.size();
    Subtree& any = subtrees_[draw(size)];
    const auto behaviour = [this] { return modules_.behaviour(); };
    const auto condition = [this] { return modules_.condition(); };
    switch (index) {
      case 0:
        if (static_cast<std::int64_t>(size) >= method_.max_subtrees) return false;
        subtrees_.insert(subtrees_.begin() + static_cast<std::ptrdiff_t>(draw(size + 1)),
                         modules_.subtree());
        return true;
      case 1:
        if (size < 2) return false;
        subtrees_.erase(subtrees_.begin() + static_cast<std::ptrdiff_t>(draw(size)));
        return true;
      case 2: {
        if (size < 2) return false;
        const std::size_t one = draw(size);
        const std::size_t other = (one + 1 + draw(size - 1)) % size;
        std::swap(subtrees_[one], subtrees_[other]);
        return true;
      }
      case 3:
        return exchange_module(any.action, method_.behaviours.size(), behaviour);
      case 4:
        return draw_parameter(any.action, rng_, behaviour);
      case 5:
        return exchange_module(any.condition, method_.conditions.size(), condition);
      default:
        return draw_parameter(any.condition, rng_, condition);
    }
  }

 private:
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(rng_.below(count)); }

  std::vector<Subtree>& subtrees_;
  const Method& method_;
  TreeModules modules_;
  Rng& rng_;
};

/// Draws operators until one acts and the result differs.
template <class Operators, class Kind, class Modules>
Kind perturbed(const Kind& from, const Method& method, Modules modules, Rng& rng) {
  while (true) {
    Kind changed = from;
    std::vector<std::size_t> left(Operators::kCount);
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] = i;
    while (!left.empty()) {
      const auto chosen = left.begin() + static_cast<std::ptrdiff_t>(rng.below(left.size()));
      if (Operators(changed, method, modules, rng).apply(*chosen)) break;
      left.erase(chosen);
    }
    // No operator can act on a method with a single module without parameters.
    if (left.empty() || !(changed == from)) return changed;
  }
}

bool has_stop(const Method& method) {
  return std::ranges::find(method.behaviours, id_of(Module::Stop)) != method.behaviours.end();
}

}  // namespace

search::Neighbourhood machine_neighbourhood(const std::shared_ptr<const MachineSpace>& space,
                                            const Method& method) {
  Rng rng(1);
  Machine start{{{Stop{}, {}}}};
  if (!has_stop(method)) start.states[0].behaviour = MachineModules(*space, rng).behaviour();
  Configuration configuration = space->from_machine(start);
  const auto perturb = [space, method](const Configuration& from,
                                       Rng& draws) -> Expected<Configuration> {
    const Machine machine = space->to_machine(from);
    return space->from_machine(
        perturbed<MachineOperators>(machine, method, MachineModules(*space, draws), draws));
  };
  return {std::move(configuration), perturb};
}

search::Neighbourhood tree_neighbourhood(const std::shared_ptr<const TreeSpace>& space,
                                         const Method& method) {
  Rng rng(1);
  Tree start{{TreeModules(*space, rng).subtree()}};
  if (has_stop(method)) start.subtrees[0].action = Stop{};
  Configuration configuration = space->from_tree(start);
  const auto perturb = [space, method](const Configuration& from,
                                       Rng& draws) -> Expected<Configuration> {
    const Tree tree = space->to_tree(from);
    return space->from_tree(
        perturbed<TreeOperators>(tree, method, TreeModules(*space, draws), draws));
  };
  return {std::move(configuration), perturb};
}

}  // namespace swarmsmith

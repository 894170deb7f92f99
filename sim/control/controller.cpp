#include "sim/control/controller.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/overloaded.h"
#include "sim/control/flavour.h"
#include "sim/control/foreign_text.h"
#include "sim/control/internal/fields.h"
#include "sim/control/internal/genome.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// In characters; the controllers of this program have some thousand.
constexpr std::size_t kLongestController = 1 << 20;

constexpr std::array<std::pair<std::string_view, Architecture>, 7> kFirstSwitches = {{
    {"--nstates", Architecture::Machine},
    {"--fsm-config", Architecture::Machine},
    {"--nroot", Architecture::Tree},
    {"--rootnode", Architecture::Tree},
    {"--bt-config", Architecture::Tree},
    {"--network", Architecture::Network},
    {kGenomeStart, Architecture::Network},
}};

/// Converts a controller of one kind to the variant.
template <class Kind>
Expected<Controller> as_controller(Expected<Kind> read) {
  if (!read) return Unexpected(std::move(read.error()));
  return Controller(std::move(*read));
}

}  // namespace

std::string_view name_of(Architecture architecture) {
  switch (architecture) {
    case Architecture::Machine:
      return "machine";
    case Architecture::Tree:
      return "tree";
    case Architecture::Network:
      break;
  }
  return "network";
}

Architecture architecture_of(const Controller& controller) {
  return std::visit(Overloaded{[](const Machine&) { return Architecture::Machine; },
                               [](const Tree&) { return Architecture::Tree; },
                               [](const Network&) { return Architecture::Network; }},
                    controller);
}

std::optional<Architecture> architecture_of_text(std::string_view text) {
  const std::string_view first = tokens_of(text).front().text;
  for (const auto& [name, architecture] : kFirstSwitches) {
    if (first == name) return architecture;
  }
  return std::nullopt;
}

std::string first_switches() {
  std::string list;
  for (const auto& [name, architecture] : kFirstSwitches)
    list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

std::size_t find_controller(std::string_view line) {
  std::size_t first = std::string_view::npos;
  for (const auto& [name, architecture] : kFirstSwitches)
    first = std::min(first, line.find(name));
  return first;
}

Expected<Controller> parse_controller(std::string_view text, const Flavour& flavour) {
  if (text.size() > kLongestController) {
    return unexpected(ErrorKind::BadInput,
                      "control software has at most " + std::to_string(kLongestController) +
                          " characters, but this text has " + std::to_string(text.size()));
  }
  const auto architecture = architecture_of_text(text);
  if (!architecture) {
    const std::size_t at = find_controller(text);
    auto complaint =
        at == std::string_view::npos ? std::nullopt : complaint_about_name(text.substr(0, at));
    return Unexpected(error_at(tokens_of(text).front(),
                               complaint
                                   ? std::move(*complaint)
                                   : "control software begins with one of " + first_switches()));
  }
  switch (*architecture) {
    case Architecture::Tree:
      return as_controller(parse_tree(text, flavour));
    case Architecture::Network:
      return as_controller(parse_network(text, flavour));
    case Architecture::Machine:
      break;
  }
  return as_controller(parse_machine(text, flavour));
}

std::string print_controller(const Controller& controller, const Flavour& flavour) {
  return std::visit(
      Overloaded{[&](const Machine& machine) { return print_machine(machine, flavour); },
                 [&](const Tree& tree) { return print_tree(tree, flavour); },
                 [&](const Network& network) { return print_network(network, flavour); }},
      controller);
}

std::string_view acting_in(const Controller& controller, int state) {
  const auto at = static_cast<std::size_t>(state);
  return std::visit(
      Overloaded{
          [at](const Machine& machine) { return id_of(module_of(machine.states[at].behaviour)); },
          [at](const Tree& tree) { return id_of(module_of(tree.subtrees[at].action)); },
          [](const Network&) { return name_of(Architecture::Network); }},
      controller);
}

std::optional<std::string> complaint_about_running(const Controller& controller,
                                                   const Flavour& flavour) {
  std::optional<std::string> complaint;
  const auto look_at = [&](Module module) {
    if (complaint || !is_external(module)) return;
    const ModuleSpec* spec = flavour.find(module);
    complaint = "the module " + (spec == nullptr ? "external" : spec->id) + " of the flavour " +
                flavour.name +
                " is external: this program can read it, but only your own program can run it";
  };
  std::visit(Overloaded{[&](const Machine& machine) {
                          for (const State& state : machine.states) {
                            look_at(module_of(state.behaviour));
                            for (const Transition& transition : state.transitions)
                              look_at(module_of(transition.condition));
                          }
                        },
                        [&](const Tree& tree) {
                          for (const Subtree& subtree : tree.subtrees) {
                            look_at(module_of(subtree.action));
                            look_at(module_of(subtree.condition));
                          }
                        },
                        [](const Network&) {}},
             controller);
  return complaint;
}

std::optional<Error> check(const Controller& controller, const Flavour& flavour) {
  return std::visit([&](const auto& one) { return check(one, flavour); }, controller);
}

}  // namespace swarmsmith

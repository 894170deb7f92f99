#include "tests/irace_core/spaces.h"

namespace swarmsmith::testing {
namespace {

Expression more_than(const std::string& parameter, int value) {
  return call(Operation::Greater, name(parameter), number(value));
}

/// The parameters of transition j of state i.
void add_transition(std::vector<Parameter>& parameters, const std::string& i, int j) {
  const std::string ij = i + "x" + std::to_string(j);
  const std::string condition = "C" + ij;
  const Expression exists = more_than("NumConnections" + i, j);
  const auto when = [&](const char* value) { return equals(condition, value); };
  const Expression last_target =
      call(Operation::Max, number(0), call(Operation::Subtract, name("NumStates"), number(2)));
  parameters.push_back({"N" + ij, "--n" + ij + " ", Integer{0.0, last_target}, exists});
  parameters.push_back(
      {condition, "--c" + ij + " ", Categorical{{"0", "1", "2", "3", "4", "5", "6"}}, exists});
  parameters.push_back(active_when(
      make_real("P" + ij, 0, 1),
      Expression::in(name(condition), {text("0"), text("1"), text("2"), text("5"), text("6")})));
  parameters.push_back(active_when(make_integer("B" + ij, 1, 10), when("3")));
  parameters.push_back(active_when(make_real("W" + ij, 0, 20), when("3")));
  parameters.push_back(active_when(make_integer("BI" + ij, 1, 10), when("4")));
  parameters.push_back(active_when(make_real("WI" + ij, 0, 20), when("4")));
  parameters.push_back(active_when(make_integer("L" + ij, 0, 3), when("6")));
}

}  // namespace

ParameterSpace automode_space() {
  std::vector<Parameter> parameters{make_integer("NumStates", 1, 4)};
  for (int state = 0; state < 4; ++state) {
    const std::string i = std::to_string(state);
    const auto behaves = [&](const char* value) { return equals("S" + i, value); };
    parameters.push_back(active_when(make_categorical("S" + i, {"0", "1", "2", "3"}),
                                     more_than("NumStates", state)));
    parameters.push_back(active_when(make_integer("RWM" + i, 1, 100), behaves("0")));
    parameters.push_back(active_when(make_real("ATT" + i, 1, 5), behaves("2")));
    parameters.push_back(active_when(make_real("REP" + i, 1, 5), behaves("3")));
    parameters.push_back(active_when(make_integer("NumConnections" + i, 1, 4),
                                     more_than("NumStates", state == 0 ? 1 : state)));
    for (int j = 0; j < 4; ++j)
      add_transition(parameters, i, j);
  }
  return space_of(std::move(parameters), {}, 2);
}

}  // namespace swarmsmith::testing

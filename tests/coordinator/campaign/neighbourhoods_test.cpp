#include "coordinator/campaign/neighbourhoods.h"

#include <gmock/gmock.h>
#include <set>

#include "coordinator/campaign/method_space.h"
#include "sim/control/machine_text.h"
#include "tests/coordinator/campaign/campaign_support.h"

namespace swarmsmith {
namespace {

Method method_of(const std::string& more) {
  return parsed(FileText{.method = "name = \"m\"\n" + more, .race = "max_experiments = 100000\n"}
                    .text())
      .methods[0];
}

struct Walk {
  explicit Walk(const std::string& more)
      : method(method_of(more)), space(MethodSpace::make(method, 2).value()) {}

  Method method;
  MethodSpace space;
};

class Neighbourhoods : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(
    Kinds, Neighbourhoods,
    ::testing::Values("", "flavour = \"chocolate\"\n", "max_states = 2\nmax_transitions = 1\n",
                      "max_transitions = 1\n", "architecture = \"tree\"\n",
                      "architecture = \"tree\"\nflavour = \"chocolate\"\nmax_subtrees = 2\n"));

TEST_P(Neighbourhoods, LeaveAValidPointOfTheSpaceThatIsAnother) {
  const Walk walk(GetParam());
  const auto neighbourhood = walk.space.neighbourhood();
  Rng rng(1);
  Configuration now = neighbourhood->start;
  ASSERT_TRUE(walk.space.parameters().check(now));
  for (int i = 0; i < 20'000; ++i) {
    const Configuration next = neighbourhood->perturb(now, rng).value();
    const auto checked = walk.space.parameters().check(next);
    ASSERT_TRUE(checked) << to_string(checked.error());
    ASSERT_FALSE(next == now);
    now = next;
  }
}

TEST_P(Neighbourhoods, LeaveAValidPointFromAnyRandomOne) {
  const Walk walk(GetParam());
  const auto neighbourhood = walk.space.neighbourhood();
  Rng rng(2);
  for (int i = 0; i < 20'000; ++i) {
    const Configuration drawn = sample_uniform(walk.space.parameters(), rng).value();
    const auto checked = walk.space.parameters().check(neighbourhood->perturb(drawn, rng).value());
    ASSERT_TRUE(checked) << to_string(checked.error());
  }
}

TEST(MachineSpace, TakesMachinesBackToTheirConfigurations) {
  for (const char* more : {"", "flavour = \"chocolate\"\n", "max_states = 1\n",
                           "max_states = 2\nmax_transitions = 1\n"}) {
    const Walk walk(more);
    const MachineSpace space =
        MachineSpace::make(walk.method, **find_flavour(walk.method.flavour), 2).value();
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
      const Configuration drawn = sample_uniform(space.parameters(), rng).value();
      EXPECT_EQ(space.from_machine(space.to_machine(drawn)), drawn);
    }
  }
}

TEST(TreeSpace, TakesTreesBackToTheirConfigurations) {
  const Walk walk("architecture = \"tree\"\n");
  const TreeSpace space = TreeSpace::make(walk.method, watermelon(), 2).value();
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const Configuration drawn = sample_uniform(space.parameters(), rng).value();
    EXPECT_EQ(space.from_tree(space.to_tree(drawn)), drawn);
  }
}

/// Each state has only the transition that it needs, so none has room for a further one.
TEST(MachineNeighbourhood, GrowsAndShrinksWithOneTransitionAState) {
  const Walk walk("max_states = 4\nmax_transitions = 1\n");
  const auto neighbourhood = walk.space.neighbourhood();
  Rng rng(5);
  Configuration now = neighbourhood->start;
  int whole_ways = 0;  // from one state to four, and back
  std::size_t next = 4;
  for (int i = 0; i < 50'000; ++i) {
    now = neighbourhood->perturb(now, rng).value();
    if (std::get<Machine>(walk.space.controller_of(now)).states.size() != next) continue;
    next = next == 4 ? 1 : 4;
    ++whole_ways;
  }
  EXPECT_GT(whole_ways, 10);
}

/// Of two states and two modules without parameters that matter, every machine is met.
TEST(MachineNeighbourhood, ReachesEveryStructureFromStop) {
  const Walk walk(
      "max_states = 3\nmax_transitions = 2\nbehaviours = [\"stop\", \"attraction\"]\nconditions = "
      "[\"black_floor\", \"white_floor\"]\n");
  const auto neighbourhood = walk.space.neighbourhood();
  // A structure: behaviours, and conditions with targets of each state, parameters left out; those
  // that random draws find must all be met by the walk.
  const auto structure = [&](const Configuration& configuration) {
    std::string text;
    const Machine machine = std::get<Machine>(walk.space.controller_of(configuration));
    for (const State& state : machine.states) {
      text += "|" + std::string(id_of(module_of(state.behaviour)));
      for (const Transition& transition : state.transitions)
        text += "," + std::string(id_of(module_of(transition.condition))) +
                std::to_string(transition.target);
    }
    return text;
  };
  Rng rng(4);
  std::set<std::string> small;  // of at most two states: 2 + 4 * 6 * 6
  Configuration now = neighbourhood->start;
  for (int i = 0; i < 200'000; ++i) {
    now = neighbourhood->perturb(now, rng).value();
    if (std::get<Machine>(walk.space.controller_of(now)).states.size() <= 2)
      small.insert(structure(now));
  }
  EXPECT_EQ(small.size(), 2U + 4 * 6 * 6);
}

TEST(MachineNeighbourhood, StartsAtOneStateThatStops) {
  const Walk walk("");
  EXPECT_EQ(walk.space.text_of(walk.space.neighbourhood()->start).machine, "--nstates 1 --s0 1");
}

}  // namespace
}  // namespace swarmsmith

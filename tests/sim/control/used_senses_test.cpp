#include "sim/control/used_senses.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

Machine one_state(const Behaviour& behaviour) {
  return {.states = {{.behaviour = behaviour, .transitions = {}}}};
}

Machine waits_for(const Condition& condition) {
  return {.states = {{.behaviour = Stop{}, .transitions = {{.condition = condition, .target = 1}}},
                     {.behaviour = Stop{}, .transitions = {}}}};
}

TEST(UsedSenses, ABehaviourUsesWhatItSteersBy) {
  const auto used = [](const Behaviour& behaviour, const Flavour& flavour = chocolate()) {
    return senses_used_by(one_state(behaviour), flavour);
  };
  EXPECT_EQ(used(Stop{}), UsedSenses{});
  EXPECT_EQ(used(Exploration{5}), UsedSenses{.proximity = true});
  EXPECT_EQ(used(Phototaxis{}), (UsedSenses{.proximity = true, .light = true}));
  EXPECT_EQ(used(AntiPhototaxis{}), (UsedSenses{.proximity = true, .light = true}));
  EXPECT_EQ(used(Attraction{1}), (UsedSenses{.proximity = true, .neighbours = true}));
  EXPECT_EQ(used(Repulsion{1}), (UsedSenses{.proximity = true, .neighbours = true}));
}

TEST(UsedSenses, NeighboursThatCountAsObstaclesAreUsedToAvoidThem) {
  Flavour flavour = watermelon();
  for (const bool as_obstacles : {false, true}) {
    flavour.obstacles.neighbours_as_obstacles = as_obstacles;
    EXPECT_EQ(senses_used_by(one_state(Exploration{5}), flavour),
              (UsedSenses{.proximity = true, .neighbours = as_obstacles}));
  }
}

TEST(UsedSenses, AConditionUsesWhatItWaitsFor) {
  const auto used = [](const Condition& condition) {
    return senses_used_by(waits_for(condition), watermelon());
  };
  EXPECT_EQ(used(FixedProbability{0.5}), UsedSenses{});
  for (const Condition& condition :
       {Condition(BlackFloor{1}), Condition(GrayFloor{1}), Condition(WhiteFloor{1}),
        Condition(ColorDetection{1, ColorLabel::Red})}) {
    EXPECT_EQ(used(condition), UsedSenses{.ground_color = true});
  }
  EXPECT_EQ(used(NeighbourCount{1, 1}), UsedSenses{.neighbours = true});
  EXPECT_EQ(used(InvertedNeighbourCount{1, 1}), UsedSenses{.neighbours = true});
}

TEST(UsedSenses, AStateThatIsNeverReachedUsesNothing) {
  Machine machine = waits_for(FixedProbability{1});
  machine.states.push_back({.behaviour = Attraction{1}, .transitions = {}});
  EXPECT_EQ(senses_used_by(machine, watermelon()), UsedSenses{});
}

TEST(UsedSenses, TreesUseWhatTheirLeavesUse) {
  const Tree tree{.subtrees = {{.condition = BlackFloor{1}, .action = Exploration{3}},
                               {.condition = NeighbourCount{1, 1}, .action = Stop{}}}};
  EXPECT_EQ(senses_used_by(tree, chocolate()),
            (UsedSenses{.proximity = true, .ground_color = true, .neighbours = true}));
}

TEST(UsedSenses, NetworksUseAllThatTheirInputsName) {
  const UsedSenses dark{.proximity = true, .ground_color = true, .neighbours = true};
  UsedSenses lit = dark;
  lit.light = true;
  EXPECT_EQ(senses_used_by(Network{.inputs = NetworkInputs::Rvr, .weights = {}}, watermelon()),
            dark);
  EXPECT_EQ(senses_used_by(Network{.inputs = NetworkInputs::RvrGray, .weights = {}}, watermelon()),
            dark);
  EXPECT_EQ(senses_used_by(Network{.inputs = NetworkInputs::Rm12, .weights = {}}, chocolate()),
            lit);
}

}  // namespace
}  // namespace swarmsmith

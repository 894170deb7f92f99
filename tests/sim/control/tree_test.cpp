#include "sim/control/tree.h"

#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Stop until the floor is black, then straight on (no obstacle is near) for good.
Tree stop_then_go() {
  return {{{BlackFloor{1}, Stop{}}, {FixedProbability{0}, Exploration{10}}}};
}

TEST(Tree, GoesOnWithTheNextSubtreeInTheSameCycle) {
  const Tree tree = stop_then_go();
  TreeControl control(tree, watermelon(), Rng(1));
  FakeSenses senses;
  EXPECT_EQ(control.step(senses), Command{});
  EXPECT_EQ(control.state(), 0);
  senses.floor = {0, 0, 0};
  EXPECT_GT(control.step(senses).left_mps, 0);  // not one cycle later
  EXPECT_EQ(control.state(), 1);
  senses.floor = {127, 127, 127};
  EXPECT_GT(control.step(senses).left_mps, 0);  // and it does not come back
}

TEST(Tree, StandsStillInTheCycleInWhichTheRootSucceeds) {
  // The last condition holds in the second cycle on black.
  const Tree tree{{{BlackFloor{1}, Exploration{10}}, {BlackFloor{1}, Exploration{10}}}};
  TreeControl control(tree, watermelon(), Rng(1));
  FakeSenses senses;
  EXPECT_GT(control.step(senses).left_mps, 0);
  senses.floor = {0, 0, 0};
  EXPECT_EQ(control.step(senses), Command{});  // through both, and over
  EXPECT_EQ(control.state(), 0);
  senses.floor = {127, 127, 127};
  EXPECT_GT(control.step(senses).left_mps, 0);
}

TEST(Tree, OfOneSubtreeStandsWheneverItsConditionHolds) {
  const Tree tree{{{BlackFloor{1}, Exploration{10}}}};
  TreeControl control(tree, watermelon(), Rng(1));
  FakeSenses senses;
  senses.floor = {0, 0, 0};
  EXPECT_EQ(control.step(senses), Command{});
  EXPECT_EQ(control.step(senses), Command{});
}

TEST(Tree, AnActionThatIsEnteredAgainKeepsItsTurn) {
  // A machine would forget the turn.
  const Tree tree{{{WhiteFloor{1}, Exploration{100}}, {GrayFloor{1}, Stop{}}}};
  TreeControl control(tree, watermelon_argos3(), Rng(5));
  FakeSenses senses;
  senses.obstacle(0, 0.06);
  (void)control.step(senses);  // sees the obstacle; turns from the next cycle on
  senses.distances.fill(kNothing);
  const Command turning = control.step(senses);
  ASSERT_LT(turning.left_mps * turning.right_mps, 0);
  senses.floor = {255, 255, 255};
  EXPECT_EQ(control.step(senses), Command{});  // Stop acts
  EXPECT_EQ(control.state(), 1);
  senses.floor = {127, 127, 127};
  EXPECT_EQ(control.step(senses), Command{});  // the root succeeds
  const Command again = control.step(senses);
  EXPECT_EQ(again, turning);
}

TEST(Tree, ConditionsHoldWithTheirProbability) {
  const Tree tree{{{FixedProbability{0.25}, Stop{}}, {FixedProbability{0}, Exploration{1}}}};
  int cycles = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    TreeControl control(tree, watermelon(), Rng(seed));
    FakeSenses senses;
    do {
      (void)control.step(senses);
      ++cycles;
    } while (control.state() == 0);
  }
  EXPECT_NEAR(cycles / 4000.0, 4, 0.2);
}

constexpr const char* kPublished =
    "--nroot 3 --nchildroot 3 --n0 0 --nchild0 2 --n00 6 --c00 5 --p00 0.16 --n01 5 --a01 4 "
    "--att01 3.26 --p01 0 --n1 0 --nchild1 2 --n10 6 --c10 3 --p10 6 --w10 10.24 --n11 5 --a11 1 "
    "--p11 0 --n2 0 --nchild2 2 --n20 6 --c20 0 --p20 0.45 --n21 5 --a21 0 --rwm21 21 --p21 0";

TEST(TreeText, ReadsAndPrintsTheFormOfThePrograms) {
  for (const char* prefix : {"", "--bt-config "}) {
    const auto tree = value_of(parse_tree(std::string(prefix) + kPublished, chocolate()));
    ASSERT_EQ(tree.subtrees.size(), 3U);
    EXPECT_EQ(tree.subtrees[0].condition, Condition(FixedProbability{0.16}));
    EXPECT_EQ(tree.subtrees[0].action, Behaviour(Attraction{3.26}));
    EXPECT_EQ(tree.subtrees[2].action, Behaviour(Exploration{21}));
    EXPECT_EQ(print_tree(tree, chocolate()), kPublished);
  }
}

/// The form of 2018: AutoMoDe-private, branch BehaviorTree, Experiments/Controllers.
constexpr const char* kOldForm =
    "--rootnode 0 --nchildsroot 3 --n0 0 --nc0 1 --c0x0 5 --p0x0 0.16 --a0 4 --att0 3.26 "
    "--n1 0 --nc1 1 --c1x0 3 --p1x0 6 --w1x0 10.24 --a1 1 "
    "--n2 0 --nc2 1 --c2x0 0 --p2x0 0.45 --a2 0 --rwm2 21";

TEST(TreeText, ReadsTheOlderFormAndPrintsTheNewerOne) {
  for (const char* prefix : {"", "--bt-config "}) {
    const auto tree = value_of(parse_tree(std::string(prefix) + kOldForm, chocolate()));
    EXPECT_EQ(print_tree(tree, chocolate()), kPublished);
  }
  const auto any = value_of(parse_controller(kOldForm, chocolate()));
  EXPECT_EQ(architecture_of(any), Architecture::Tree);
}

TEST(TreeText, OfTheOlderFormSaysWhatIsWrongAndWhere) {
  const std::string good = "--rootnode 0 --nchildsroot 1 --n0 0 --nc0 1 --c0x0 0 --p0x0 1 --a0 1";
  ASSERT_TRUE(parse_tree(good, watermelon()));
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const auto read = parse_tree(text, watermelon());
    return read ? "read" : read.error().where + ": " + read.error().message;
  };
  EXPECT_THAT(complaint("--rootnode 0", "--rootnode 1"),
              HasSubstr("token 2, column 12: `--rootnode` must be 0"));
  EXPECT_THAT(complaint("--nchildsroot 1", "--nchildsroot 5"), HasSubstr("from 1 to 4"));
  EXPECT_THAT(complaint("--nchildsroot 1", "--nchildsroot 2"), HasSubstr("expected `--n1`"));
  EXPECT_THAT(complaint("--nchildsroot 1 ", ""), HasSubstr("expected `--nchildsroot`"));
  EXPECT_THAT(complaint("--n0 0", "--n0 2"), HasSubstr("only Maple's trees"));
  EXPECT_THAT(complaint("--nc0 1", "--nc0 0"), HasSubstr("a subtree of 0 conditions"));
  EXPECT_THAT(complaint("--nc0 1", "--nc0 2"),
              HasSubstr("a subtree of 2 conditions; trees with one"));
  EXPECT_THAT(complaint("--p0x0 1", "--p0x0 1 --c0x1 0 --p0x1 1"),
              HasSubstr("`--c0x1` is of a condition beyond the one that `--nc0` announces"));
  EXPECT_THAT(complaint("--a0 1", ""), HasSubstr("expected `--a0`"));
  EXPECT_THAT(complaint("--a0 1", "--a0 99"), HasSubstr("has no module 99"));
  EXPECT_THAT(complaint("--a0 1", "--a0 1 --rwm0 4"), HasSubstr("does not belong to stop"));
  EXPECT_THAT(complaint("--a0 1", "--a0 1 --n1 0"), HasSubstr("expected the end"));
  EXPECT_THAT(complaint("--a0 1", "--a0 1 --robots 20"), HasSubstr("`--robots`"));
}

TEST(TreeText, SaysWhatIsWrongAndWhere) {
  const std::string good =
      "--nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 1 --n01 5 --a01 1 --p01 0";
  ASSERT_TRUE(parse_tree(good, watermelon()));
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const auto read = parse_tree(text, watermelon());
    return read ? "read" : read.error().where + ": " + read.error().message;
  };
  EXPECT_THAT(complaint("--nroot 3", "--nroot 1"),
              HasSubstr("token 2, column 9: `--nroot` must be 3"));
  EXPECT_THAT(complaint("--nchildroot 1", "--nchildroot 5"), HasSubstr("from 1 to 4"));
  EXPECT_THAT(complaint("--nchildroot 1", "--nchildroot 2"), HasSubstr("expected `--n1`"));
  EXPECT_THAT(complaint("--n0 0", "--n0 2"), HasSubstr("only Maple's trees"));
  EXPECT_THAT(complaint("--nchild0 2", "--nchild0 3"), HasSubstr("`--nchild0` must be 2"));
  EXPECT_THAT(complaint("--n00 6", "--n00 5"), HasSubstr("a condition"));
  EXPECT_THAT(complaint("--p01 0", "--p01 1"), HasSubstr("never reports success"));
  EXPECT_THAT(complaint("--p01 0", ""), HasSubstr("expected `--p01`"));
  EXPECT_THAT(complaint("--p01 0", "--p01 0.5"),
              HasSubstr("`--p01` must be 0, an action that never reports success"));
  EXPECT_THAT(complaint("--a01 1", "--a01 99"), HasSubstr("has no module 99"));
  EXPECT_THAT(complaint("--p00 1", "--p00 7"), HasSubstr("`--p00`"));
  EXPECT_THAT(complaint("--p00 1", "--p00 1 --w00 3"), HasSubstr("does not belong to black_floor"));
  EXPECT_THAT(complaint("--n0 0", "--n0 0 --n02 5"), HasSubstr("children 0 to 1"));
  EXPECT_THAT(complaint("--p01 0", "--p01 0 --n1 0"), HasSubstr("expected the end"));
}

TEST(Controller, FirstSwitchSaysWhatItIs) {
  const auto architecture = [](std::string_view text) {
    const auto read = parse_controller(text, chocolate());
    return read ? name_of(architecture_of(*read)) : std::string_view("none");
  };
  EXPECT_EQ(architecture("--nstates 1 --s0 1"), "machine");
  EXPECT_EQ(architecture("--fsm-config --nstates 1 --s0 1"), "machine");
  EXPECT_EQ(architecture(kPublished), "tree");
  std::string network = "--network rvr-gray --weights 0";
  for (int i = 1; i < 22; ++i)
    network += ",0.5";
  EXPECT_EQ(architecture(network), "network");
  EXPECT_EQ(architecture("what"), "none");
  for (const std::string& text :
       {std::string("--nstates 1 --s0 1"), std::string(kPublished), network}) {
    const auto read = parse_controller(text, chocolate());
    EXPECT_EQ(print_controller(*read, chocolate()), text);
    EXPECT_FALSE(check(*read, chocolate()));
  }
}

}  // namespace
}  // namespace swarmsmith

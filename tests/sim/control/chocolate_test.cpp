#include <cmath>

#include "sim/control/behaviours.h"
#include "sim/control/flavour.h"
#include "sim/control/machine_text.h"
#include "sim/control/readings.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/checks.h"

// Flavour `chocolate`: thesis eq. 5.1 to 5.4, worked out by hand (thesis facts, sections 6.1, 7).

namespace swarmsmith {
namespace {

constexpr double kSpeed = 0.30;

Command steered(const Behaviour& behaviour, FakeSenses senses) {
  BehaviourMemory memory;
  Rng rng(7);
  const Command command = act(behaviour, senses, chocolate(), memory, rng);
  EXPECT_EQ(rng.drawn(), 0U) << "only Exploration draws";
  return command;
}

void expect_command(Command got, double left_mps, double right_mps) {
  EXPECT_NEAR(got.left_mps, left_mps, 1e-12);
  EXPECT_NEAR(got.right_mps, right_mps, 1e-12);
}

// --- w_l -----------------------------------------------------------------------------------------

TEST(LightVector, IsTheSumOfTheReadingsInThousandsOfLuxCutAtOne) {
  const LightModel& model = chocolate().light;
  const Vector2 half = light_vector(FakeSenses{}.light_from(90, 500).lux, model);
  EXPECT_NEAR(half.x, 0, 1e-15);
  EXPECT_NEAR(half.y, 0.5, 1e-15);
  // min(1, 3) ahead and 0.2 on the right.
  const Vector2 two =
      light_vector(FakeSenses{}.light_from(0, 3000).light_from(-90, 200).lux, model);
  EXPECT_NEAR(two.x, 1, 1e-15);
  EXPECT_NEAR(two.y, -0.2, 1e-15);
  // The same light from all around cancels.
  FakeSenses around;
  around.lux.fill(800);
  EXPECT_NEAR(light_vector(around.lux, model).x, 0, 1e-15);
  EXPECT_NEAR(light_vector(around.lux, model).y, 0, 1e-15);
}

// --- Phototaxis, eq. 5.1 -------------------------------------------------------------------------

TEST(Phototaxis, GoesTowardsTheLight) {
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(0, 500)), kSpeed, kSpeed);
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(90, 500)), 0, kSpeed);
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(-45, 500)), kSpeed,
                 kSpeed * std::sqrt(0.5));
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(180, 500)), kSpeed, -kSpeed);
}

TEST(Phototaxis, AvoidsObstaclesWithWeightFive) {
  // (0, 0.5) - 5 * 0.5 (1, 0): back to the left.
  const auto senses = FakeSenses{}.light_from(90, 500).obstacle(0, 0.225);
  expect_command(steered(Phototaxis{}, senses), kSpeed * -2.5 / std::hypot(2.5, 0.5), kSpeed);
}

TEST(Phototaxis, WithoutLightGoesStraightOnButForObstacles) {
  expect_command(steered(Phototaxis{}, {}), kSpeed, kSpeed);
  // (1, 0) - 5 * 0.5 (0, 1).
  expect_command(steered(Phototaxis{}, FakeSenses{}.obstacle(90, 0.225)), kSpeed,
                 kSpeed / std::hypot(1, 2.5));
}

TEST(Phototaxis, PerceivesLightFromAVectorOfOneTenthOn) {
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(90, 99.9)), kSpeed, kSpeed);
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(90, 100.1)), 0, kSpeed);
  // Strong readings that cancel are not light either.
  expect_command(steered(Phototaxis{}, FakeSenses{}.light_from(90, 900).light_from(-90, 950)),
                 kSpeed, kSpeed);
}

// --- Anti-phototaxis, eq. 5.2 --------------------------------------------------------------------

TEST(AntiPhototaxis, GoesAwayFromTheLight) {
  expect_command(steered(AntiPhototaxis{}, FakeSenses{}.light_from(180, 500)), kSpeed, kSpeed);
  expect_command(steered(AntiPhototaxis{}, FakeSenses{}.light_from(90, 500)), kSpeed, 0);
  expect_command(steered(AntiPhototaxis{}, FakeSenses{}.light_from(0, 500)), kSpeed, -kSpeed);
}

TEST(AntiPhototaxis, AvoidsObstaclesWithWeightFive) {
  // -(0, 0.5) - 5 * 0.5 (1, 0): back to the right.
  const auto senses = FakeSenses{}.light_from(90, 500).obstacle(0, 0.225);
  expect_command(steered(AntiPhototaxis{}, senses), kSpeed, kSpeed * -2.5 / std::hypot(2.5, 0.5));
}

TEST(AntiPhototaxis, WithoutLightGoesStraightOn) {
  expect_command(steered(AntiPhototaxis{}, {}), kSpeed, kSpeed);
  expect_command(steered(AntiPhototaxis{}, FakeSenses{}.light_from(0, 99.9)), kSpeed, kSpeed);
}

// --- Attraction and Repulsion, eq. 5.3 and 5.4 ---------------------------------------------------

TEST(AttractionOfChocolate, HasNoWeightOfItsOwn) {
  // 2 / 0.5 (1, 0) - 5 * 0.5 (0, 1); `watermelon` would have 1.2 * 4 and the neighbour in w_o.
  const auto senses = FakeSenses{}.neighbour(0.5, 0).obstacle(90, 0.225);
  expect_command(steered(Attraction{2}, senses), kSpeed, kSpeed * 4 / std::hypot(4, 2.5));
  // Alone: (1, 0).
  expect_command(steered(Attraction{2}, FakeSenses{}.obstacle(90, 0.225)), kSpeed,
                 kSpeed / std::hypot(1, 2.5));
  // A neighbour at arm's length is not an obstacle: 1 / 0.3 to the left, and nothing against it.
  expect_command(steered(Attraction{1}, FakeSenses{}.neighbour(0.3, 90)), 0, kSpeed);
}

TEST(RepulsionOfChocolate, IsTheOppositeVector) {
  // -2 / 0.5 (1, 0) - 5 * 0.5 (0, 1): back to the right.
  const auto senses = FakeSenses{}.neighbour(0.5, 0).obstacle(90, 0.225);
  expect_command(steered(Repulsion{2}, senses), kSpeed, kSpeed * -4 / std::hypot(4, 2.5));
  expect_command(steered(Repulsion{2}, FakeSenses{}.neighbour(0.6, 60)), kSpeed, -kSpeed / 2);
}

TEST(ExplorationOfChocolate, TurnsForFrontSensorsAndNotForNeighbours) {
  const auto turns = [](FakeSenses senses) {
    BehaviourMemory memory;
    Rng rng(7);
    act(Exploration{1'000'000}, senses, chocolate(), memory, rng);
    return memory.turn_cycles_left > 0;
  };
  EXPECT_TRUE(turns(FakeSenses{}.obstacle(-45, 0.2)));
  EXPECT_FALSE(turns(FakeSenses{}.obstacle(-90, 0.1)));
  EXPECT_FALSE(turns(FakeSenses{}.obstacle(0, 0.366)));  // prox 0.097
  EXPECT_TRUE(turns(FakeSenses{}.obstacle(0, 0.364)));   // prox 0.103
  EXPECT_FALSE(turns(FakeSenses{}.neighbour(0.3, 0)));
}

// --- Conditions ----------------------------------------------------------------------------------

TEST(FloorConditionsOfChocolate, HaveTheThresholdsOfTheEPuck) {
  const auto holds = [](const Condition& condition, int level) {
    FakeSenses senses;
    const auto channel = static_cast<std::uint8_t>(level);
    senses.floor = {channel, channel, channel};
    return enabling_probability(condition, senses, chocolate()) > 0;
  };
  EXPECT_TRUE(holds(BlackFloor{1}, 25));   // 0.098
  EXPECT_FALSE(holds(BlackFloor{1}, 26));  // 0.102
  EXPECT_FALSE(holds(GrayFloor{1}, 25));
  EXPECT_TRUE(holds(GrayFloor{1}, 26));
  EXPECT_TRUE(holds(GrayFloor{1}, 242));   // 0.949
  EXPECT_FALSE(holds(GrayFloor{1}, 243));  // 0.953
  EXPECT_FALSE(holds(WhiteFloor{1}, 242));
  EXPECT_TRUE(holds(WhiteFloor{1}, 243));
  // Exactly 0.1 is black, exactly 0.95 is white.
  EXPECT_TRUE(chocolate().floor.black.contains(25'500));
  EXPECT_TRUE(chocolate().floor.white.contains(242'250));
}

// --- Text ----------------------------------------------------------------------------------------

TEST(MachineTextOfChocolate, ReadsTheEPucksNumbers) {
  const char* const text =
      "--nstates 4 --s0 2 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.5 --s1 3 --s2 4 --att2 1.5 "
      "--s3 5 --rep3 4.25";
  const Machine machine = parse_machine(text, chocolate()).value();
  EXPECT_EQ(machine.states[0].behaviour, Behaviour(Phototaxis{}));
  EXPECT_EQ(machine.states[1].behaviour, Behaviour(AntiPhototaxis{}));
  EXPECT_EQ(machine.states[2].behaviour, Behaviour(Attraction{1.5}));
  EXPECT_EQ(machine.states[3].behaviour, Behaviour(Repulsion{4.25}));
  EXPECT_EQ(print_machine(machine, chocolate()), text);
}

TEST(MachineTextOfChocolate, HasNoColours) {
  EXPECT_THAT(
      why_not(parse_machine("--nstates 2 --s0 1 --n0 1 --n0x0 0 --c0x0 6 --p0x0 1 --l0x0 2 --s1 1",
                            chocolate()))
          .message,
      HasSubstr("the flavour chocolate has no module 6"));
  const Machine colours{{{Stop{}, {{ColorDetection{1, ColorLabel::Red}, 1}}}, {Stop{}, {}}}};
  EXPECT_TRUE(check(colours, chocolate()).has_value());
  EXPECT_TRUE(check(Machine{{{Phototaxis{}, {}}}}, watermelon()).has_value());
}

}  // namespace
}  // namespace swarmsmith

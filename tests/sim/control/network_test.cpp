#include "sim/control/network.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "tests/sim/control/fake_senses.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using ::testing::Each;

/// Inputs as a vector of their count.
std::vector<double> inputs_of(NetworkInputs set, FakeSenses& senses,
                              const Flavour& flavour = watermelon()) {
  const InputValues values = network_inputs(set, senses, flavour);
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(input_count(set))};
}

Network network_of(NetworkInputs set, double weight) {
  return {set, std::vector<double>(kWheels * input_count(set), weight)};
}

TEST(NetworkInputs, OfNothingAreTheFloorAndTheBias) {
  FakeSenses senses;
  senses.floor = {255, 51, 0};
  const std::vector<double> inputs = inputs_of(NetworkInputs::Rvr, senses);
  EXPECT_THAT(inputs, ElementsAre(0, 0, 0, 0, 1, 0.2, 0, 0, 0, 0, 0, 0, 1));
}

TEST(NetworkInputs, ObstaclesAreProjectedOnTheDiagonals) {
  FakeSenses senses;
  senses.obstacle(0, -kNothing);  // touching: strength 1 straight ahead
  const std::vector<double> inputs = inputs_of(NetworkInputs::RvrGray, senses);
  EXPECT_DOUBLE_EQ(inputs[0], kSqrtHalf);  // 45 degrees
  EXPECT_EQ(inputs[1], 0);
  EXPECT_EQ(inputs[2], 0);
  EXPECT_DOUBLE_EQ(inputs[3], kSqrtHalf);  // 315 degrees
}

TEST(NetworkInputs, NeighboursAreCountedAndPointTheWay) {
  FakeSenses senses;
  senses.neighbour(0.25, 45);
  std::vector<double> inputs = inputs_of(NetworkInputs::RvrGray, senses);
  EXPECT_NEAR(inputs[5], std::tanh(0.5), 1e-15);
  EXPECT_NEAR(inputs[6], std::tanh(0.8 / 2), 1e-15);  // 1 / (1 + 0.25 m), squashed
  EXPECT_NEAR(inputs[7], 0, 1e-16);
  EXPECT_EQ(inputs[8], 0);
  senses.neighbour(0.25, 225);  // on the other side: the sum is nothing, the count two
  inputs = inputs_of(NetworkInputs::RvrGray, senses);
  EXPECT_NEAR(inputs[5], std::tanh(1), 1e-15);
  for (std::size_t i = 6; i < 10; ++i)
    EXPECT_NEAR(inputs[i], 0, 1e-15);
}

TEST(NetworkInputs, ThreeLevelsOfTheFloorAreTheFlavours) {
  for (const auto& [gray, level] : {std::pair{0, 0.0}, std::pair{127, 0.5}, std::pair{255, 1.0}}) {
    FakeSenses senses;
    const auto channel = static_cast<std::uint8_t>(gray);
    senses.floor = {channel, channel, channel};
    EXPECT_EQ(inputs_of(NetworkInputs::Rm12, senses, chocolate())[8], level) << gray;
  }
}

TEST(NetworkInputs, OfRm11AreSingleSensorsAndTheFloorThreeTimes) {
  FakeSenses senses;
  senses.distances = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  senses.lux = {1, 0, 0, 0, 0, 0, 0, 0.5};
  senses.floor = {255, 255, 255};
  senses.neighbour(0.09, 45);
  const auto inputs = inputs_of(NetworkInputs::Rm11, senses, **find_flavour("chocolate-epuck"));
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(inputs[i], senses.distances[i]);
  EXPECT_EQ(inputs[8], 1);
  EXPECT_EQ(inputs[15], 0.5);
  for (const std::size_t i : {16U, 17U, 18U})
    EXPECT_EQ(inputs[i], 1);
  EXPECT_NEAR(inputs[19], std::tanh(0.5), 1e-12);
  EXPECT_NEAR(inputs[20], std::tanh(0.05), 1e-12);  // 1 / (1 + 9 cm), squashed
  EXPECT_EQ(inputs[24], 1);
}

TEST(NetworkInputs, AreAllBetweenZeroAndOne) {
  FakeSenses senses;
  for (const int direction : kProximityDirections_deg)
    senses.obstacle(direction, 0.06 + 0.001 * direction / 180).light_from(direction, 16'000);
  for (int i = 0; i < 12; ++i)
    senses.neighbour(0.1, 10 + i);
  senses.floor = {255, 255, 255};
  for (const NetworkInputs set :
       {NetworkInputs::Rvr, NetworkInputs::RvrGray, NetworkInputs::Rm12}) {
    const auto inputs = inputs_of(set, senses, chocolate());
    EXPECT_THAT(inputs, Each(AllOf(::testing::Ge(0), ::testing::Le(1))));
    EXPECT_EQ(inputs.size(), input_names(set).size());
  }
}

TEST(Network, OfZerosStandsStill) {
  FakeSenses senses;
  const Network network = network_of(NetworkInputs::Rvr, 0);
  EXPECT_EQ(NetworkControl(network, watermelon()).step(senses), Command{});
}

TEST(Network, BiasTurnsBothWheelsAtTheSigmoidsSpeed) {
  FakeSenses senses;
  senses.floor = {0, 0, 0};
  Network network = network_of(NetworkInputs::Rvr, 0);
  network.weights[12] = 0.5;  // bias of the left wheel
  network.weights[25] = -5;   // of the right one
  const Command command = NetworkControl(network, watermelon()).step(senses);
  EXPECT_NEAR(command.left_mps, 0.30 * std::tanh(2.4621365 * 0.5), 1e-12);
  EXPECT_NEAR(command.right_mps, -0.30, 1e-9);
}

/// Every supported compiler must give these bits.
TEST(Network, GivesTheSameBitsEverywhere) {
  FakeSenses senses;
  senses.obstacle(0, 0.2).obstacle(45, 0.31).neighbour(0.4, 30).neighbour(0.7, -100);
  senses.floor = {200, 30, 90};
  Network network;
  for (std::size_t i = 0; i < 26; ++i)
    network.weights.push_back(static_cast<double>((i * 37) % 101) / 20 - 2.5);
  const Command command = NetworkControl(network, watermelon()).step(senses);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(command.left_mps), 0xbfd333333263bb8bU)
      << std::hexfloat << command.left_mps;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(command.right_mps), 0xbf9b5a152f7c0e49U)
      << std::hexfloat << command.right_mps;
}

TEST(NetworkText, ReadsWhatItPrints) {
  Network network = network_of(NetworkInputs::RvrGray, 0.25);
  network.weights[3] = -1.2345;
  const std::string text = print_network(network, watermelon());
  EXPECT_THAT(text, HasSubstr("--network rvr-gray --weights 0.25,0.25,0.25,-1.2345,"));
  const auto read = value_of(parse_network(text, watermelon()));
  EXPECT_EQ(read, network);
}

TEST(NetworkText, SaysWhatIsWrongAndWhere) {
  const auto complaint = [](const std::string& text) {
    const auto read = parse_network(text, watermelon());
    return read ? "read" : read.error().where + ": " + read.error().message;
  };
  EXPECT_THAT(complaint("--network rvr"), HasSubstr("expected `--weights`"));
  EXPECT_THAT(
      complaint("--network rvr --weights 1, 2, 3"),
      HasSubstr(
          "token 5, column 28: write the weights as one list, with commas and without spaces"));
  EXPECT_THAT(complaint("--network e-puck --weights 1"),
              HasSubstr("token 2, column 11: unknown inputs `e-puck`"));
  EXPECT_THAT(complaint("--network rvr --weights 1,2"), HasSubstr("has 26 weights, not 2"));
  EXPECT_THAT(complaint("--network rvr --weights 1,x"), HasSubstr("weight 2 is not a number"));
  EXPECT_THAT(complaint("--network rvr --weights 1,"), HasSubstr("weight 2 is not a number"));
  EXPECT_THAT(complaint("--network rvr --weights 1 --weights 2"), HasSubstr("twice"));
  EXPECT_THAT(complaint("--network rvr --weights 1 --s0 2"),
              HasSubstr("does not belong to a network"));
  std::string nan = "--network rvr-gray --weights nan";
  for (int i = 1; i < 22; ++i)
    nan += ",0";
  EXPECT_THAT(complaint(nan), HasSubstr("finite"));
  std::string light = "--network rm1.2 --weights 0";
  for (int i = 1; i < 30; ++i)
    light += ",0";
  EXPECT_THAT(complaint(light), HasSubstr("the flavour watermelon does not have"));
  EXPECT_TRUE(parse_network(light, chocolate()));
}

/// A genome as NEAT 1.2.1 writes those of EvoStick: a node a line (number, trait, 1 for sensors,
/// then 1 input, 3 bias, 2 output, 0 hidden), then the genes (trait, from, to, weight, recurrent,
/// innovation, mutation, enabled). Results-Transferability has 300 of them; the weights are ours.
struct Genome {
  int sensors = 15;
  std::string hidden;      ///< lines of further nodes
  std::string genes;       ///< lines of further genes
  bool by_output = false;  ///< the order of CMA-ES and xNES; else that of EvoStick

  static std::string weight(int input, bool right) {
    return std::to_string(input) + (right ? ".5" : ".25");
  }
  std::string gene(int input, bool right) const {
    return "gene 1 " + std::to_string(input) + " " + std::to_string(sensors + (right ? 2 : 1)) +
           " " + weight(input, right) + " 0 1 0 1\n";
  }
  std::string text() const {
    std::string text = "genomestart 2\ntrait 1 0.1 0 0 0 0 0 0 0 \n";
    for (int i = 1; i <= sensors + 2; ++i) {
      const bool is_sensor = i <= sensors;
      text += "node " + std::to_string(i) + (is_sensor ? " 1 1 " : " 1 0 ") +
              (i < sensors    ? "1"
               : i == sensors ? "3"
                              : "2") +
              "\n";
    }
    text += hidden;
    for (int i = 0; i < 2 * sensors; ++i)
      text += by_output ? gene(i % sensors + 1, i >= sensors) : gene(i / 2 + 1, i % 2 == 1);
    return text + genes + "genomeend 2\n";
  }
};

TEST(GenomeText, OfAFlatNetworkIsReadInBothOrdersOfItsGenes) {
  Network wanted{.inputs = NetworkInputs::Rm12, .weights = {}};
  for (const double fraction : {0.25, 0.5})
    for (int i = 1; i <= 15; ++i)
      wanted.weights.push_back(i + fraction);
  for (const bool by_output : {false, true}) {
    Genome genome;
    genome.by_output = by_output;
    const auto read = value_of(parse_controller(genome.text(), chocolate()));
    EXPECT_EQ(std::get<Network>(read), wanted);
  }
}

TEST(GenomeText, ADisabledOrMissingGeneCountsNothing) {
  std::string text = Genome().text();
  text.replace(text.find("3.25 0 1 0 1"), 12, "3.25 0 1 0 0");
  text.erase(text.find(Genome().gene(4, false)), Genome().gene(4, false).size());
  const auto read = value_of(parse_controller(text, chocolate()));
  const auto& weights = std::get<Network>(read).weights;
  EXPECT_EQ(weights[1], 2.25);
  EXPECT_EQ(weights[2], 0);
  EXPECT_EQ(weights[3], 0);
  EXPECT_EQ(weights[4], 5.25);
}

TEST(GenomeText, SaysWhatCannotBeRead) {
  const auto complaint = [](const std::string& text) {
    const auto read = parse_controller(text, chocolate());
    return read ? "read" : read.error().message;
  };
  Genome evolved;
  evolved.hidden = "node 19 1 0 0\nnode 29 1 0 0\n";
  evolved.genes = "gene 1 1 19 0.5 0 40 0 1\n";
  EXPECT_THAT(complaint(evolved.text()),
              HasSubstr("a genome of NEAT with 2 hidden nodes; only networks without a hidden"));
  Genome raw;
  raw.sensors = 23;
  EXPECT_THAT(complaint(raw.text()), HasSubstr("a genome of 23 inputs"));
  raw.sensors = 25;
  EXPECT_THAT(complaint(raw.text()), HasSubstr("which the flavour chocolate does not have"));
  const std::string good = Genome().text();
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return complaint(text);
  };
  EXPECT_EQ(complaint(good), "read");
  EXPECT_THAT(changed("genomeend 2\n", ""), HasSubstr("`genomeend` is missing"));
  EXPECT_THAT(changed("genomeend 2\n", "genomeend 2 more\n"), HasSubstr("expected the end"));
  EXPECT_THAT(changed("trait 1", "trail 1"), HasSubstr("`trail`"));
  EXPECT_THAT(changed("2.25", "x"), HasSubstr("must be a number, not `x`"));
  EXPECT_THAT(changed("2.25", "nan"), HasSubstr("finite"));
  EXPECT_THAT(changed("2.25 0 1 0 1", "2.25 1 1 0 1"), HasSubstr("recurrent"));
  EXPECT_THAT(changed("gene 1 2 16", "gene 1 1 16"), HasSubstr("from node 1 to node 16 twice"));
  EXPECT_THAT(changed("gene 1 2 16", "gene 1 99 16"), HasSubstr("from node 99 to node 16"));
  EXPECT_THAT(changed("node 15 1 1 3", "node 15 1 1 1"), HasSubstr("bias"));
  EXPECT_THAT(changed("node 17 1 0 2\n", ""), HasSubstr("2 outputs"));
  EXPECT_THAT(changed("node 3 1", "node 2 1"), HasSubstr("node 2 twice"));
  EXPECT_THAT(parse_controller(good, watermelon()).error().message,
              HasSubstr("the flavour watermelon does not have"));
}

}  // namespace
}  // namespace swarmsmith

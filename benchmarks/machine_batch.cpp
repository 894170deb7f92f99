// Evaluates machines in one process, for benchmarks that would otherwise measure process starts.
//
//   machine_batch CAMPAIGN < LINES
//
// Each line has a seed and a machine's text; for each the program prints the cost, which is minus
// the score. Mission, flavour and profile are those of the campaign's first design.

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

#include "coordinator/campaign/campaign_file.h"
#include "programs/cost.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"

namespace swarmsmith {
namespace {

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "machine_batch: %s\n", why.c_str());
  std::exit(2);
}

double cost_of(const Campaign& campaign, const Flavour& flavour, std::int64_t seed,
               const std::string& text) {
  const Mission& mission = campaign.missions.front().mission;
  const auto machine = parse_machine(text, flavour);
  if (!machine) give_up(to_string(machine.error()) + " in: " + text);
  const auto instance = instance_of(mission, seed);
  if (!instance) give_up(to_string(instance.error()));
  return to_cost(simulate({.controller = *machine,
                           .flavour = flavour,
                           .profile = campaign.profile,
                           .mission = mission,
                           .instance = *instance,
                           .seed = seed})
                     .score);
}

}  // namespace
}  // namespace swarmsmith

int main(int count, char** words) {
  using namespace swarmsmith;
  if (count != 2) give_up("usage: machine_batch CAMPAIGN < LINES");
  const auto campaign = read_campaign(words[1]);
  if (!campaign) give_up(to_string(campaign.error().front()));
  const Method& method = campaign->methods.front();
  const auto flavour = find_flavour(method.flavour, method.turn_clock);
  if (!flavour) give_up(to_string(flavour.error()));
  std::int64_t seed = 0;
  std::string text;
  while (std::cin >> seed && std::getline(std::cin, text)) {
    std::printf("%.17g\n", cost_of(*campaign, *flavour, seed, text));
  }
  return 0;
}

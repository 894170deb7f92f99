// Repeats the evaluations of a finished campaign in a plain loop over threads: the cost of the same
// work without race, messages and store.
//
//   plain_loop STORE [THREADS]

#include <sys/resource.h>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "coordinator/campaign/campaign_file.h"
#include "sim/control/machine_text.h"
#include "sim/engine/simulate.h"
#include "storage/store.h"

namespace swarmsmith {
namespace {

struct Work {
  const std::string* machine = nullptr;
  std::int64_t seed = 0;
  double score = 0;
};

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "plain_loop: %s\n", why.c_str());
  std::exit(2);
}

std::vector<Work> work_of(StoreReader& store,
                          std::unordered_map<std::int64_t, std::string>& machines) {
  using PairKey = std::tuple<DesignId, Purpose, std::int64_t>;
  std::map<PairKey, std::int64_t> seeds;
  std::vector<EvaluationRow> evaluations;
  store.each_answer_row([&](const Row& row) {
    if (const auto* c = std::get_if<CandidateRow>(&row)) machines[c->id.value] = c->machine;
    if (const auto* p = std::get_if<PairRow>(&row)) {
      seeds[{p->design, p->purpose, p->number}] = p->seed;
    }
    if (const auto* e = std::get_if<EvaluationRow>(&row)) evaluations.push_back(*e);
  });
  std::vector<Work> work;
  for (const EvaluationRow& e : evaluations) {
    const DesignId design = design_of(e.key.candidate);
    work.push_back({.machine = &machines.at(e.key.candidate.value),
                    .seed = seeds.at({design, e.key.purpose, e.key.pair}),
                    .score = e.score});
  }
  return work;
}

/// Evaluates every item; returns how many scores differ from the stored ones.
std::size_t evaluate_all(const std::vector<Work>& work, const Campaign& campaign, int threads) {
  const Mission& mission = campaign.missions.front().mission;
  const Method& method = campaign.methods.front();
  const Flavour flavour = find_flavour(method.flavour, method.turn_clock).value();
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> different = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < work.size(); i = next++) {
      const auto machine = parse_machine(*work[i].machine, flavour);
      const auto instance = instance_of(mission, work[i].seed);
      const Measured result = simulate({.controller = *machine,
                                        .flavour = flavour,
                                        .profile = campaign.profile,
                                        .mission = mission,
                                        .instance = *instance,
                                        .seed = work[i].seed});
      if (result.score != work[i].score) ++different;
    }
  };
  std::vector<std::jthread> pool;
  for (int i = 0; i < threads; ++i)
    pool.emplace_back(run);
  pool.clear();
  return different;
}

int run(const std::string& path, int threads) {
  const auto store = StoreReader::open(path);
  if (!store) give_up(to_string(store.error()));
  const auto campaign = parse_campaign((*store)->campaign().file, "the store's campaign file");
  if (!campaign) give_up(to_string(campaign.error().front()));
  if (campaign->missions.size() * campaign->methods.size() != 1)
    give_up("takes a store with one mission and one method");
  std::unordered_map<std::int64_t, std::string> machines;
  const std::vector<Work> work = work_of(**store, machines);
  const double cpu = cpu_s();
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t different = evaluate_all(work, *campaign, threads);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  std::printf("{\"evaluations\":%zu,\"different\":%zu,\"wall_s\":%.3f,\"cpu_s\":%.3f}\n",
              work.size(), different, wall.count(), cpu_s() - cpu);
  return different == 0 ? 0 : 1;
}

}  // namespace
}  // namespace swarmsmith

int main(int argc, char** argv) {
  if (argc < 2) swarmsmith::give_up("usage: plain_loop STORE [THREADS]");
  const int threads =
      argc > 2 ? std::atoi(argv[2]) : static_cast<int>(std::thread::hardware_concurrency());
  return swarmsmith::run(argv[1], threads);
}

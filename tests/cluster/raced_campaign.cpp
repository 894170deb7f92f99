#include "tests/cluster/raced_campaign.h"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "base/rng.h"
#include "coordinator/campaign/campaign_file.h"
#include "storage/answer.h"

namespace swarmsmith::cluster {
namespace {

/// The mission of hopeless designs.
constexpr std::uint32_t kHopeless = 1;

ParameterSpace space() {
  auto made = ParameterSpace::make(
      {{.name = "kind",
        .switch_text = "--kind ",
        .domain = Categorical{{"a", "b", "c"}},
        .condition = {}},
       {.name = "count", .switch_text = "--count ", .domain = Integer{1.0, 8.0}, .condition = {}},
       {.name = "gain", .switch_text = "--gain ", .domain = Real{0.0, 1.0}, .condition = {}}});
  SWARMSMITH_ASSERT(made, "the tests' space is well-formed");
  return std::move(*made);
}

CandidateText text_of(const Configuration& configuration) {
  const std::string machine = fmt::format("--kind {} --count {} --gain {}", configuration[0],
                                          configuration[1], configuration[2]);
  return {.parameters = "{}", .machine = machine, .call = machine, .modules = "{}"};
}

/// What keeps a preset's search small; `[race]` has it for a race without a table.
std::string small_options(const std::string& preset) {
  if (preset == "random") return "[method.random]\nruns = 3\nfinalists = 3\nfinal_runs = 4\n";
  if (preset == "vanilla") return "[method.f-race]\nconfigurations = 8\n";
  if (preset == "evostick")
    return "[method.evolution]\npopulation = 5\nruns = 2\nelites = 0.4\nparents = 0.4\n"
           "final_runs = 3\n";
  if (preset == "cma-es") return "[method.cma-es]\npopulation = 5\nruns = 2\nfinal_runs = 3\n";
  if (preset == "icepop") return "[method.annealing]\nwindow = 2\nfinal_runs = 3\n";
  return "";
}

std::string race_options(const std::string& preset) {
  if (preset == "vanilla") return "first_test = 3\n";
  if (preset == "maple") return "first_test = 3\nmu = 3\nnb_iterations = 3\nmin_nb_survival = 2\n";
  return "";
}

/// The only design of a campaign file that names the preset.
DesignPlan plan_of_preset(const CampaignShape& shape) {
  const auto campaign =
      parse_campaign(fmt::format("format = 1\n[campaign]\n[[mission]]\nname = \"aggregation\"\n"
                                 "[[method]]\nname = \"test\"\nmethod = \"{}\"\n{}[race]\n"
                                 "max_experiments = {}\n{}",
                                 shape.preset, small_options(shape.preset), shape.budget,
                                 race_options(shape.preset)),
                     "preset.toml");
  SWARMSMITH_ASSERT(campaign, "the preset's file is well-formed, and its budget suffices");
  auto plans = swarmsmith::plans_of(*campaign);
  SWARMSMITH_ASSERT(plans && plans->size() == 1, "the file has one design");
  return std::move(plans->front());
}

DesignPlan plan_of_races(const CampaignShape& shape) {
  Scenario scenario;
  scenario.max_experiments = shape.budget;
  scenario.first_test = 3;
  scenario.mu = 3;
  scenario.nb_iterations = 3;
  scenario.min_nb_survival = 2;
  return {.row = {.budget = shape.budget},
          .space = space(),
          .scenario = scenario,
          .describe = text_of,
          .source = "test"};
}

Outcome outcome_of(const CampaignShape& shape, const Task& task) {
  const Truth truth = truth_of(shape, task);
  const bool ok = truth.kind == Truth::Kind::Score;
  return {.key = task.key,
          .status = ok ? EvaluationStatus::Ok : EvaluationStatus::Rejected,
          .measured = {.score = truth.score, .state_digest = truth.state_digest}};
}

std::vector<DesignId> finished_on(const SimulatedDisk& disk) {
  std::vector<DesignId> finished;
  for (const DesignStateRow& state : disk.design_states()) {
    if (state.state == DesignState::Finished) finished.push_back(state.design);
  }
  return finished;
}

}  // namespace

Truth truth_of(const CampaignShape& shape, const EvaluationInput& input) {
  Digest text;
  text.add(input.machine);
  const std::uint64_t machine = text.value64();
  const std::uint64_t bits =
      mix64(machine ^ mix64(static_cast<std::uint64_t>(input.seed) + mix64(shape.seed)));
  if (input.mission == kHopeless) return {.kind = Truth::Kind::Fails};
  if (shape.failing && bits % 24 == 0) return {.kind = Truth::Kind::Fails};
  if (shape.killing && bits % 80 == 1) return {.kind = Truth::Kind::Kills};
  const double quality = Rng(machine).uniform();
  return {.kind = Truth::Kind::Score,
          .score = 3 * quality + Rng(bits).normal(),
          .state_digest = mix64(bits)};
}

std::vector<DesignPlan> plans_of(const CampaignShape& shape) {
  const DesignPlan common = shape.preset.empty() ? plan_of_races(shape) : plan_of_preset(shape);
  std::vector<DesignPlan> plans;
  for (int number = 1; number <= shape.designs; ++number) {
    const bool hopeless = shape.hopeless && number == shape.designs;
    const auto seed = static_cast<std::int64_t>(
        mix64(shape.seed + static_cast<std::uint64_t>(number) * 1000) >> 1U);
    DesignPlan& plan = plans.emplace_back(common);
    plan.row = {.id = {number},
                .mission = "test",
                .method = "test",
                .repetition = number,
                .seed = seed,
                .budget = common.row.budget};
    plan.mission = hopeless ? kHopeless : 0;
    plan.scenario.seed = static_cast<std::uint64_t>(seed);
    plan.tests = {.count = shape.tests};
    plan.source = "test";
  }
  return plans;
}

RacedCampaign::RacedCampaign(const CampaignShape& shape, std::map<DesignId, StoredDesign> stored,
                             std::vector<DesignId> finished)
    // Some forget a design when it ends, some keep a few.
    : shape_(shape),
      runner_(plans_of(shape), std::move(stored), std::move(finished), {},
              {.finished = static_cast<std::size_t>(shape.seed % 3)}) {}

RacedCampaign::RacedCampaign(const CampaignShape& shape, const SimulatedDisk& disk)
    : RacedCampaign(shape, by_design(disk.scores(), disk.steps(), finished_on(disk)),
                    finished_on(disk)) {
  for (const StoredScore& score : disk.scores())
    asked_.emplace(pack(score.key), Asked{.told = true});
}

std::vector<Task> RacedCampaign::take_tasks() {
  std::vector<Task> tasks = runner_.take_tasks();
  for (const Task& task : tasks)
    note(task);
  return tasks;
}

std::vector<Task> RacedCampaign::take_more(std::size_t count, std::size_t slots) {
  std::vector<Task> tasks = runner_.take_more(count, slots);
  for (const Task& task : tasks)
    note(task);
  return tasks;
}

/// Once ahead and once wanted; it may have been told between the two.
void RacedCampaign::note(const Task& task) {
  if (truths_ != nullptr) {
    truths_->insert_or_assign(pack(task.key), truth_of(shape_, task));
  }
  const auto [at, is_new] = asked_.try_emplace(pack(task.key), Asked{.ahead = task.ahead});
  if (is_new) return;
  const bool is_wanted_now = at->second.ahead && !task.ahead;
  if (!is_wanted_now) {
    complaint_ = fmt::format("asked for {} again, {}, after it was {}", to_string(task.key),
                             task.ahead ? "ahead" : "wanted",
                             at->second.told    ? "told"
                             : at->second.ahead ? "given ahead"
                                                : "wanted");
  }
  at->second.ahead = false;
}

void RacedCampaign::tell(const Outcome& outcome) {
  const auto asked = asked_.find(pack(outcome.key));
  if (asked == asked_.end()) {
    complaint_ = "told what was never asked";
  } else if (std::exchange(asked->second.told, true)) {
    complaint_ = "told twice";
  } else {
    runner_.tell(outcome);
  }
}

std::vector<DesignId> RacedCampaign::take_ended() {
  std::vector<DesignId> ended = runner_.take_ended();
  ended_.insert(ended.begin(), ended.end());
  return ended;
}

std::vector<PassedCandidates> RacedCampaign::take_passed() {
  std::vector<PassedCandidates> passed = runner_.take_passed();
  for (const PassedCandidates& each : passed)
    passed_[each.design] = each;
  return passed;
}

bool RacedCampaign::is_void(PackedKey key) const {
  const EvaluationKey unpacked = unpack(key);
  const auto asked = asked_.find(pack(unpacked));
  const bool told = asked != asked_.end() && asked->second.told;
  const DesignId design = design_of(unpacked.candidate);
  const auto passed = passed_.find(design);
  const bool is_out = passed != passed_.end() && unpacked.candidate < passed->second.before &&
                      std::ranges::count(passed->second.kept, unpacked.candidate) == 0;
  return !told && (is_out || ended_.contains(design));
}

std::string RacedCampaign::complaint() const {
  return runner_.error() ? to_string(*runner_.error()) : complaint_;
}

SimulatedDisk undisturbed(const CampaignShape& shape) {
  SimulatedDisk disk;
  RacedCampaign campaign(shape, disk);
  for (auto tasks = campaign.take_tasks(); !tasks.empty(); tasks = campaign.take_tasks()) {
    for (const Task& task : tasks)
      campaign.tell(outcome_of(shape, task));
    if (!disk.commit(campaign.take_rows()).empty()) return {};
  }
  return campaign.finished() && campaign.complaint().empty() ? disk : SimulatedDisk{};
}

}  // namespace swarmsmith::cluster

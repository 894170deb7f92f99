#include <cmath>
#include <functional>
#include <span>

#include "base/rng.h"
#include "storage/answer.h"
#include "tests/storage/fixture.h"

namespace swarmsmith {
namespace {

using Batches = std::vector<std::vector<Row>>;

/// The same rows in the same order, cut into other batches.
Batches cut_anew(const Batches& batches, Rng rng) {
  Batches cut(1);
  for (const auto& batch : batches) {
    for (const Row& row : batch) {
      if (rng.bernoulli(0.1)) cut.emplace_back();
      cut.back().push_back(row);
    }
  }
  return cut;
}

/// Evaluations in another order within their step, by other workers.
Batches as_they_arrived_elsewhere(Batches batches, Rng rng) {
  for (auto& batch : batches) {
    std::vector<Row> evaluations, others;
    for (Row& row : batch) {
      auto* evaluation = std::get_if<EvaluationRow>(&row);
      if (evaluation != nullptr) {
        evaluation->worker = rng.uniform_int(1, 90);
        evaluation->attempt = rng.uniform_int(1, 3);
        evaluation->measured.wall_us = rng.uniform_int(1, 1000000);
      }
      (evaluation != nullptr ? evaluations : others).push_back(row);
    }
    rng.shuffle(std::span(evaluations));
    batch = std::move(evaluations);
    batch.insert(batch.end(), others.begin(), others.end());
  }
  return batches;
}

TEST(Digest, IsTheSameForEveryPartitionIntoBatches) {
  const SyntheticCampaign campaign = synthetic_campaign();
  const std::string wanted = digest_after(campaign, campaign.batches);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_EQ(digest_after(campaign, cut_anew(campaign.batches, Rng(seed))), wanted)
        << "seed " << seed;
  }
}

TEST(Digest, IsTheSameForEveryOrderOfArrivalAndAnyWorkers) {
  const SyntheticCampaign campaign = synthetic_campaign();
  const std::string wanted = digest_after(campaign, campaign.batches);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_EQ(digest_after(campaign, as_they_arrived_elsewhere(campaign.batches, Rng(seed))),
              wanted)
        << "seed " << seed;
  }
}

TEST(Digest, LeavesOutWhatIsNoPartOfTheAnswer) {
  const SyntheticCampaign campaign = synthetic_campaign();
  Batches more = campaign.batches;
  EvaluationRow row;
  row.source = "a source that is named first";
  std::vector<Row> extra;
  for (const Purpose purpose :
       {Purpose::Race, Purpose::LookAhead, Purpose::Audit, Purpose::Score}) {
    row.key = {.candidate = {1}, .purpose = purpose, .pair = 999};
    extra.emplace_back(row);
  }
  row.key = {.candidate = {2}, .purpose = Purpose::Race, .pair = 999};
  row.iteration = 1;
  extra.emplace_back(row);
  extra.emplace_back(UnusedRow{row.key});
  extra.emplace_back(PairRow{.design = {1}, .purpose = Purpose::Race, .number = 999});
  extra.emplace_back(ConflictRow{.key = row.key, .other_score = 3});
  extra.emplace_back(EventRow{.severity = "info", .kind = "look-ahead", .text = "{}"});
  WorkerRow worker;
  worker.id = 4;
  extra.emplace_back(worker);
  more.insert(more.begin() + 1, extra);
  more.pop_back();  // the campaign's state
  EXPECT_EQ(digest_after(campaign, more), digest_after(campaign, campaign.batches));
}

TEST(Digest, LeavesOutNameAndFileOfTheCampaign) {
  const SyntheticCampaign campaign = synthetic_campaign();
  SyntheticCampaign renamed = campaign;
  renamed.campaign.name = "other";
  renamed.campaign.file = "store = \"elsewhere\"\n";
  EXPECT_EQ(digest_after(renamed, campaign.batches), digest_after(campaign, campaign.batches));
}

/// Each change of one row of the answer.
struct Alteration {
  std::string what;
  std::function<bool(Row&)> alter;  ///< false when the row is not of its kind
};

template <class T>
Alteration alteration(const std::string& what, void (*change)(T&)) {
  return {what, [change](Row& row) {
            T* wanted = std::get_if<T>(&row);
            if (wanted == nullptr) return false;
            change(*wanted);
            return true;
          }};
}

TEST(Digest, ChangesWithEveryPartOfTheAnswer) {
  const std::vector<Alteration> alterations{
      alteration<CandidateRow>("parameters", [](CandidateRow& r) { r.parameters = "{\"a\":1}"; }),
      alteration<CandidateRow>("machine", [](CandidateRow& r) { r.machine += " "; }),
      alteration<CandidateRow>("modules", [](CandidateRow& r) { r.modules = "{}"; }),
      alteration<PairRow>("seed", [](PairRow& r) { ++r.seed; }),
      alteration<EvaluationRow>(
          "score",
          [](EvaluationRow& r) { r.measured.score = std::nextafter(r.measured.score, 1e9); }),
      alteration<EvaluationRow>("state digest",
                                [](EvaluationRow& r) { ++r.measured.state_digest; }),
      alteration<EvaluationRow>("source", [](EvaluationRow& r) { r.source = "argos3"; }),
      alteration<EvaluationRow>("use", [](EvaluationRow& r) { r.iteration = 0; }),
      alteration<IterationRow>("model", [](IterationRow& r) { ++r.model_digest; }),
      alteration<RaceStepRow>("step", [](RaceStepRow& r) { r.qvar = 0.5; }),
      alteration<EliminationRow>("elimination", [](EliminationRow& r) { ++r.step; }),
      alteration<EliteRow>("elite", [](EliteRow& r) { ++r.runs; }),
  };
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 2});
  const std::string wanted = digest_after(campaign, campaign.batches);
  for (const Alteration& each : alterations) {
    Batches batches = campaign.batches;
    bool done = false;
    for (auto& batch : batches) {
      for (Row& row : batch)
        done = done || each.alter(row);
    }
    ASSERT_TRUE(done) << each.what;
    EXPECT_NE(digest_after(campaign, batches), wanted) << each.what;
  }
}

TEST(Digest, ChangesWithTheLastTotalsAndStates) {
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 1});
  const std::string wanted = digest_after(campaign, campaign.batches);
  Batches batches = campaign.batches;
  batches.push_back({CandidateTotalsRow{.candidate = {1}, .runs = 500}});
  EXPECT_NE(digest_after(campaign, batches), wanted);
  batches = campaign.batches;
  batches.push_back(
      {DesignStateRow{.design = {1}, .state = DesignState::Stopped, .best = {}, .reason = {}}});
  EXPECT_NE(digest_after(campaign, batches), wanted);
}

}  // namespace
}  // namespace swarmsmith

#include "cli/output/progress.h"
#include "cli/output/number_text.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/output/progress_text.h"
#include "cli/run/campaign_plan.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;

const std::vector<DesignRow> kDesigns = {
    {.id = {1}, .mission = "aggregation", .method = "m", .repetition = 1, .budget = 50'000},
    {.id = {2}, .mission = "aggregation", .method = "m", .repetition = 2, .budget = 50'000}};

const IterationRow kIteration{
    .design = {1}, .number = 5, .of = 10, .budget = 9000, .configurations = 58, .elites = 4};
const RaceStepRow kStep{.design = {1},
                        .step = 31,
                        .iteration = 5,
                        .pair = 17,
                        .marker = '-',
                        .evaluated = 58,
                        .alive_before = 58,
                        .alive_after = 17,
                        .best = {812},
                        .mean_best = 2.7125,
                        .used = 26'209,
                        .statistic = {},
                        .p_value = {},
                        .kendall_w = 0.25,
                        .spearman_rho = 0.5,
                        .qvar = 0.0625};

LiveStatus fleet() {
  LiveStatus live;
  live.workers = 2;
  live.slots = 4;
  live.leased = 3;
  live.evaluations_per_s = 412;
  live.failed = 3;
  live.used_per_s = 412;
  live.campaigns = std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{
      {.designs = {{.id = {1}, .used = 26'209, .budget = 50'000}, {.id = {2}, .budget = 50'000}}}});
  return live;
}

ProgressModel model_after(const std::vector<Row>& rows) {
  ProgressModel model(kDesigns);
  for (const Row& row : rows)
    model.add(row);
  return model;
}

std::vector<ProgressModel> models_after(const std::vector<Row>& rows) {
  return {model_after(rows)};
}

TEST(StatusLine, TellsHowFarTheCampaignIs) {
  EXPECT_EQ(status_line(models_after({kIteration, kStep}), fleet(), 200),
            "designs 0/2  d1 iteration 5/~10  [#####---------------]  26 209/100 000  best 2.712  "
            "ETA 2m59s  412 sim/s  alive 17/58  failed 3");
}

TEST(StatusLine, LeavesOutWhatIsNeededLeast) {
  const auto models = models_after({kIteration, kStep});
  EXPECT_EQ(status_line(models, fleet(), 79),
            "designs 0/2  26 209/100 000  best 2.712  ETA 2m59s  412 sim/s  failed 3");
  EXPECT_EQ(status_line(models, fleet(), 40), "26 209/100 000  ETA 2m59s  failed 3");
  EXPECT_EQ(status_line(models, fleet(), 5), "faile");
  for (std::size_t width = 1; width < 150; ++width)
    EXPECT_LE(status_line(models, fleet(), width).size(), width);
}

TEST(StatusLine, CountsWithinAStep) {
  EvaluationRow evaluation{.key = {.candidate = candidate_id({1}, 7), .purpose = Purpose::Race}};
  evaluation.iteration = 5;
  EvaluationRow ahead = evaluation;
  ahead.iteration = 0;
  std::vector<ProgressModel> models =
      models_after({kIteration, kStep, evaluation, evaluation, ahead});
  EXPECT_EQ(models.front().totals().used, model_after({kIteration, kStep}).totals().used);
  EXPECT_EQ(models.front().totals().in_step, 2);
  EXPECT_THAT(plain_status(models, fleet()), HasSubstr("  26 211/100 000  "));
  models.front().drop_open_steps();
  EXPECT_THAT(plain_status(models, fleet()), HasSubstr("  26 209/100 000  "));
  EXPECT_EQ(model_after({kIteration, evaluation, kStep}).totals().in_step, 0);
}

TEST(StatusLine, NothingIsLeftOfAFinishedDesign) {
  const ProgressModel model = model_after({DesignStateRow{
      .design = {1}, .state = DesignState::Finished, .used = 49'990, .best = {}, .reason = {}}});
  EXPECT_EQ(model.totals().used, 49'990);
  EXPECT_EQ(model.totals().left, 50'000) << "of the other";
  EXPECT_EQ(model.totals().finished, 1);
  EXPECT_EQ(model.current()->id, DesignId{2});
}

TEST(StatusLine, SaysWhenThereAreNoWorkers) {
  EXPECT_THAT(plain_status(models_after({}), LiveStatus{}), HasSubstr("no workers"));
}

/// What programs print are costs, from the first line to the last.
TEST(StatusLine, ShowsTheCostsOfPrograms) {
  std::vector<ProgressModel> models;
  models.emplace_back(kDesigns, true);
  models.front().add(kIteration);
  models.front().add(kStep);
  EXPECT_THAT(status_line(models, fleet(), 200), HasSubstr("  best cost -2.712  "));
  EXPECT_EQ(mean_text(models.front(), -3.5), "3.5");
}

TEST(RaceLine, HasTheColumnsOfItsHeadline) {
  const std::string line = race_line(kStep, "2.712", 3725);
  EXPECT_EQ(line,
            "    d1|-|    17|   17|      c812|    2.712|   26209|01:02:05|+0.50|0.25|0.0625|");
  EXPECT_EQ(line.size(), race_headline().size());
  EXPECT_LT(line.size(), 80U);
  RaceStepRow untested = kStep;
  untested.spearman_rho.reset();
  EXPECT_THAT(race_line(untested, "2.712", 0), HasSubstr("|   NA|0.25|"));
}

TEST(Times, AreShort) {
  EXPECT_EQ(duration_text(12.4), "12s");
  EXPECT_EQ(duration_text(115), "1m55s");
  EXPECT_EQ(duration_text(3720), "1h02m");
  EXPECT_EQ(grouped(1234567), "1 234 567");
  EXPECT_EQ(grouped(999), "999");
}

/// A printer with streams of its own and a clock that the test moves.
class Printer {
 public:
  explicit Printer(Output flags) : output_{.out = out_, .err = err_} {
    output_.json = flags.json;
    output_.quiet = flags.quiet;
    output_.verbose = flags.verbose;
    output_.err_is_terminal = flags.err_is_terminal;
    progress_.emplace(output_, kDesigns, now_, [] { return std::size_t{200}; });
  }

  Progress& progress() { return *progress_; }
  void pass(Duration time) { now_ += time; }
  void add(const Row& row) { progress_->add(0, row, now_); }
  void update() { progress_->update(fleet(), now_); }
  std::string out() { return take(out_); }
  std::string err() { return take(err_); }

 private:
  static std::string take(std::ostringstream& stream) {
    std::string text = stream.str();
    stream.str("");
    return text;
  }

  std::ostringstream out_;
  std::ostringstream err_;
  Output output_;
  TimePoint now_{};
  std::optional<Progress> progress_;
};

Output flags() {
  static std::ostringstream nowhere;
  return {.out = nowhere, .err = nowhere};
}

const DesignStateRow kFinished{.design = {1},
                               .state = DesignState::Finished,
                               .used = 50'000,
                               .iteration = 9,
                               .best = {812},
                               .best_mean = 2.75,
                               .reason = "budget exhausted"};

TEST(ProgressOnATerminal, RedrawsOneLineBelowThoseOfTheRace) {
  Output output = flags();
  output.err_is_terminal = true;
  Printer printer(output);
  printer.update();
  const std::string status = printer.err();
  EXPECT_THAT(status, StartsWith("\r\x1b[2Kdesigns 0/2"));
  EXPECT_THAT(status, Not(HasSubstr("\n")));
  printer.add(kStep);
  const std::string step = printer.err();
  EXPECT_THAT(step, HasSubstr(race_headline() + "\n"));
  EXPECT_THAT(step, HasSubstr(race_line(kStep, "2.712", 0) + "\ndesigns 0/2"));
  EXPECT_EQ(printer.out(), "");
}

TEST(ProgressOnATerminal, RedrawsAtMostTenTimesASecond) {
  Output output = flags();
  output.err_is_terminal = true;
  Printer printer(output);
  printer.update();
  printer.err();
  printer.pass(milliseconds(50));
  printer.update();
  EXPECT_EQ(printer.err(), "");
  printer.pass(milliseconds(60));
  printer.update();
  EXPECT_NE(printer.err(), "");
}

TEST(ProgressInALog, TellsEveryHalfMinuteAndWhenADesignEnds) {
  Printer printer(flags());
  printer.update();
  printer.add(kStep);
  EXPECT_EQ(printer.err(), "");
  printer.add(kFinished);
  EXPECT_EQ(printer.err(),
            "d1 finished  aggregation m 1  50 000/50 000  best c812 2.75  (budget exhausted)\n");
  printer.pass(seconds(31));
  printer.update();
  EXPECT_THAT(printer.err(), HasSubstr("workers 2  slots 3/4\n"));
}

TEST(ProgressInALog, TellsAStateOnce) {
  Printer printer(flags());
  DesignStateRow racing = kFinished;
  racing.state = DesignState::Racing;
  printer.add(racing);
  EXPECT_THAT(printer.err(), HasSubstr("racing"));
  printer.add(racing);
  EXPECT_EQ(printer.err(), "");
}

TEST(ProgressInALog, TellsOfTheRaceWhenItShallSayMore) {
  Output output = flags();
  output.verbose = true;
  Printer printer(output);
  printer.add(kIteration);
  EXPECT_EQ(printer.err(), "d1 iteration 5/~10: 58 configurations (4 elites), budget 9 000\n");
  printer.add(EliteRow{
      .design = {1}, .iteration = 5, .rank = 1, .candidate = {812}, .mean = 2.5, .runs = 20});
  EXPECT_EQ(printer.err(), "d1 elite 1: c812  mean 2.5 over 20 runs\n");
}

TEST(ProgressInALog, WarnsWhenNothingCanBeStoredEvenWhenQuiet) {
  Output output = flags();
  output.quiet = true;
  Printer printer(output);
  LiveStatus live = fleet();
  live.trouble = "disk full";
  printer.progress().update(live, TimePoint{});
  printer.progress().update(live, TimePoint{});
  EXPECT_EQ(printer.err(), "warning: nothing can be stored: disk full\n");
  printer.add(kFinished);
  EXPECT_EQ(printer.err(), "");
}

TEST(ProgressAsJson, GivesOneEventALineOnStandardOutput) {
  Output output = flags();
  output.json = true;
  Printer printer(output);
  printer.add(kStep);
  const json step = json::parse(printer.out());
  EXPECT_EQ(step["v"], 1);
  EXPECT_EQ(step["event"], "race_step");
  EXPECT_EQ(step["best"], "c812");
  EXPECT_EQ(step["statistic"], nullptr);
  EXPECT_EQ(step["marker"], "-");
  printer.add(kFinished);
  EXPECT_EQ(json::parse(printer.out())["state"], "finished");
  printer.pass(seconds(2));
  printer.update();
  const json progress = json::parse(printer.out());
  EXPECT_EQ(progress["event"], "progress");
  EXPECT_EQ(progress["designs_finished"], 1);
  EXPECT_EQ(printer.err(), "");
}

TEST(ProgressAsJson, KnowsEveryKindOfRow) {
  EXPECT_EQ(event_json(CandidateRow{}), "");
  EXPECT_EQ(event_json(PairRow{}), "");
  EXPECT_EQ(event_json(EvaluationRow{}), "");
  EvaluationRow rejected;
  rejected.status = EvaluationStatus::Rejected;
  WorkerRow worker;
  worker.host = "h";
  EXPECT_EQ(json::parse(event_json(rejected))["event"], "failure");
  EXPECT_EQ(json::parse(event_json(kIteration))["configurations"], 58);
  EXPECT_EQ(json::parse(event_json(CampaignStateRow{"finished"}))["event"], "campaign");
  EXPECT_EQ(json::parse(event_json(worker))["host"], "h");
  EXPECT_EQ(json::parse(event_json(ConflictRow{}))["event"], "conflict");
  const EventRow event{"warning", "lease expired", R"({"worker":1})"};
  EXPECT_EQ(json::parse(event_json(event))["data"]["worker"], 1);
}

TEST(Progress, OfSeveralCampaignsNamesThemAndAddsThemUp) {
  std::ostringstream out;
  std::ostringstream err;
  Output output{.out = out, .err = err};
  Progress progress(output, {{"first", kDesigns}, {"second", kDesigns}}, TimePoint{});
  progress.add(1, kFinished, TimePoint{});
  EXPECT_EQ(
      err.str(),
      "second: d1 finished  aggregation m 1  50 000/50 000  best c812 2.75  (budget exhausted)\n");
  progress.restore(0, CommandRow{.number = 1, .kind = CommandKind::Pause, .design = {1}});
  err.str("");
  progress.finish(fleet());
  EXPECT_THAT(err.str(), StartsWith("campaigns 0/2  designs 1/4  50 000/200 000  "));
  EXPECT_THAT(err.str(), HasSubstr("  paused 1  "));
  output.json = true;
  Progress events(output, {{"first", kDesigns}, {"second", kDesigns}}, TimePoint{});
  events.add(1, kStep, TimePoint{});
  EXPECT_EQ(json::parse(out.str())["campaign"], "second");
  out.str("");
  events.add(std::nullopt, WorkerRow{}, TimePoint{});
  EXPECT_FALSE(json::parse(out.str()).contains("campaign"));
}

TEST(ProgressModel, CountsAnExtensionOnce) {
  CommandRow extension{
      .number = 3, .kind = CommandKind::Extend, .design = {1}, .step = {}, .budget = 500};
  ProgressModel model(kDesigns);
  model.add(extension);
  EXPECT_EQ(model.totals().budget, 100'000);
  extension.step = 12;
  model.add(extension);
  model.add(extension);
  EXPECT_EQ(model.totals().budget, 100'500);
}

TEST(Progress, OfACampaignThatGoesOnBeginsWhereItWas) {
  Printer printer(flags());
  printer.progress().restore(0, kFinished);
  EXPECT_EQ(printer.err(), "");
  EXPECT_EQ(printer.progress().model().totals().finished, 1);
  // Nine tests ran before, with a mean of 3; the tenth runs now.
  printer.progress().restore(0, TestedDesign{kFinished.best, 3, 9});
  EvaluationRow test;
  test.key = {.candidate = kFinished.best, .purpose = Purpose::Test, .pair = 10};
  test.measured.score = 2;
  printer.progress().add(0, test, TimePoint{});
  DesignStateRow again = kFinished;
  again.state = DesignState::Testing;
  printer.progress().add(0, again, TimePoint{});
  printer.progress().add(0, kFinished, TimePoint{});
  EXPECT_THAT(printer.err(), HasSubstr("finished  aggregation m 1  50 000/50 000  "
                                       "best c812 2.9 in 10 tests"));
}

}  // namespace
}  // namespace swarmsmith::cli

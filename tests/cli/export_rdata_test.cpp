#include <stdlib.h>

#include <filesystem>

#include "coordinator/results/irace_log.h"
#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrograms = R"(format = 1
[campaign]
name = "programs"
[[mission]]
name = "tuning"
instances.training = ["in/a b", "in/c"]
instances.test = ["t/1", "t/2"]
[[method]]
name = "irace"
parameters_text = '''
x "--x " r,log (0.5, 10)
kind "-" c (a, "b c")
n "--n " i (1, max(x, 2)) | kind == "a"
[forbidden]
x > 9 & kind == "a"
[global]
digits = 3
'''
[race]
max_experiments = 400
[simulator]
kind = "command"
command = ["/bin/true"]
evaluator = "/bin/true"
)";

/// A store of a race of programs with a targetEvaluator: its costs are the calls' last words.
void write_programs_store(const fs::path& file) {
  const auto campaign = value_of(parse_campaign(kPrograms, "programs.toml"));
  auto store = value_of(Store::open(file, campaign_row(campaign), design_rows(campaign)));
  const DesignId design{1};
  const CandidateId one = candidate_id(design, 1);
  const CandidateId two = candidate_id(design, 2);
  const auto pair = [&](Purpose purpose, std::int64_t number, std::int64_t instance,
                        std::int64_t seed) {
    return PairRow{
        .design = design, .purpose = purpose, .number = number, .instance = instance, .seed = seed};
  };
  const auto run = [&](CandidateId candidate, Purpose purpose, std::int64_t number, double score) {
    return EvaluationRow{.key = {candidate, purpose, number},
                         .iteration = purpose == Purpose::Test ? 0 : 1,
                         .measured = {.score = score},
                         .source = "command"};
  };
  EvaluationRow timed = run(one, Purpose::Race, 1, 0);
  timed.measured.time = 1.25;
  timed.bound = 5;
  EvaluationRow rejected = run(two, Purpose::Race, 2, 0);
  rejected.status = EvaluationStatus::Rejected;
  EvaluationRow unused = run(two, Purpose::Race, 3, -7);
  unused.iteration = 0;
  store->append({
      IterationRow{.design = design, .number = 1, .of = 3, .soft_restart = true},
      CandidateRow{.id = one,
                   .iteration = 1,
                   .parent = {},
                   .parameters = R"({"x":0.125,"kind":"a","n":2})",
                   .machine = "",
                   .modules = "{}"},
      CandidateRow{.id = two,
                   .iteration = 1,
                   .parent = one,
                   .parameters = R"({"x":3,"kind":"b c"})",
                   .machine = "",
                   .modules = "{}"},
      pair(Purpose::Race, 1, 2, 77),
      pair(Purpose::Race, 2, 1, 78),
      pair(Purpose::Race, 3, 1, 79),
      pair(Purpose::Test, 1, 1, 91),
      pair(Purpose::Test, 2, 2, 92),
      pair(Purpose::Evaluator, 1, 2, 77),
      pair(Purpose::Evaluator, 2, 2, 77),
      pair(Purpose::Evaluator, 3, -2, 92),
      timed,
      run(two, Purpose::Race, 1, 0),
      rejected,
      unused,
      run(one, Purpose::Test, 2, 0),
      run(one, Purpose::Evaluator, 1, -1.5),
      run(one, Purpose::Evaluator, 2, -2.5),
      run(two, Purpose::Evaluator, 2, -4),
      run(one, Purpose::Evaluator, 3, -8),
      RaceStepRow{.design = design, .step = 1, .iteration = 1, .pair = 2, .best = one},
      RaceStepRow{.design = design, .step = 2, .iteration = 1, .pair = 1, .best = one},
      EliteRow{.design = design, .iteration = 1, .rank = 1, .candidate = one, .mean = -2.5},
      DesignStateRow{.design = design,
                     .state = DesignState::Finished,
                     .used = 3,
                     .iteration = 1,
                     .best = one,
                     .best_mean = -2.5,
                     .reason = "budget exhausted"},
      CampaignStateRow{.state = "finished"},
  });
  ASSERT_TRUE(store->flush());
}

class ExportRdata : public WithStore {
 protected:
  std::string place(const char* name) const { return (folder_ / name).string(); }
  std::string table(const std::string& name) const { return whole_file(folder_ / ("log/" + name)); }
  Ran exported(const std::string& store) {
    return run({"export", store, "--format", "rdata", "-o", place("log/")});
  }
};

TEST_F(ExportRdata, WritesTheTablesOfAMachinesRace) {
  const Ran ran = exported(store_);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, place("log/") + "\n");
  for (const std::string& name : irace_log_files())
    EXPECT_TRUE(fs::exists(folder_ / ("log/" + name))) << name;
  EXPECT_THAT(table("runs.csv"), HasSubstr("\n1,1,1,-2.5,,\n1,1,2,-0.5,,\n"));
  EXPECT_THAT(table("tests.csv"), HasSubstr("\n1,1,-3\n"));
  EXPECT_THAT(table("log.csv"), HasSubstr("completed,budget exhausted\n"));
  EXPECT_THAT(table("instances.csv"), HasSubstr("race,1,aggregation\ntest,1,aggregation\n"));
  EXPECT_THAT(table("parameters.csv"), HasSubstr("S0,c,"));
  EXPECT_THAT(table("domains.csv"), HasSubstr("S0,exploration\nS0,stop\n"));
}

TEST_F(ExportRdata, OfProgramsHasConditionsCostsOfAnEvaluatorAndRejections) {
  const std::string store = place("programs.db");
  write_programs_store(store);
  const Ran ran = exported(store);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(table("parameters.csv"),
            "name,type,switch,log,condition\nx,r,--x ,1,\nkind,c,'-,0,\n"
            "n,i,--n ,0,\"kind == \"\"a\"\"\"\n");
  EXPECT_EQ(table("domains.csv"),
            "parameter,value\nx,0.5\nx,10\nkind,a\nkind,b c\nn,1\nn,\"max(x, 2)\"\n");
  EXPECT_EQ(table("configurations.csv"), "id,parent,x,kind,n\n1,,0.125,a,2\n2,1,3,b c,\n");
  EXPECT_EQ(table("pairs.csv"),
            "kind,pair,instance,seed\nrace,1,2,77\nrace,2,1,78\nrace,3,1,79\n"
            "test,1,1,91\ntest,2,2,92\n");
  EXPECT_EQ(table("runs.csv"),
            "iteration,pair,configuration,cost,time,bound\n"
            "1,2,2,Inf,,\n1,1,1,2.5,1.25,5\n1,1,2,4,,\n");
  EXPECT_EQ(table("tests.csv"), "pair,configuration,cost\n2,1,8\n");
  EXPECT_EQ(table("elites.csv"), "iteration,rank,configuration\n1,1,1\n");
  EXPECT_EQ(table("instances.csv"),
            "kind,instance,name\nrace,1,in/a b\nrace,2,in/c\ntest,1,t/1\ntest,2,t/2\n");
  EXPECT_THAT(table("log.csv"), HasSubstr("iterations,3\nsoft_restart,1\n"));
  EXPECT_THAT(table("scenario.csv"), HasSubstr("digits,3\n"));
  EXPECT_THAT(table("scenario.csv"), HasSubstr("elitist,TRUE\n"));
  EXPECT_THAT(table("scenario.csv"), HasSubstr("forbidden,"));
}

TEST_F(ExportRdata, OfARaceThatCapsHasTheCostsThatTheRaceCounted) {
  std::string text = kPrograms;
  text.replace(text.find("max_experiments = 400"), 21,
               "max_experiments = 400\ncapping = true\nbound_max = 20\nbound_par = 2");
  text.erase(text.find("evaluator = \"/bin/true\"\n"), 24);
  const auto campaign = value_of(parse_campaign(text, "capping.toml"));
  const CandidateId one = candidate_id({1}, 1);
  std::vector<Row> rows{IterationRow{.design = {1}, .number = 1, .of = 3},
                        CandidateRow{.id = one,
                                     .iteration = 1,
                                     .parent = {},
                                     .parameters = R"({"x":1,"kind":"b c"})",
                                     .machine = "",
                                     .modules = "{}"}};
  // Score, time, bound: it ends in time, costs too much, and reaches a smaller bound.
  const double runs[3][3] = {{-3, 4, 20}, {-25, 6, 20}, {-7, 5, 5}};
  for (std::int64_t pair = 1; pair <= 3; ++pair) {
    const auto& [score, time, bound] = runs[pair - 1];
    rows.push_back(PairRow{.design = {1}, .number = pair, .instance = 1, .seed = pair});
    rows.push_back(EvaluationRow{.key = {one, Purpose::Race, pair},
                                 .iteration = 1,
                                 .measured = {.score = score, .time = time},
                                 .bound = bound,
                                 .source = "command"});
    rows.push_back(RaceStepRow{.design = {1}, .step = pair, .iteration = 1, .pair = pair});
  }
  {
    const auto store =
        value_of(Store::open(place("cap.db"), campaign_row(campaign), design_rows(campaign)));
    store->append(std::move(rows));
    ASSERT_TRUE(store->flush());
  }
  const Ran ran = exported(place("cap.db"));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(table("runs.csv"),
            "iteration,pair,configuration,cost,time,bound\n"
            "1,1,1,3,4,20\n1,2,1,40,6,20\n1,3,1,20,5,5\n");
}

TEST_F(ExportRdata, IsReadBackByImport) {
  ASSERT_EQ(exported(store_).code, 0);
  // Here a parent comes before its child.
  write_file(folder_ / "log/configurations.csv", [&] {
    std::string text = table("configurations.csv");
    const std::size_t at = text.find("\n1,2,");
    return text.replace(at, 5, "\n1,,");
  }());
  const Ran ran = run_well({"import", place("log"), "--into", place("again.db")});
  fs::rename(place("log"), place("first"));
  ASSERT_EQ(exported(place("again.db")).code, 0);
  for (const std::string& name : irace_log_files())
    EXPECT_EQ(table(name), whole_file(folder_ / ("first/" + name))) << name;
}

TEST_F(ExportRdata, SaysWhatIsWrong) {
  const auto refused = [&](int code, const std::vector<std::string>& more) {
    std::vector<std::string> words{"export", store_, "--format", "rdata"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, code) << ran.err;
    return ran.err;
  };
  EXPECT_THAT(refused(2, {}), HasSubstr("-o irace.Rdata"));
  EXPECT_THAT(refused(4, {"-o", place("log/"), "--design", "d3"}), HasSubstr("it has: d1 aggreg"));
  EXPECT_THAT(refused(2, {"-o", place("log/"), "--design", "c3"}), HasSubstr("such as d3"));
  EXPECT_THAT(refused(2, {"-o", place("log/"), "--candidate", "c1"}), HasSubstr("--candidate"));
  EXPECT_THAT(refused(2, {"-o", place("log/"), "--what", "all"}), HasSubstr("--what"));
  EXPECT_FALSE(fs::exists(place("log")));
  // Never over a file of another kind, the store among them, nor over tables.
  write_file(place("notes.txt"), "notes of a person\n");
  EXPECT_THAT(refused(2, {"-o", place("notes.txt")}), HasSubstr("is a text"));
  EXPECT_THAT(refused(2, {"-o", store_}), HasSubstr("a store"));
  ASSERT_EQ(exported(store_).code, 0);
  EXPECT_THAT(exported(store_).err, HasSubstr("already exists; name another folder"));
}

TEST_F(ExportRdata, WantsToKnowWhichOfSeveralDesigns) {
  const std::string file = place("two.toml");
  write_file(file,
             "format = 1\n[campaign]\nrepetitions = 2\n[[mission]]\nname = \"aggregation\"\n"
             "[[method]]\nname = \"w\"\n[race]\nmax_experiments = 2000\n");
  const auto campaign = value_of(read_campaign(file));
  ASSERT_TRUE(
      (*Store::open(place("two.db"), campaign_row(campaign), design_rows(campaign)))->flush());
  const Ran ran = exported(place("two.db"));
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("d1 aggregation w repetition 1, d2 aggregation w repetition 2"));
  const Ran none =
      run({"export", place("two.db"), "--format", "rdata", "--design", "d2", "-o", place("log/")});
  EXPECT_EQ(none.code, 4);
  EXPECT_THAT(none.err, HasSubstr("nothing has raced for d2 yet"));
}

TEST_F(ExportRdata, OfMachinesThatNoRaceMadeIsRefused) {
  const std::string machines = place("machines.txt");
  write_file(machines, kExploreText + "\n");
  ASSERT_EQ(run({"import", machines, "--flavour", "watermelon", "--mission", "aggregation",
                 "--into", place("machines.db")})
                .code,
            0);
  const Ran ran = exported(place("machines.db"));
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("no race made it"));
}

TEST_F(ExportRdata, WithoutRSaysWhatToInstallAndWhatToDo) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const Ran ran = run({"export", store_, "--format", "rdata", "-o", place("irace.Rdata")});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("install r-base-core"));
  EXPECT_THAT(ran.err, HasSubstr("-o FOLDER/"));
  EXPECT_FALSE(fs::exists(place("irace.Rdata")));
}

}  // namespace
}  // namespace swarmsmith::cli

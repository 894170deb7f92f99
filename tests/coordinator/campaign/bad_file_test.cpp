#include <fstream>

#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// A text with one mistake, and the sentence for it with its place.
struct Mistake {
  const char* name;
  FileText file;
  const char* complaint;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class BadFile : public testing::TestWithParam<Mistake> {};

TEST_P(BadFile, GetsItsSentenceWithLineAndColumn) {
  EXPECT_THAT(complaints(GetParam().file.text()), ElementsAre(HasSubstr(GetParam().complaint)));
}

const Mistake kMistakes[] = {
    {"Typo",
     {.campaign = "sead = 3\n"},
     "in/x.toml:3:1: [campaign] has no key `sead` (did you mean \"seed\"?)"},
    {"TypeOfSeed",
     {.campaign = "seed = \"3\"\n"},
     "in/x.toml:3:8: `seed` must be an integer, not a text"},
    {"NegativeSeed", {.campaign = "seed = -1\n"}, "in/x.toml:3:8: `seed` must be at least 0"},
    {"NoRepetitions",
     {.campaign = "repetitions = 0\n"},
     "in/x.toml:3:15: `repetitions` must be from 1 to 100000, not 0"},
    {"NameWithBlanks", {.campaign = "name = \"a b\"\n"}, "in/x.toml:3:8: a name consists of"},
    {"UnknownMission",
     {.mission = "name = \"agregation\"\n"},
     "in/x.toml:4:8: mission \"agregation\" is not built in (did you mean \"aggregation\"?)"},
    {"UnknownPreset",
     {.mission = "name = \"x\"\npreset = \"grid\"\n"},
     "in/x.toml:5:10: there is no preset \"grid\""},
    {"PresetInAFile",
     {.mission = "name = \"x\"\npreset = \"mine.toml\"\n"},
     "in/x.toml:5:10: in/mine.toml: there is no such mission file"},
    {"DurationWithoutUnit",
     {.mission = "name = \"aggregation\"\nduration = \"120\"\n"},
     "in/x.toml:5:12: `duration` must be a time with its unit"},
    {"DurationAsNumber",
     {.mission = "name = \"aggregation\"\nduration = 120\n"},
     "in/x.toml:5:12: `duration` must be a text in quotes, not an integer"},
    {"DurationBetweenCycles",
     {.mission = "name = \"aggregation\"\nduration = \"0.25 s\"\n"},
     "in/x.toml:5:12: `duration` must be a multiple of the control period"},
    {"NoRobots",
     {.mission = "name = \"aggregation\"\nrobots = 0\n"},
     "in/x.toml:5:10: `robots` must be from 1 to 100"},
    {"RobotsWithoutRoom",
     {.mission = "name = \"aggregation\"\nrobots = 90\n"},
     "in/x.toml:5:10: mission \"aggregation\": "},
    {"ArenaTooSmall",
     {.mission = "name = \"aggregation\"\narena = { area = 0.25 }\n"},
     "in/x.toml:3:1: mission \"aggregation\": "},
    {"UnknownShape",
     {.mission = "name = \"aggregation\"\narena = { shape = \"squar\" }\n"},
     "in/x.toml:5:19: `shape` cannot be \"squar\" (did you mean \"square\"?)"},
    {"KeyOfAnotherShape",
     {.mission = "name = \"aggregation\"\narena = { shape = \"square\", side = 3, area = 9 }\n"},
     "in/x.toml:5:46: `area` belongs to shape = \"dodecagon\"; this arena's shape is \"square\""},
    {"UnknownColour",
     {.mission = "name = \"aggregation\"\narena = { floor = \"pink\" }\n"},
     "in/x.toml:5:19: there is no colour \"pink\"; known are: black, gray"},
    {"SpotWithoutSize",
     {.mission = "name = \"aggregation\"\narena = { spots = [ { shape = \"circle\", x = 0, y = 0, "
                 "color = \"red\" } ] }\n"},
     "in/x.toml:5:21: [[mission.arena.spots]] needs `diameter`"},
    {"OtherScore",
     {.mission = "name = \"x\"\nscore = { kind = \"external\" }\n"},
     "in/x.toml:5:18: kind = \"external\" is not supported yet"},
    {"UnknownScore",
     {.mission = "name = \"x\"\nscore = { kind = \"robot_on\" }\n"},
     "in/x.toml:5:18: `kind` cannot be \"robot_on\" (did you mean \"robots_on\"?)"},
    {"RewardsMissing",
     {.mission = "name = \"x\"\nscore = { kind = \"color_reward\" }\n"},
     "in/x.toml:5:9: the score color_reward needs `rewards`"},
    {"Minimise",
     {.mission =
          "name = \"x\"\nscore = { kind = \"robots_on\", color = \"black\", maximize = false "
          "}\n"},
     "scores are always maximised"},
    {"ScoreWithoutColor",
     {.mission = "name = \"x\"\nscore = { kind = \"objects_on\" }\n"},
     "in/x.toml:5:9: the score objects_on needs `color`, such as color = \"black\""},
    {"ScoreWithoutKind",
     {.mission = "name = \"x\"\nscore = { color = \"black\" }\n"},
     "in/x.toml:5:9: [mission.score] needs a `kind`: robots_on, coverage"},
    {"ScoreOfNoColor",
     {.mission = "name = \"x\"\nscore = { kind = \"robots_on\", color = \"pink\" }\n"},
     "in/x.toml:5:39: there is no colour \"pink\"; known are: black, gray"},
    {"ScoreTypo",
     {.mission = "name = \"x\"\nscore = { kind = \"coverage\", tile = 5 }\n"},
     "in/x.toml:5:30: [mission.score] has no key `tile` (did you mean \"tiles\"?)"},
    {"ScoreKeyOfAnotherKind",
     {.mission = "name = \"x\"\nscore = { kind = \"coverage\", at = \"sum\" }\n"},
     "in/x.toml:5:30: [mission.score] has no key `at`"},
    {"ScoreAtNoTime",
     {.mission = "name = \"x\"\nscore = { kind = \"robots_on\", color = \"red\", "
                 "at = \"summ\" }\n"},
     "in/x.toml:5:51: `at` cannot be \"summ\" (did you mean \"sum\"?)"},
    {"NegativeSide",
     {.mission = "name = \"x\"\nscore = { kind = \"coverage\", side = -1 }\n"},
     "in/x.toml:5:37: `side` must be from 0.01 to 1000, not -1"},
    {"SideOfNaN",
     {.mission = "name = \"x\"\nscore = { kind = \"coverage\", side = nan }\n"},
     "in/x.toml:5:37: `side` must be from 0.01 to 1000, not nan"},
    {"RewardOfNaN",
     {.mission = "name = \"x\"\nscore = { kind = \"color_reward\", rewards = { red = nan } }\n"},
     "in/x.toml:5:52: `red` must be from -1000000000 to 1000000000, not nan"},
    {"RewardOfInfinity",
     {.mission = "name = \"x\"\nscore = { kind = \"color_reward\", rewards = { red = -inf } }\n"},
     "in/x.toml:5:52: `red` must be from -1000000000 to 1000000000, not -inf"},
    {"RewardTwice",
     {.mission = "name = \"x\"\nscore = { kind = \"color_reward\", "
                 "rewards = { red = 1, \"#ff0000\" = 2 } }\n"},
     "is given twice"},
    {"RewardOfNoColor",
     {.mission =
          "name = \"x\"\nscore = { kind = \"color_reward\", rewards = { pink = 1 , red = 1} }\n"},
     "in/x.toml:5:53: there is no colour \"pink\""},
    {"NoRewards",
     {.mission = "name = \"x\"\nscore = { kind = \"color_reward\", rewards = {} }\n"},
     "in/x.toml:5:44: `rewards` must name a colour"},
    {"TestCount",
     {.mission = "name = \"aggregation\"\ninstances = { test = { count = -1 } }\n"},
     "in/x.toml:5:32: `count` must be from 0 to 99999"},
    {"UnknownFlavour",
     {.method = "name = \"m\"\nflavour = \"watermellon\"\n"},
     "in/x.toml:7:11: `flavour` cannot be \"watermellon\" (did you mean \"watermelon\"?)"},
    {"FlavourNotYet",
     {.method = "name = \"m\"\nflavour = \"vanilla\"\n"},
     "in/x.toml:7:11: vanilla is a search, not a flavour"},
    {"UnknownTurnClock",
     {.method = "name = \"m\"\nturn_clock = \"second\"\n"},
     "in/x.toml:7:14: `turn_clock` cannot be \"second\" (did you mean \"seconds\"?)"},
    {"ModuleOfAnotherFlavour",
     {.method = "name = \"m\"\nbehaviours = [\"phototaxis\"]\n"},
     "in/x.toml:7:14: flavour watermelon has no behaviour `phototaxis`"},
    {"UnknownModule",
     {.method = "name = \"m\"\nbehaviours = [\"explore\", \"stop\"]\n"},
     "in/x.toml:7:14: flavour watermelon has no behaviour `explore`"},
    {"ModuleTwice",
     {.method = "name = \"m\"\nbehaviours = [\"stop\", \"stop\"]\n"},
     "in/x.toml:7:14: `behaviours` names `stop` twice"},
    {"NoModules",
     {.method = "name = \"m\"\nconditions = []\n"},
     "in/x.toml:7:14: `conditions` is empty"},
    {"TooManyStates",
     {.method = "name = \"m\"\nmax_states = 5\n"},
     "in/x.toml:7:14: `max_states` must be from 1 to 4, not 5"},
    {"RangeOfUnknownModule",
     {.method = "name = \"m\"\nparameters.explration.tau.int = [1, 2]\n"},
     "the method has no module `explration` (did you mean \"exploration\"?)"},
    {"RangeOfUnknownParameter",
     {.method = "name = \"m\"\nparameters.exploration.tua.int = [1, 2]\n"},
     "exploration has no parameter `tua` (did you mean \"tau\"?)"},
    {"RangeOfOtherType",
     {.method = "name = \"m\"\nparameters.exploration.tau = { real = [1, 2] }\n"},
     "in/x.toml:7:39: exploration.tau is not of type real; write { int = [...] }"},
    {"RangeUpsideDown",
     {.method = "name = \"m\"\nparameters.exploration.tau = { int = [9, 2] }\n"},
     "in/x.toml:7:38: exploration.tau: the range's lower end must be below its upper end"},
    {"RangeTooWide",
     {.method = "name = \"m\"\nparameters.exploration.tau = { int = [0, 2] }\n"},
     "in/x.toml:7:38: exploration.tau: tau must be at least 1"},
    {"RangeOfALabel",
     {.method = "name = \"m\"\nparameters.color_detection.label.int = [0, 2]\n"},
     "a label is one of the flavour's colours"},
    {"NoBudget", {.race = ""}, "[race] needs `max_experiments`"},
    {"BudgetTooSmall", {.race = "max_experiments = 200\n"}, "1350"},
    {"UnknownTest",
     {.race = "max_experiments = 2000\ntest_type = \"u-test\"\n"},
     "in/x.toml:9:13: `test_type` cannot be \"u-test\""},
    {"CappingWithoutABound",
     {.race = "max_experiments = 2000\ncapping = true\n"},
     "in/x.toml:9:11: `capping` needs a bound_max above 0"},
    {"TimeOfTheSimulator",
     {.race = "max_time = 2000\n"},
     "in/x.toml:8:12: `max_time` needs a target that reports how long its runs took"},
    {"TwoBudgets",
     {.race = "max_experiments = 2000\nmax_time = 10\n",
      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\n"},
     "in/x.toml:9:12: give `max_experiments` or `max_time`, not both"},
    {"Confidence",
     {.race = "max_experiments = 2000\nconfidence = 1.5\n"},
     "in/x.toml:9:14: `confidence` must be from 0 to 1, not 1.5"},
    {"FirstTest",
     {.race = "max_experiments = 2000\neach_test = 2\nfirst_test = 5\n"},
     "in/x.toml:10:14: `first_test` must be a multiple of each_test, which is 2, and is 5"},
    {"OtherSimulator",
     {.rest = "[simulator]\nkind = \"argos\"\n"},
     "in/x.toml:10:8: kind = \"argos\" is not supported yet"},
    {"NoCommand",
     {.rest = "[simulator]\nkind = \"command\"\n"},
     "in/x.toml:9:1: kind = \"command\" needs `command`"},
    {"TwoCommands",
     {.rest = "[simulator]\nkind = \"command\"\ncommand = [\"python3\", \"r.py\"]\n"},
     "in/x.toml:11:11: `command` must name one program; an interpreter before it goes into "
     "`launcher`"},
    {"BatchWithoutEvaluator",
     {.rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\nbatch_mode = \"slurm\"\n"},
     "in/x.toml:12:14: `batch_mode` needs an `evaluator`"},
    {"ParameterFileOfTheSimulator",
     {.method = "name = \"m\"\nparameters = \"p.txt\"\n"},
     "a parameter file needs programs that evaluate"},
    {"NoParameterFile",
     {.method = "name = \"m\"\nparameters = \"p.txt\"\n",
      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\n"},
     "in/x.toml:7:14: in/p.txt: there is no such parameters file"},
    {"FaultInAParameterText",
     {.method = "name = \"m\"\nparameters_text = \"a '' q (1, 2)\"\n",
      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\n"},
     "parameters_text:1:"},
    {"WorldOfPrograms",
     {.mission = "name = \"x\"\nrobots = 5\n",
      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\n"},
     "in/x.toml:5:1: [[mission]] has no key `robots`"},
    {"NoTrainingInstances",
     {.mission = "name = \"x\"\ninstances.training = []\n",
      .rest = "[simulator]\nkind = \"command\"\ncommand = [\"./r\"]\n"},
     "`training` has no instance"},
    {"UnknownProfile",
     {.rest = "[simulator]\nprofile = \"rvx\"\n"},
     "in/x.toml:10:11: there is no simulator profile `rvx` (did you mean \"rvr\"?)"},
    {"ProfileInAFile",
     {.rest = "[simulator]\nprofile = \"mine.toml\"\n"},
     "in/x.toml:10:11: in/mine.toml: there is no such profile file"},
    {"LocalWorkers",
     {.rest = "[workers]\nlocal = \"all\"\n"},
     "in/x.toml:10:9: `local` must be \"auto\""},
    {"Address",
     {.rest = "[workers]\nbind = \"127.0.0.1\"\n"},
     "in/x.toml:10:8: `bind` must be an address with a port"},
    {"WorstRank",
     {.rest = "[workers]\non_failure = \"worst_rank\"\n"},
     "in/x.toml:10:14: `on_failure` cannot be \"worst_rank\"; it is one of: reject, stop"},
    {"Launcher",
     {.rest = "[workers]\nlauncher = \"slrum\"\n"},
     "in/x.toml:10:12: `launcher` cannot be \"slrum\" (did you mean \"slurm\"?); it is one of: "
     "local, ssh, slurm"},
    {"SshWithoutHosts",
     {.rest = "[workers]\nlauncher = \"ssh\"\n"},
     "in/x.toml:10:12: `launcher` is \"ssh\", but the table [workers.ssh]"},
    {"SshTableWithoutHosts",
     {.rest = "[workers.ssh]\noptions = [\"-4\"]\n"},
     "[workers.ssh] needs `hosts`"},
    {"SlurmJobs", {.rest = "[workers.slurm]\njobs = 0\n"}, "in/x.toml:10:8: `jobs` must be"},
    {"SlurmKey",
     {.rest = "[workers.slurm]\ncpus = 4\n"},
     "in/x.toml:10:1: [workers.slurm] has no key `cpus`; known are: cpus_per_task, jobs, options, "
     "partition, time"},
    {"SlurmOptionOfTwoLines",
     {.rest = "[workers.slurm]\noptions = [\"--a\\nrm\"]\n"},
     "in/x.toml:10:11: `options` must be words without line breaks"},
    {"SlurmTimeOfTwoLines",
     {.rest = "[workers.slurm]\ntime = \"1\\n2\"\n"},
     "in/x.toml:10:8: `time` must be one line"},
    {"DashboardAddress",
     {.rest = "[dashboard]\nbind = \"localhost:99999\"\n"},
     "in/x.toml:10:8: `bind` must be an address with a port"},
    {"UnknownTable",
     {.rest = "[worker]\nlocal = 1\n"},
     "in/x.toml:9:2: the file has no key `worker` (did you mean \"workers\"?)"},
};

INSTANTIATE_TEST_SUITE_P(Mistakes, BadFile, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return mistake.param.name; });

TEST(CampaignFile, NeedsItsFormatFirst) {
  EXPECT_THAT(complaints("[[mission]]\nname = \"aggregation\"\n[[method]]\nname = \"w\"\n"
                         "[race]\nmax_experiments = 2000\n"),
              ElementsAre(HasSubstr("the file must begin with its format: format = 1")));
}

TEST(CampaignFile, OfALaterFormatIsRefused) {
  std::string text = FileText{}.text();
  text.replace(text.find('1'), 1, "2");
  EXPECT_THAT(complaints(text), ElementsAre("in/x.toml:1:10: format 2 is newer than this program, "
                                            "which reads format 1"));
}

TEST(CampaignFile, OfAFormatThatNeverWasIsRefused) {
  std::string text = FileText{}.text();
  text.replace(text.find('1'), 1, "0");
  EXPECT_THAT(complaints(text), ElementsAre("in/x.toml:1:10: this program reads format 1, not "
                                            "format 0"));
}

TEST(CampaignFile, ThatIsNoTomlSaysWhere) {
  EXPECT_THAT(complaints("format = 1\n[campaign\n"), ElementsAre(HasSubstr("in/x.toml:2:10: ")));
}

TEST(CampaignFile, ReportsEveryComplaintAtOnceInTheOrderOfTheFile) {
  const FileText file{.campaign = "sead = 1\n",
                      .mission = "name = \"aggregation\"\nrobots = \"3\"\n",
                      .race = "max_experiments = 2000\nconfidence = 2\n"};
  EXPECT_THAT(complaints(file.text()),
              ElementsAre(HasSubstr("in/x.toml:3:1:"), HasSubstr("in/x.toml:6:10:"),
                          HasSubstr("in/x.toml:11:14:")));
}

TEST(CampaignFile, WithoutMissionMethodAndRaceSaysSo) {
  EXPECT_THAT(complaints("format = 1\n"),
              ElementsAre(HasSubstr("[[mission]]"), HasSubstr("[[method]]"), HasSubstr("[race]")));
}

TEST(CampaignFile, RefusesTwoMissionsOfOneName) {
  const FileText file{.mission = "name = \"aggregation\"\n[[mission]]\nname = \"aggregation\"\n"};
  EXPECT_THAT(complaints(file.text()), ElementsAre(HasSubstr("in/x.toml:6:8: two")));
}

TEST(CampaignFile, ThatIsNotThereIsNotFound) {
  const Error campaign = why_not(read_campaign("/nonexistent/x.toml"));
  EXPECT_EQ(campaign.kind, ErrorKind::NotFound);
  EXPECT_EQ(campaign.where, "/nonexistent/x.toml");
}

TEST(CampaignFile, WithABudgetThatFitsHasNoComplaints) {
  EXPECT_THAT(complaints(FileText{}.text()), IsEmpty());
}

TEST(BadCampaign, AMissionFileIsToldToBeOne) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "dispersion.toml";
  std::ofstream(file) << "format = 1\nname = \"dispersion\"\nrobots = 5\nduration = \"60 s\"\n"
                         "[arena]\nshape = \"square\"\nside = 3.0\n"
                         "[score]\nkind = \"formula\"\nvalue = \"nearest\"\nof = \"robots\"\n"
                         "over = \"mean\"\nat = \"end\"\n";
  const auto campaign = read_campaign(file);
  ASSERT_FALSE(campaign);
  ASSERT_EQ(campaign.error().size(), 1U);
  EXPECT_THAT(to_string(campaign.error().front()),
              HasSubstr("this is a mission, not a campaign: a campaign file names it ([[mission]] "
                        "with preset = "));
  EXPECT_THAT(complaints("format = 1\n[body]\nmass = 3\n"),
              ElementsAre(HasSubstr("this is a robot file; ")));
}

}  // namespace
}  // namespace swarmsmith

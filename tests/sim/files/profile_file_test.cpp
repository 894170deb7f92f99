#include "sim/files/profile_file.h"

#include "base/text/document.h"
#include "tests/sim/every_noise.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// The errors of a profile file as "file:line:column: sentence".
std::vector<std::string> complaints(const std::string& text) {
  return complaints_of(parse_profile("format = 1\n" + text, "mine.toml"));
}

TEST(Profile, TheDefaultHasTheNoiseOfTheThesis) {
  EXPECT_EQ(built_in_profile("rvr"), (Profile{.name = "rvr",
                                              .proximity = {.range_m = 0.4, .sd_m = 0.01},
                                              .ground_color = {.sd = 5},
                                              .lidar = {.half_width_m = 0.01}}));
}

TEST(Profile, ThatOfThePublishedFilesHasNone) {
  EXPECT_EQ(built_in_profile("argos3"), Profile{.name = "argos3"});
}

TEST(Profile, PseudoRealityHasTheNumbersOfTheThesisFacts) {
  // Section 13.
  EXPECT_EQ(built_in_profile("pseudo-reality"),
            (Profile{.name = "pseudo-reality",
                     .proximity = {.range_m = 0.4,
                                   .sd_m = 0.01,
                                   .scale_sd = 0.1,
                                   .largest_miss_rate = 0.2,
                                   .phantom_rate = 0.005},
                     .ground_color = {.sd = 5, .bias_sd = 10, .labeler = true},
                     .lidar = {.half_width_m = 0.01},
                     .neighbours = {.miss_rate = 0.05, .weak_share = 0.2, .weak_miss_rate = 0.5},
                     .timing = {.delays = {{10, 0.25}, {20, 0.5}, {30, 0.25}},
                                .least_period = 0.75,
                                .most_period = 1.0,
                                .jitter = 0.05},
                     .tracking = {.tag = {-0.072, 0}, .scores_tag = false}}));
}

TEST(Profile, TheRobotsOfTheThesisAreWhatTheirProgramsMakeOfThem) {
  EXPECT_EQ(
      built_in_profile("thesis-robots"),
      (Profile{.name = "thesis-robots",
               .float32_wire = true,
               .proximity = {.range_m = 0.4, .sd_m = 0.01, .touch_is_nothing = true},
               .ground_color = {.sd = 5, .labeler = true},
               .lidar = {.half_width_m = 0.01},
               .neighbours = {.source = NeighbourSensing::Source::Lidar, .every_sub_steps = 10},
               .timing = {.least_period = 0.0125, .most_period = 0.0125, .driver_sub_steps = 20},
               .treads = {.step_mps = 0.01},
               .tracking = {.tag = {-0.072, 0}, .scores_tag = true}}));
}

TEST(Profile, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const Expected<Profile> none = built_in_profile("mars");
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().kind, ErrorKind::NotFound);
  EXPECT_THAT(none.error().message,
              HasSubstr("built in are: rvr, argos3, pseudo-reality, thesis-robots, epuck"));
}

TEST(ProfileText, ReadsBackToTheSameProfileBitForBit) {
  std::vector<Profile> profiles = {every_noise()};
  for (const std::string& name : profile_names())
    profiles.push_back(built_in_profile(name).value());
  for (const Profile& profile : profiles) {
    const std::string text = text_of(profile_sections(profile, "simulator.profile"));
    const auto document = parse_document(text, "x.toml");
    ASSERT_TRUE(document) << text;
    Complaints wrong("x.toml");
    TableReader root(*document, "", wrong);
    auto simulator = root.table("simulator");
    auto table = simulator->table("profile");
    EXPECT_EQ(read_profile_table(*table), profile) << text;
    EXPECT_TRUE(wrong.empty()) << text;
  }
}

TEST(ProfileText, LeavesOutWhatCameLaterWhereItIsIdeal) {
  // The digest of a campaign is made of this text: another one would be another campaign.
  const std::string text =
      text_of(profile_sections(built_in_profile("argos3").value(), "simulator.profile"));
  EXPECT_EQ(text,
            "\n[simulator.profile]\n"
            "name = \"argos3\"\n"
            "contacts = \"exact\"\n"
            "\n"
            "[simulator.profile.proximity]\n"
            "range = 0.4\n"
            "sd = 0\n"
            "scale_sd = 0\n"
            "largest_miss_rate = 0\n"
            "phantom_rate = 0\n"
            "\n"
            "[simulator.profile.ground_color]\n"
            "sd = 0\n"
            "bias_sd = 0\n"
            "labeler = false\n"
            "labels = [\"black\", \"gray\", \"white\", \"red\", \"green\", \"blue\", "
            "\"yellow\"]\n"
            "\n"
            "[simulator.profile.lidar]\n"
            "half_width = 0\n"
            "\n"
            "[simulator.profile.neighbours]\n"
            "source = \"camera\"\n"
            "miss_rate = 0\n"
            "weak_share = 0\n"
            "weak_miss_rate = 0\n"
            "\n"
            "[simulator.profile.timing]\n"
            "delays = []\n"
            "period = [\"100 ms\", \"100 ms\"]\n"
            "jitter = 0\n"
            "\n"
            "[simulator.profile.tracking]\n"
            "tag = [0, 0]\n"
            "score_point = \"centre\"\n");
}

TEST(ProfileFile, HasTheNameOfItsFileAndIdealDevicesUnlessItSaysOtherwise) {
  const auto profile =
      value_of(parse_profile("format = 1\n[ground_color]\nsd = 2.5\n", "in/my_rvr.toml"));
  EXPECT_EQ(profile, (Profile{.name = "my_rvr", .ground_color = {.sd = 2.5}}));
}

TEST(ProfileFile, NeedsANameThatStoresTake) {
  EXPECT_THAT(complaint_of(parse_profile("format = 1\n", "my rvr.toml")),
              HasSubstr("it is \"my rvr\""));
}

TEST(ProfileFile, MayBeginWithABuiltInOne) {
  const auto profile = value_of(
      parse_profile("format = 1\nbase = \"pseudo-reality\"\n[timing]\ndelays = []\n", "x.toml"));
  Profile wanted = built_in_profile("pseudo-reality").value();
  wanted.name = "x";
  wanted.timing.delays.clear();
  EXPECT_EQ(profile, wanted);
}

TEST(ProfileFile, GetsASentenceWithLineAndColumnForEachMistake) {
  const struct {
    const char* text;
    const char* complaint;
  } mistakes[] = {
      {"[proximty]\n",
       "mine.toml:2:2: the file has no key `proximty` (did you mean \"proximity\"?)"},
      {"[proximity]\nsdd = 1\n", "mine.toml:3:1: [proximity] has no key `sdd`"},
      {"[proximity]\nsd = -1\n", "mine.toml:3:6: `sd` must be from 0 to 1, not -1"},
      {"[proximity]\nsd = nan\n", "mine.toml:3:6: `sd` must be from 0 to 1, not nan"},
      {"[proximity]\nrange = 0.05\n", "mine.toml:3:9: `range` must be from 0.06 to 2"},
      {"[proximity]\nphantom_rate = 1.1\n", "mine.toml:3:16: `phantom_rate` must be from 0 to 1"},
      {"[ground_color]\nlabeler = 1\n", "mine.toml:3:11: `labeler` must be true or false"},
      {"[ground_color]\nlabels = [\"pink\"]\n", "mine.toml:3:10: there is no colour \"pink\""},
      {"[ground_color]\nlabels = [\"blak\"]\n",
       "there is no colour \"blak\" (did you mean \"black\"?); known are: black, gray"},
      {"[ground_color]\nlabels = []\n", "mine.toml:3:10: `labels` must name a colour"},
      {"[neighbours]\nsource = \"lidr\"\n", "mine.toml:3:10: `source` cannot be \"lidr\" (did you"},
      {"[tracking]\nscore_point = \"tags\"\n", "mine.toml:3:15: `score_point` cannot be \"tags\""},
      {"[tracking]\ntag = [0.1]\n",
       "mine.toml:3:7: `tag` must be a place of two numbers in metres"},
      {"[tracking]\ntag = [5, 0]\n", "mine.toml:3:7: both numbers of `tag` must be from -1 to 1"},
      {"[timing]\ndelays = [ { time = \"105 ms\", probability = 1 } ]\n",
       "mine.toml:3:21: `time` must be a multiple of 10 ms"},
      {"[timing]\ndelays = [ { time = \"100\", probability = 1 } ]\n",
       "mine.toml:3:21: `time` must be a time with its unit"},
      {"[timing]\ndelays = [ { time = \"100 ms\" } ]\n", "a delay needs a `probability`"},
      {"[timing]\nperiod = [\"100 ms\", \"75 ms\"]\n",
       "mine.toml:3:10: `period` must be the shortest"},
      {"[timing]\nperiod = [\"0.5 ms\", \"75 ms\"]\n",
       "`period` must be the shortest and the longest period, from 1 ms to 1 s"},
      {"[timing]\ndriver = \"205 ms\"\n",
       "mine.toml:3:10: `driver` must be a multiple of 10 ms, the step of the simulator"},
      {"[neighbours]\nevery = \"11 s\"\n", "mine.toml:3:9: `every` must be from"},
      {"[treads]\nstep = 11\n", "mine.toml:3:8: `step` must be from 0 to 10, not 11"},
      {"[proximity]\ntouch = \"noting\"\n", "mine.toml:3:9: `touch` cannot be \"noting\" (did you"},
      {"wire = \"float16\"\n", "mine.toml:2:8: `wire` cannot be \"float16\""},
      {"base = \"rvx\"\n", "mine.toml:2:8: `base` cannot be \"rvx\" (did you mean \"rvr\"?)"},
      {"contacts = \"bullet\"\n", "mine.toml:2:12: `contacts` cannot be \"bullet\""},
  };
  for (const auto& [text, complaint] : mistakes) {
    EXPECT_THAT(complaints(text), Contains(HasSubstr(complaint))) << text;
  }
  EXPECT_THAT(complaints("[timing]\ndelays = [ { time = \"100 ms\", probability = 0.25 },\n"
                         "{ time = \"0 ms\", probability = 0.5 } ]\n"),
              ElementsAre("mine.toml:3:10: the probabilities of `delays` must sum to 1, these sum "
                          "to 0.75"));
  EXPECT_THAT(complaints("[timing]\ndelays = [ { time = \"100 ms\", probability = nan } ]\n"),
              ElementsAre("mine.toml:3:45: `probability` must be from 0 to 1, not nan"));
}

}  // namespace
}  // namespace swarmsmith

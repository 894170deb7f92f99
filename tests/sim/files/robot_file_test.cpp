#include "sim/files/robot_file.h"

#include <array>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "sim/engine/fitting.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using testing::Optional;

/// The errors of a robot file as "file:line:column: sentence".
std::vector<std::string> complaints(const std::string& text) {
  return complaints_of(parse_robot("format = 1\n" + text, "mine.toml"));
}

Robot built_in(const std::string& name) {
  return find_robot(name, "").value();
}

TEST(RobotFile, TheBuiltInRvrIsTheTable) {
  EXPECT_EQ(built_in("rvr"), rvr());
}

TEST(RobotFile, ATextOfItsOwnReadsBackAndIsEmptyForTheRvr) {
  EXPECT_EQ(own_robot_text(rvr()), "");
  EXPECT_EQ(own_robot_text(rvr_with(CircleOutline{0.1})), "");
  EXPECT_EQ(value_of(parse_own_robot("")), rvr());
  const Robot epuck = value_of(find_robot("epuck", {}));
  EXPECT_EQ(value_of(parse_own_robot(own_robot_text(epuck))), epuck);
  for (const auto& [text, why] :
       {std::pair("name = \"x\"", "a robot is a table `[robot]`"), std::pair("[robot", ""),
        std::pair("robot = 3", "robot"), std::pair("[robot]\nname = \"x\"\nwings = 2", "wings"),
        std::pair("[robot]\nbase = \"x.toml\"", "begins with a built-in one")})
    EXPECT_THAT(complaint_of(parse_own_robot(text)), HasSubstr(why)) << text;
}

TEST(RobotFile, BasesThatFormACircleAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.toml") << "format = 1\nbase = \"b.toml\"\n";
  std::ofstream(folder / "b.toml") << "format = 1\nbase = \"a.toml\"\n";
  EXPECT_THAT(complaint_of(find_robot("a.toml", folder / "")),
              HasSubstr("16 files, or is a circle"));
  std::ofstream(folder / "b.toml") << "format = 1\nbase = \"epuck\"\n";
  EXPECT_TRUE(find_robot("a.toml", folder / ""));
}

TEST(RobotFile, TheEpuckHasTheNumbersOfItsFacts) {
  const Robot epuck = built_in("epuck");
  EXPECT_EQ(epuck.body.outline, Outline(CircleOutline{0.035}));
  EXPECT_EQ(epuck.body.mass_kg, 0.4);
  EXPECT_EQ(epuck.body.inertia_kg_m2, 0.00098);
  EXPECT_EQ(epuck.drive.track_m, 0.053);
  EXPECT_EQ(epuck.proximity.rays_deg.front(), 11.25);
  EXPECT_NEAR(epuck.proximity.labels_deg.front(), 180 / 10.5884, 1e-9);
  EXPECT_EQ(epuck.ground.places.size(), 3U);
  EXPECT_EQ(epuck.neighbours.memory_ticks, 11);
}

TEST(RobotFile, BadFilesAreRefusedWithASentenceEach) {
  EXPECT_THAT(complaints("[body]\nshape = \"circle\"\ndiameter = 0.1\n[proximity]\nstart = 0.04\n"),
              ElementsAre("mine.toml:5:1: rays would start inside of the body, 0.04 m from the "
                          "centre; let them start at 0.05 m or farther, or at 0 for the body's "
                          "edge"));
  EXPECT_THAT(
      complaints("base = \"epuck\"\n[ground]\nmajority = 0\n"),
      ElementsAre(HasSubstr("a vote of 15 readings needs a `majority` from 1 to 14, not 0")));
  std::string rays = "0";
  for (int more = 1; more < 24; ++more)
    rays += ", 1";
  EXPECT_TRUE(parse_robot("format = 1\n[proximity]\nrays = [" + rays + "]\n", "mine.toml"));
  EXPECT_THAT(complaints("[proximity]\nrays = [" + rays + ", 2]\n"),
              ElementsAre("mine.toml:3:8: `rays` has 25 sensors; at most 24 are allowed"));
  EXPECT_THAT(complaints("[light]\nangles = [" + rays + ", 2]\n"),
              ElementsAre("mine.toml:3:10: `angles` has 25 sensors; at most 24 are allowed"));
  EXPECT_THAT(complaints("[proximity]\nlabels = [1, 2]\n"),
              ElementsAre(HasSubstr("the ring has 8 rays and 2 labels")));
  EXPECT_THAT(complaints("[proximity]\nrays = [0]\nlabels = [1, 2]\n"),
              ElementsAre(HasSubstr("the ring has 1 ray and 2 labels; give each ray a label")));
  EXPECT_THAT(complaints("[proximity]\nreading = \"strength\"\n"),
              ElementsAre(HasSubstr("needs a `reach` and a `law`")));
  EXPECT_THAT(complaints("[drive]\ntrack = 0\n"), ElementsAre(HasSubstr("`track` must be from")));
  EXPECT_THAT(complaints("[drive]\ntrak = 1\n"), ElementsAre(HasSubstr("trak")));
  EXPECT_THAT(complaints("base = \"epuk\"\n"),
              ElementsAre(HasSubstr("there is no robot `epuk` (did you mean \"epuck\"?)")));
}

TEST(RobotFile, KeysOfTheOutlineChangeTheBasesWithoutAShape) {
  const auto outline_of = [](const std::string& text) {
    const auto robot = parse_robot("format = 1\n" + text, "mine.toml");
    EXPECT_TRUE(robot) << text << to_string(robot ? Error{} : robot.error().front());
    return robot ? robot->body.outline : Outline();
  };
  const std::string rays = "[proximity]\nstart = 0\n";
  EXPECT_EQ(outline_of("base = \"epuck\"\n[body]\ndiameter = 0.08\n" + rays),
            Outline(CircleOutline{0.04}));
  EXPECT_EQ(outline_of("[body]\nside = 0.2\n"), Outline(BoxOutline{0.2, 0.2}));
  EXPECT_EQ(outline_of("[body]\nlength = 0.3\n"), Outline(BoxOutline{0.3, 0.286}));
  const TemporaryFolder folder;
  const auto outline_over = [&](const std::string& body, const std::string& more) {
    std::ofstream(folder / "base.toml") << "format = 1\n[body]\n" << body;
    std::ofstream(folder / "mine.toml") << "format = 1\nbase = \"base.toml\"\n[body]\n" << more;
    const auto robot = find_robot("mine.toml", folder / "");
    return robot ? robot->body.outline : Outline();
  };
  EXPECT_EQ(outline_over("shape = \"box\"\nlength = 0.3\nwidth = 0.2\n", "width = 0.25\n"),
            Outline(BoxOutline{0.3, 0.25}));
  EXPECT_EQ(outline_over("shape = \"polygon\"\ncorners = [[0.2, 0], [-0.1, 0.1], [-0.1, -0.1]]\n",
                         "corners = [[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]]\n"),
            Outline(PolygonOutline{{{0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}, {0.1, -0.1}}}));
}

TEST(RobotFile, KeysOfAnotherShapeNeedTheShape) {
  EXPECT_THAT(complaints("base = \"epuck\"\n[body]\nside = 0.08\n"),
              ElementsAre("mine.toml:4:8: the base's shape is a circle, which has no `side`; give "
                          "the `shape`, too"));
  EXPECT_THAT(complaints("[body]\ndiameter = 0.3\nside = 0.2\n"),
              ElementsAre(HasSubstr("the base's shape is a square, which has no `diameter`")));
  EXPECT_THAT(complaints("[body]\nside = 0.3\nwidth = 0.2\n"),
              ElementsAre(HasSubstr("leave out `side`, or the others")));
  EXPECT_THAT(complaints("[body]\nside = 6\n"), ElementsAre(HasSubstr("`side` must be from")));
  EXPECT_THAT(complaints("[body]\ncornrs = 6\n"), ElementsAre(HasSubstr("corners")));
  const auto mission = parse_mission(
      "format = 1\nname = \"x\"\nrobots = 2\n[robot]\nbase = \"epuck\"\n[robot.body]\n"
      "diameter = 0.06\n[score]\nkind = \"coverage\"\n",
      "x.toml");
  ASSERT_TRUE(mission) << to_string(mission.error().front());
  EXPECT_EQ(mission->mission.robot.body.outline, Outline(CircleOutline{0.03}));
}

TEST(RobotFile, NumbersFarFromWhatTheBodyCanHaveAreRefused) {
  EXPECT_THAT(complaints("base = \"epuck\"\n[body]\ninertia = 1e-30\n"),
              ElementsAre(HasSubstr("mine.toml:4:11: `inertia` is 1e-30 kg m2, but a plate of this "
                                    "outline and mass has ")));
  EXPECT_THAT(complaints("[body]\ninertia = 30\n"), ElementsAre(HasSubstr("`inertia` is 30 kg")));
  EXPECT_THAT(complaints("[body]\ninertia = 20\n"), IsEmpty());
  EXPECT_THAT(complaints("[body]\ninertia = 0.0001\n"), IsEmpty());
  EXPECT_THAT(complaints("[neighbours]\nless = 0.8\n"),
              ElementsAre("mine.toml:3:8: all distances would be 0 or less: `less` is 0.8 m, but "
                          "`range` is 0.75 m; give a smaller `less`"));
  EXPECT_THAT(complaints("base = \"epuck\"\n[neighbours]\nrange = 0.07\n"),
              ElementsAre(HasSubstr("`less` is 0.07 m, but `range` is 0.07 m")));
  EXPECT_THAT(complaints("base = \"epuck\"\n[neighbours]\nrange = 0\n"), IsEmpty())
      << "a robot that hears no other one";
  EXPECT_THAT(complaints("base = \"epuck\"\n[proximity]\nstart = 0.6\n"),
              ElementsAre(HasSubstr(
                  "mine.toml:4:9: `start` is 0.6 m from the centre, but the body "
                  "ends 0.035 m from it; at most 0.5 m, or three times the body's radius")));
  EXPECT_THAT(complaints("[body]\nshape = \"circle\"\ndiameter = 0.4\n[proximity]\nstart = 0.6\n"),
              IsEmpty());
  EXPECT_THAT(complaints("[light]\nout = 0.8\n"),
              ElementsAre(HasSubstr("mine.toml:3:7: `out` is 0.8 m from the centre")));
  EXPECT_THAT(complaints("base = \"epuck\"\n[light]\nout = 0.03\n"),
              ElementsAre(HasSubstr("mine.toml:4:7: strengths of light are measured at the")));
  EXPECT_THAT(complaints("[body]\nshape = \"circle\"\ndiameter = 0.05\n"), IsEmpty())
      << "the RVR's places on a small body";
}

/// Such robots drove through walls.
TEST(RobotFile, DrivesThatWallsDoNotStopAreRefused) {
  const std::string small = "[body]\nshape = \"circle\"\ndiameter = 0.02\nmass = 0.05\n[drive]\n";
  EXPECT_THAT(complaints(small + "max_speed = 2.01\n"),
              ElementsAre("mine.toml:7:13: it would move 0.0201 m in 0.01 s, more than its own "
                          "width of 0.02 m, and so through walls; `max_speed` may be up to 2 m/s "
                          "for this body"));
  EXPECT_THAT(complaints(small + "max_speed = 1.99\nforce = 24.9\n"), IsEmpty());
  EXPECT_THAT(complaints(small + "force = 25.1\n"),
              ElementsAre("mine.toml:7:9: `force` is 25.1 N, which would push a robot of 0.05 kg "
                          "through walls; give up to 25 N, 500 times its mass"));
}

TEST(RobotFile, APolygonHasItsCentreOfMassWhereTheRobotHasItsCentre) {
  const std::string body = "[body]\nshape = \"polygon\"\ncorners = ";
  EXPECT_THAT(
      complaints(body + "[[0, 0], [0.2, 0], [0, 0.1]]\n"),
      ElementsAre("mine.toml:4:11: this polygon cannot be a robot's body: its centre of mass is "
                  "[0.066667, 0.033333], but a robot's must be at [0, 0]; give its corners, and "
                  "all other places on it, relative to that point"));
  const std::string centred =
      "[[-0.066667, -0.033333], [0.133333, -0.033333], [-0.066667, 0.066667]]\n";
  EXPECT_THAT(complaints(body + centred), IsEmpty()) << "what the sentence says is near enough";
  EXPECT_THAT(complaints(body + "[[0.2, 0], [0, 0.02], [-0.2, 0], [0, 0.1]]\n"),
              ElementsAre("mine.toml:4:11: this polygon cannot be a robot's body: it is not "
                          "convex"));
}

TEST(RobotFile, KeysThatDoNothingForTheRobotAreRefused) {
  for (const auto& [text, sentence] : std::initializer_list<std::pair<const char*, const char*>>{
           {"[proximity]\nreach = 1\n",
            "mine.toml:3:9: `reach` is only for robots whose proximity sensors give strengths and "
            "does nothing here; leave it out"},
           {"[proximity]\nlaw = [1, 0, 0]\n", "`law` is only for robots whose proximity sensors"},
           {"[ground]\nticks = 2\n", "`ticks` is only for robots whose ground sensors vote"},
           {"[ground]\nmajority = 2\n", "`majority` is only for robots"},
           {"[ground]\nblack_below = 0.1\n", "`black_below` is only for robots"},
           {"[ground]\nwhite_above = 0.1\n", "`white_above` is only for robots"},
           {"[neighbours]\nticks = 2\n",
            "`ticks` is only for robots that hear each other by radio"},
           {"base = \"epuck\"\n[neighbours]\nsource = \"sight\"\nticks = 2\n",
            "`ticks` is only for robots that hear"}}) {
    EXPECT_THAT(complaints(text), ElementsAre(HasSubstr(sentence))) << text;
  }
  EXPECT_THAT(complaints("[proximity]\nreach = 0.0\nlaw = [0, 0, 0]\n"), IsEmpty())
      << "as without it";
}

TEST(RobotFile, AMissionWithARobotReadsBackToTheSameBits) {
  for (const char* robot :
       {"[robot]\nbase = \"epuck\"\n[robot.proximity]\nreading = \"distance\"\n"
        "[robot.ground]\nreading = \"color\"\npoints = [[0, 0]]\n"
        "[robot.neighbours]\nsource = \"sight\"\n",
        "robot = \"epuck\"\n", "[robot]\nbase = \"epuck\"\n[robot.neighbours]\nrange = 0.7\n",
        "[robot]\nname = \"round\"\n[robot.body]\nshape = \"circle\"\n"
        "diameter = 0.2\nmass = 1\n"}) {
    const std::string text = std::string("format = 1\nname = \"x\"\nrobots = 2\n") + robot +
                             "[score]\nkind = \"coverage\"\n";
    const auto mission = value_of(parse_mission(text, "x.toml"));
    EXPECT_NE(mission.mission.robot, rvr());
    const auto again = value_of(parse_mission(mission_text(mission), "x.toml"));
    EXPECT_EQ(again, mission);
  }
}

TEST(RobotFile, ATableWithTheNameOfABuiltInRobotHasItsValues) {
  const auto complaints_of_table = [](const std::string& keys) {
    return complaints_of(
        parse_mission("format = 1\nname = \"x\"\nrobots = 2\n[score]\nkind = "
                      "\"coverage\"\n[robot]\n" +
                          keys,
                      "x.toml"));
  };
  EXPECT_THAT(complaints_of_table("name = \"epuck\"\nbase = \"epuck\"\n"), IsEmpty());
  EXPECT_THAT(complaints_of_table("base = \"epuck\"\n[robot.neighbours]\nrange = 0.7\n"), IsEmpty())
      << "it has no name of its own";
  for (const std::string base : {"", "base = \"epuck\"\n", "base = \"rvr\"\n"}) {
    EXPECT_THAT(
        complaints_of_table("name = \"epuck\"\n" + base + "[robot.drive]\nmax_speed = 0.05\n"),
        ElementsAre("x.toml:7:8: `epuck` is built in with other values; give the robot "
                    "another name, or leave `name` out"))
        << base;
  }
  Robot slow = built_in("epuck");
  slow.drive.max_speed_mps = 0.05;
  std::string whole;
  for (const Section& section : robot_sections(slow, "robot"))
    whole += text_of({section});
  const std::string header = "[robot]\n";
  EXPECT_THAT(complaints_of_table(whole.erase(whole.find(header), header.size())), IsEmpty())
      << "as stores have it";
}

TEST(RobotFile, AMissionOfTheRvrSaysItsOutlineAlone) {
  const MissionEntry entry{built_in_mission("aggregation").value()};
  EXPECT_THAT(mission_text(entry),
              HasSubstr("robot = { shape = \"box\", length = 0.286, width = 0.286 }"));
}

TEST(RobotFile, WhatDoesNotFitIsRefusedWithASentence) {
  const Robot epuck = built_in("epuck");
  EXPECT_THAT(misfit(chocolate(), epuck), Optional(HasSubstr("takes distances")));
  EXPECT_THAT(misfit(**find_flavour("chocolate-epuck"), rvr()),
              Optional(HasSubstr("takes strengths")));
  EXPECT_EQ(misfit(**find_flavour("chocolate-epuck"), epuck), std::nullopt);
  Robot slippery = epuck;
  slippery.body.robot_friction = 0;
  Profile box2d = built_in_profile("epuck").value();
  EXPECT_EQ(misfit(box2d, slippery), std::nullopt);
  box2d.contacts = ContactModel::Box2d;
  EXPECT_EQ(misfit(box2d, epuck), std::nullopt);
  EXPECT_THAT(misfit(box2d, slippery), Optional(HasSubstr("must be at least 0.000001")));
  EXPECT_EQ(misfit(**find_flavour("maple-epuck-2018"), epuck), std::nullopt);
  Flavour other = **find_flavour("chocolate-epuck");
  other.reference = "rm3.0";
  EXPECT_EQ(misfit(other, epuck),
            "the flavour `chocolate-epuck` needs the reference model rm3.0, but the robot `epuck` "
            "is simulated with rm1.1 and rm1.2 and rm1-2018");
  EXPECT_EQ(
      misfit(built_in_profile("rvr").value(), epuck),
      "the profile `rvr` does not fit the robot `epuck`: `proximity.sd` is only for robots whose "
      "proximity sensors measure distances");
  EXPECT_THAT(misfit(built_in_profile("epuck").value(), rvr()),
              Optional(HasSubstr("`proximity.half_width`")));
  Robot far = rvr();
  far.name = "far";
  far.neighbours.range_m = 2;
  EXPECT_EQ(misfit(built_in_profile("thesis-robots").value(), rvr()), std::nullopt);
  EXPECT_EQ(misfit(built_in_profile("rvr").value(), far), std::nullopt);
  EXPECT_EQ(
      misfit(built_in_profile("thesis-robots").value(), far),
      "the profile `thesis-robots` does not fit the robot `far`: it finds neighbours with the "
      "RVR's lidar, which has the RVR's `range` and `less`; use a profile with "
      "neighbours.source = \"camera\"");
  for (const char* name : {"epuck", "epuck-ideal", "epuck-pseudo-reality", "argos3"})
    EXPECT_EQ(misfit(built_in_profile(name).value(), epuck), std::nullopt) << name;
}

TEST(RobotFile, KeysOfProfilesThatDoNothingForTheRobotDoNotFit) {
  const auto misfit_of = [](const std::string& text, const Robot& robot) {
    const auto profile = parse_profile("format = 1\n" + text, "mine.toml");
    EXPECT_TRUE(profile) << text;
    return misfit(*profile, robot).value_or("");
  };
  const Robot epuck = built_in("epuck");
  for (const auto& [device, key, value] :
       std::initializer_list<std::array<std::string, 3>>{{"proximity", "range", "0.3"},
                                                         {"proximity", "sd", "[0, 0.1]"},
                                                         {"proximity", "scale_sd", "0.1"},
                                                         {"proximity", "largest_miss_rate", "0.1"},
                                                         {"proximity", "phantom_rate", "0.1"},
                                                         {"proximity", "touch", "\"nothing\""},
                                                         {"ground_color", "sd", "0.1"},
                                                         {"ground_color", "bias_sd", "0.1"},
                                                         {"ground_color", "labeler", "true"},
                                                         {"ground_color", "labels", "[\"red\"]"},
                                                         {"lidar", "half_width", "0.1"},
                                                         {"neighbours", "source", "\"lidar\""},
                                                         {"neighbours", "every", "\"1 s\""}}) {
    const std::string text = "[" + device + "]\n" + key + " = " + value + "\n";
    EXPECT_THAT(misfit_of(text, epuck),
                HasSubstr("`" + device + "." + key + "` is only for robots "));
    EXPECT_EQ(misfit_of(text, rvr()), "");
  }
  for (const std::string device : {"proximity", "ground_color", "light"}) {
    const std::string text = "[" + device + "]\nhalf_width = 0.1\n";
    EXPECT_THAT(misfit_of(text, rvr()),
                HasSubstr("`" + device + ".half_width` is only for robots "));
    EXPECT_EQ(misfit_of(text, epuck), "");
  }
}

TEST(RobotFile, ANetworkOfSingleSensorsNeedsAllOfThem) {
  Robot robot = built_in("epuck");
  EXPECT_EQ(misfit(NetworkInputs::Rm11, robot), std::nullopt);
  robot.light.angles_deg = {0, 180};
  EXPECT_EQ(misfit(NetworkInputs::Rm12, robot), std::nullopt) << "a sum over the ring";
  EXPECT_EQ(misfit(NetworkInputs::Rm11, robot),
            "a network with the inputs rm1.1 reads the strengths of 8 proximity and 8 light "
            "sensors, but the robot `epuck` has 8 and 2");
  robot.light = {.reading = LightRing::Reading::Lux};
  EXPECT_THAT(misfit(NetworkInputs::Rm11, robot), Optional(HasSubstr("that give lux")));
}

TEST(RobotFile, TheExampleRobotFitsTheFlavoursOfDistances) {
  const auto robot =
      value_of(find_robot(SWARMSMITH_SOURCE_DIR "/examples/missions/robots/turtlebot4.toml", ""));
  EXPECT_EQ(robot.proximity.rays_deg.size(), 7U);
  EXPECT_EQ(misfit(watermelon(), robot), std::nullopt);
}

TEST(ProfileRanges, AreReadAndWritten) {
  const auto profile = value_of(parse_profile(
      "format = 1\n[treads]\nsd = [0.01, 0.1]\nway = { run = [0.9, 1] }\n", "mine.toml"));
  EXPECT_THAT(profile.ranges, ElementsAre(FieldRange{"treads.sd", 0.01, 0.1, false},
                                          FieldRange{"treads.way", 0.9, 1, true}));
  std::string text = "format = 1\n";
  for (Section& section : profile_sections(profile, "profile")) {
    if (section.header != "[profile.treads]") continue;
    section.header = "[treads]";
    text += text_of({section});
  }
  EXPECT_EQ(parse_profile(text, "mine.toml"), profile);
}

TEST(ProfileRanges, AreDrawnForRobotAndRunOrForTheRun) {
  Profile profile{.name = "mine"};
  profile.ranges = {{"treads.sd", 0.01, 0.1, false}, {"treads.way", 0.9, 1, true}};
  const Profile first = drawn_profile(profile, Rng(1), 0);
  const Profile second = drawn_profile(profile, Rng(1), 1);
  EXPECT_NE(first.treads.sd, second.treads.sd);
  EXPECT_EQ(first.treads.way, second.treads.way);
  EXPECT_NE(first.treads.way, drawn_profile(profile, Rng(2), 0).treads.way);
  EXPECT_GE(first.treads.sd, 0.01);
  EXPECT_LE(first.treads.sd, 0.1);
  EXPECT_THAT(first.ranges, IsEmpty());
}

TEST(ProfileRanges, WithTheirEndsExchangedOrTooWideAreRefused) {
  const auto errors = [](const std::string& range) {
    const auto profile = parse_profile("format = 1\n[treads]\nsd = " + range + "\n", "mine.toml");
    return profile ? std::string() : to_string(profile.error().front());
  };
  EXPECT_THAT(errors("[0.2, 0.1]"),
              HasSubstr("the ends of the range `treads.sd` are in the wrong order"));
  EXPECT_THAT(errors("[0.2, 7]"), HasSubstr("must be within 0 and 1"));
  EXPECT_THAT(errors("{ runs = [0.1, 0.2] }"), HasSubstr("{ run = [0, 0.1] }"));
  EXPECT_THAT(errors("[1]"), HasSubstr("a range such as [0, 0.1]"));
}

}  // namespace
}  // namespace swarmsmith

#include "sim/files/mission_file.h"

#include <string>
#include <vector>

#include "base/text/document.h"
#include "sim/mission/polygon.h"
#include "tests/sim/random_mission.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

constexpr const char* kScore = "[score]\nkind = \"robots_on\"\ncolor = \"white\"\n";

/// A mission file with an arena, which lies in the folder of the examples.
MissionOrErrors with_arena(const std::string& arena, const std::string& more = "") {
  return parse_mission("format = 1\n" + more + kScore + "[arena]\n" + arena,
                       SWARMSMITH_SOURCE_DIR "/examples/missions/x.toml");
}

Mission read(const std::string& arena, const std::string& more = "") {
  auto entry = with_arena(arena, more);
  if (entry) return std::move(entry->mission);
  for (const Error& error : entry.error())
    ADD_FAILURE() << to_string(error);
  return {};
}

/// The sentences without the file's name and place.
std::vector<std::string> complaints(const std::string& arena, const std::string& more = "") {
  std::vector<std::string> sentences;
  const auto entry = with_arena(arena, more);
  if (entry) return sentences;
  for (const Error& error : entry.error())
    sentences.push_back(error.message);
  return sentences;
}

/// What a campaign file with these lines would read.
std::vector<MissionEntry> read_back(const std::string& text) {
  const auto document = parse_document(text, "x.toml");
  if (!document) ADD_FAILURE() << to_string(document.error());
  Complaints wrong("x.toml");
  TableReader root(*document, "", wrong);
  auto missions = read_missions(root, "");
  for (const Error& error : wrong.take())
    ADD_FAILURE() << to_string(error);
  return missions;
}

TEST(MissionText, ReadsBackToTheSameMissionBitForBit) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const MissionEntry entry{.mission = random_mission(seed), .test_count = 7};
    const std::string text = text_of(mission_sections(entry));
    const auto again = read_back(text);
    ASSERT_EQ(again.size(), 1U);
    ASSERT_EQ(again[0], entry) << text;
    EXPECT_EQ(text_of(mission_sections(again[0])), text);
    const auto file = value_of(parse_mission(mission_text(entry), "m.toml"));
    EXPECT_EQ(file, entry);
  }
}

TEST(MissionFile, HasTheNameOfItsFileUnlessItSaysOne) {
  EXPECT_EQ(read("").name, "x");
  EXPECT_EQ(read("", "name = \"other\"\n").name, "other");
}

TEST(MissionFile, NeedsAScoreUnlessItBeginsWithABuiltInOne) {
  const auto entry = parse_mission("format = 1\nrobots = 5\n", "x.toml");
  ASSERT_FALSE(entry);
  EXPECT_THAT(entry.error().front().message, HasSubstr("needs a `preset` or a `score`; built in"));
}

TEST(MissionFile, WhoseNameIsNoNameNeedsOne) {
  const std::string text = "format = 1\npreset = \"aggregation\"\n";
  const auto entry = parse_mission(text, "my mission.toml");
  ASSERT_FALSE(entry);
  ASSERT_EQ(entry.error().size(), 1U);
  EXPECT_EQ(
      entry.error().front().message,
      "the mission gets its file's name, but \"my mission\" is not a name: a name consists of "
      "letters, digits, `_`, `-` and `.`; give it a `name`");
  EXPECT_TRUE(parse_mission(text + "name = \"mine\"\n", "my mission.toml"));
}

TEST(MissionFile, BeginsWithABuiltInOneIfItSaysSo) {
  const auto entry =
      value_of(parse_mission("format = 1\npreset = \"aggregation\"\nrobots = 5\n", "x.toml"));
  Mission wanted = built_in_mission("aggregation").value();
  wanted.name = "x";
  wanted.robots = 5;
  EXPECT_EQ(entry.mission, wanted);
}

TEST(ArenaShapes, HaveTheirAreas) {
  const auto area = [](const std::string& keys) { return area_of(read(keys).arena); };
  EXPECT_NEAR(area("shape = \"dodecagon\"\narea = 4.91\n"), 4.91, 1e-12);
  EXPECT_NEAR(area("shape = \"dodecagon\"\ninradius = 1\n"), 12 * (2 - std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(area("shape = \"regular\"\nsides = 7\narea = 3\n"), 3, 1e-12);
  EXPECT_NEAR(area("shape = \"regular\"\nsides = 6\ninradius = 1\n"), 2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(area("shape = \"square\"\nside = 3\n"), 9, 1e-12);
  EXPECT_NEAR(area("shape = \"rectangle\"\nwidth = 3\nheight = 2\n"), 6, 1e-12);
  EXPECT_NEAR(area("shape = \"circle\"\ndiameter = 2\n"), kPi, 0.01);
  EXPECT_NEAR(area("shape = \"polygon\"\ncorners = [[0, 0], [0, 2], [2, 0]]\n"), 2, 1e-12);
  EXPECT_EQ(read("").arena.walls, dodecagon_of_the_thesis().walls);
}

// Stores have the corners of all walls, whose limits are those of coordinates.
TEST(ArenaShapes, AreRefusedWhoseTextCouldNotBeReadBack) {
  const std::string place = "instances = { training = { placement = \"anywhere\" } }\n";
  const std::string triangle = "shape = \"regular\"\nsides = 3\ninradius = ";
  const std::string pentagon = "shape = \"regular\"\nsides = 5\ninradius = ";
  for (const std::string& fits :
       {triangle + "49.9\n", pentagon + "80\n", std::string("inradius = 99.9\n"),
        std::string("shape = \"circle\"\ndiameter = 199.9\n")}) {
    const MissionEntry entry{read(fits, place)};
    EXPECT_EQ(value_of(parse_mission(mission_text(entry), "x.toml")), entry) << fits;
  }
  for (const std::string& too_big : {triangle + "50.1\n", pentagon + "81\n"}) {
    EXPECT_THAT(complaints(too_big, place),
                ElementsAre(HasSubstr("these walls have corners beyond 100 m along x or y; give a "
                                      "smaller `inradius`")))
        << too_big;
  }
  EXPECT_THAT(complaints("shape = \"square\"\nside = 200\nobstacles = [ { shape = \"polygon\", "
                         "corners = [[-100, -100], [100, -100], [100, 100]], height = 1 } ]\n",
                         place),
              ElementsAre(HasSubstr("this polygon has corners beyond 100 m from its centre")));
}

TEST(ArenaShapes, WallsThatJoinAreAPolygonInEitherDirection) {
  const Mission forth = read(
      "shape = \"polygon\"\n"
      "walls = [[-1, -1, 1, -1], [1, -1, 1, 1], [1, 1, -1, 1], [-1, 1, -1, -1]]\n");
  const Mission back =
      read("shape = \"polygon\"\ncorners = [[-1, -1], [-1, 1], [1, 1], [1, -1]]\n");
  EXPECT_EQ(forth.arena.walls, back.arena.walls);
  EXPECT_GT(area_of(back.arena), 0);
}

TEST(ArenaShapes, OtherThanTheDodecagonPlaceRobotsAnywhere) {
  EXPECT_EQ(read("shape = \"square\"\nside = 3\n").placement, Placement(PlaceAnywhere{}));
  EXPECT_EQ(read("").placement, Placement(PlaceInDisc{}));
}

struct BadArena {
  const char* keys;
  const char* sentence;
};

TEST(ArenaShapes, ThatMakeNoArenaAreExplained) {
  const BadArena bad[] = {
      {"shape = \"polygon\"\nwalls = [[0, 0, 1, 0], [1, 0, 1, 1], [1, 1, 0.2, 0]]\n",
       "not closed: wall 3 ends at (0.2, 0), wall 1 begins at (0, 0), a gap of 0.2 m"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [2, 2], [2, 0], [0, 2]]\n",
       "side 1, from (0, 0), crosses or touches side 3, from (2, 0)"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0]]\n", "2 corners; a polygon has at least 3"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0], [0, 1], [0, 0]]\n",
       "corners 1 and 4 are the same point, (0, 0); the last corner joins the first"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0], [2, 0]]\n", "turns back on itself"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0], [0, nan]]\n", "not nan"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0], [0, 1e9]]\n", "from -100 to 100"},
      {"shape = \"polygon\"\ncorners = [[0, 0], [1, 0], [0]]\n",
       "`corners` must be a list of lists of 2 numbers, such as"},
      {"shape = \"polygon\"\n", "needs either `corners` or `walls`"},
      {"shape = \"square\"\nside = -1\n", "`side` must be from 0.1 to 200, not -1"},
      {"shape = \"square\"\nside = nan\n", "not nan"},
      {"shape = \"square\"\n", "needs `side`"},
      {"shape = \"square\"\nside = 1\ndiameter = 2\n", "`diameter` belongs to shape = \"circle\""},
      {"shape = \"regular\"\nsides = 2\narea = 1\n", "`sides` must be from 3 to 60"},
      {"shape = \"regular\"\nsides = 5\n", "needs an `inradius` or an `area`"},
      {"area = 4\ninradius = 1\n", "define the same size; give only one"},
      {"area = 0\n", "`area` must be from 0.01"},
      {"wall_height = 0\n", "`wall_height` must be from 0.001"},
      {"shape = \"octagon\"\n", "`shape` cannot be \"octagon\""},
  };
  for (const BadArena& arena : bad) {
    EXPECT_THAT(complaints(arena.keys), ElementsAre(HasSubstr(arena.sentence))) << arena.keys;
  }
}

TEST(Solids, StandWhereTheFileSaysWithPolygonsAroundTheirCentreOfMass) {
  const Mission mission = read(
      "shape = \"square\"\nside = 6\n"
      "obstacles = [ { shape = \"circle\", x = 1, y = 2, diameter = 0.5 },\n"
      "  { shape = \"box\", x = -1, y = 0, length = 1, width = 0.2, angle = 90, height = 1 },\n"
      "  { shape = \"polygon\", corners = [[1, 1], [1, 1.6], [1.6, 1]] } ]\n"
      "objects = [ { shape = \"square\", x = 0, y = -2, side = 0.4, mass = 1, friction = 3.6 } ]\n"
      "lights = [ { x = 0, y = -4.25, intensity = 500 } ]\n");
  const Arena& arena = mission.arena;
  ASSERT_EQ(arena.obstacles.size(), 3U);
  EXPECT_EQ(arena.obstacles[0], (Obstacle{CircleOutline{0.25}, {1, 2, 0}, 0.3}));
  EXPECT_EQ(arena.obstacles[1].outline, Outline(BoxOutline{1, 0.2}));
  EXPECT_NEAR(arena.obstacles[1].pose.theta, kPi / 2, 1e-15);
  EXPECT_EQ(arena.obstacles[1].height_m, 1);
  EXPECT_NEAR(arena.obstacles[2].pose.x, 1.2, 1e-12);
  EXPECT_NEAR(arena.obstacles[2].pose.y, 1.2, 1e-12);
  const auto& corners = std::get<PolygonOutline>(arena.obstacles[2].outline).corners;
  EXPECT_NEAR(corners[0].x, -0.2, 1e-12);
  EXPECT_GT(signed_area(corners), 0);
  EXPECT_THAT(arena.objects,
              ElementsAre(MovableObject{BoxOutline{0.4, 0.4}, {0, -2, 0}, 1, 3.6, 0.3}));
  EXPECT_THAT(arena.lights, ElementsAre(Light{0, -4.25, 0.75, 500}));
}

TEST(Solids, WithoutRoomOrSenseAreExplained) {
  const BadArena bad[] = {
      {"obstacles = [ { shape = \"circle\", x = 5, y = 0, diameter = 1 } ]\n",
       "obstacle 1 is outside the walls"},
      {"objects = [ { shape = \"circle\", x = 1.1, y = 0, diameter = 0.5, mass = 1, friction = 1 } "
       "]\n",
       "object 1 would stand in a wall"},
      {"obstacles = [ { shape = \"circle\", x = 0, y = 0, diameter = 1 } ]\n"
       "objects = [ { shape = \"square\", x = 0.5, y = 0, side = 0.2, mass = 1, friction = 1 } ]\n",
       "object 1 would stand in obstacle 1"},
      {"obstacles = [ { shape = \"circle\", x = 0, y = 0, diameter = 0 } ]\n",
       "`diameter` must be from 0.005"},
      {"obstacles = [ { shape = \"star\", x = 0, y = 0 } ]\n", "`shape` cannot be \"star\""},
      {"obstacles = [ { shape = \"polygon\", corners = [[0, 0], [1, 0], [0.1, 0.1], [0, 1]] } ]\n",
       "it is not convex"},
      {"objects = [ { shape = \"circle\", x = 0, y = 0, diameter = 0.5, friction = 1 } ]\n",
       "needs `mass`"},
      {"obstacles = [ { shape = \"circle\", x = 0, y = 0, diameter = 1, angle = 1, theta = 1 } ]\n",
       "mean the same"},
  };
  for (const BadArena& arena : bad) {
    EXPECT_THAT(complaints(arena.keys), ElementsAre(HasSubstr(arena.sentence))) << arena.keys;
  }
}

TEST(Images, LieOnTheFloor) {
  const Mission mission = read(
      "spots = [ { shape = \"image\", file = \"ring.png\", x = 0, y = 0, width = 2.6, height = 2.6 "
      "} ]\n");
  EXPECT_EQ(floor_at(mission.arena, {0, 0}), (Rgb{127, 127, 127}));
  EXPECT_EQ(floor_at(mission.arena, {0.75, 0}), (Rgb{255, 255, 0}));
}

TEST(Images, ThatCannotBeReadAreExplained) {
  const auto spot = [](const std::string& keys) {
    return "spots = [ { shape = \"image\", x = 0, y = 0, width = 1, height = 1" + keys + " } ]\n";
  };
  EXPECT_THAT(complaints(spot("")), ElementsAre(HasSubstr("an image needs a `file`")));
  EXPECT_THAT(complaints(spot(", file = \"no.png\"")),
              ElementsAre(HasSubstr("no.png: there is no such image file")));
  EXPECT_THAT(complaints(spot(", file = \"..\"")), ElementsAre(HasSubstr("this is a folder")));
  EXPECT_THAT(complaints(spot(", file = \"maze.toml\"")),
              ElementsAre(HasSubstr("maze.toml: this is not a PNG image")));
  EXPECT_THAT(complaints(spot(", data = \"AAA\"")), ElementsAre(HasSubstr("not base64")));
  EXPECT_THAT(complaints(spot(", data = \"AAAA\"")), ElementsAre(HasSubstr("not a PNG image")));
}

TEST(Placements, AreReadWithTheirKeys) {
  const auto placement = [](const std::string& training, const std::string& robots = "1") {
    return read("shape = \"square\"\nside = 4\n",
                "robots = " + robots + "\ninstances = { training = " + training + " }\n")
        .placement;
  };
  EXPECT_EQ(placement("{ placement = \"uniform\", x = 0.5, radius = 1 }"),
            Placement(PlaceInDisc{{0.5, 0}, 1}));
  EXPECT_EQ(placement("{ placement = \"rectangle\", x = 0, y = 1, width = 2, height = 1 }"),
            Placement(PlaceInRectangle{{{0, 1}, 2, 1}}));
  EXPECT_EQ(placement("{ placement = \"anywhere\" }"), Placement(PlaceAnywhere{}));
  EXPECT_EQ(placement("{ placement = \"fixed\", poses = [ { x = 1, y = 0 }, { x = -1, y = 0, theta "
                      "= 0.5 } ] }",
                      "2"),
            Placement(PlaceAt{{{1, 0, 0}, {-1, 0, 0.5}}}));
}

TEST(Placements, MayIgnoreObstacles) {
  const auto read_with = [](const std::string& training) {
    return read(
        "shape = \"square\"\nside = 4\nobstacles = [ { shape = \"box\", x = 1, y = 0, length "
        "= 0.5, width = 0.5, height = 0.2 } ]\n",
        "robots = 1\ninstances = { training = { placement = \"fixed\", poses = [ { x = 1, y = "
        "0 } ]" +
            training + " } }\n");
  };
  const Mission mission = read_with(", ignores_obstacles = true");
  EXPECT_TRUE(mission.ignores_obstacles);
  const MissionEntry entry{mission};
  EXPECT_THAT(mission_text(entry), HasSubstr("ignores_obstacles = true }"));
  EXPECT_EQ(value_of(parse_mission(mission_text(entry), "x.toml")).mission, mission);
  EXPECT_THAT(mission_text(MissionEntry{built_in_mission("aggregation").value()}),
              Not(HasSubstr("ignores_obstacles")));
}

TEST(Placements, StayAsTheyAreUnlessOneIsGiven) {
  const auto placement = [](const std::string& arena, const std::string& training) {
    return read(arena, "robots = 1\ninstances = { training = { " + training + " } }\n").placement;
  };
  const std::string square = "shape = \"square\"\nside = 4\n";
  EXPECT_EQ(placement(square, "ignores_obstacles = true"), Placement(PlaceAnywhere{}));
  EXPECT_EQ(placement(square, ""), Placement(PlaceAnywhere{}));
  EXPECT_EQ(placement(square, "radius = 0.5"), Placement(PlaceInDisc{{}, 0.5}));
  EXPECT_EQ(placement("", "ignores_obstacles = true"), Placement(PlaceInDisc{}));
  EXPECT_EQ(placement("", "x = 0.25, radius = 0.5"), Placement(PlaceInDisc{{0.25, 0}, 0.5}));
}

TEST(Placements, ThatCannotBeAreExplained) {
  const auto wrong = [](const std::string& training, const std::string& robots = "2") {
    return complaints("shape = \"square\"\nside = 4\n",
                      "robots = " + robots + "\ninstances = { training = " + training + " }\n");
  };
  EXPECT_THAT(wrong("{ placement = \"fixed\", poses = [ { x = 1, y = 0 } ] }"),
              ElementsAre(HasSubstr("poses for 1 robot, but the mission has 2")));
  EXPECT_THAT(wrong("{ placement = \"fixed\", poses = [ { x = 1.9, y = 0 } ] }", "1"),
              ElementsAre(HasSubstr("robot 1 at (1.9, 0) would stand in a wall")));
  EXPECT_THAT(wrong("{ placement = \"fixed\", poses = [ { x = 1, y = 0 }, { x = 1.1, y = 0 } ] }"),
              ElementsAre(HasSubstr("robot 2 at (1.1, 0) would stand in robot 1")));
  EXPECT_THAT(wrong("{ placement = \"rectangle\", x = 0, y = 0, width = 0.1, height = 0.1 }"),
              ElementsAre(HasSubstr("take fewer robots, or place them over a larger part")));
  EXPECT_THAT(wrong("{ placement = \"uniform\" }"), ElementsAre(HasSubstr("needs a `radius`")));
  EXPECT_THAT(wrong("{ x = 1 }"), ElementsAre(HasSubstr("needs a `radius`")));
  EXPECT_THAT(wrong("{ placement = \"unifrm\" }"),
              ElementsAre(HasSubstr("did you mean \"uniform\"?")));
}

TEST(Robots, HaveBodiesOfAnyConvexShape) {
  const auto body = [](const std::string& keys) {
    return read("", "robot = { " + keys + " }\n").robot.body.outline;
  };
  EXPECT_EQ(body("shape = \"circle\", diameter = 0.3"), Outline(CircleOutline{0.15}));
  EXPECT_EQ(body("shape = \"square\", side = 0.2"), Outline(BoxOutline{0.2, 0.2}));
  EXPECT_EQ(body("shape = \"box\", length = 0.3, width = 0.2"), Outline(BoxOutline{0.3, 0.2}));
  EXPECT_THAT(complaints("", "robot = { shape = \"circle\", diameter = 9 }\n"),
              ElementsAre(HasSubstr("`diameter` must be from 0.005 to 5")));
  EXPECT_THAT(complaints("", "robot = { shape = \"circle\", diameter = 0.01 }\n"),
              ElementsAre(HasSubstr("more than its own width of 0.01 m")));
  EXPECT_THAT(
      complaints("", "robot = { shape = \"polygon\", corners = [[0, 0], [1, 0], [0, 1]] }\n"),
      ElementsAre(HasSubstr("cannot be a robot's body: its centre of mass is [0.333333, ")));
  EXPECT_THAT(complaints("", "robot = 3\n"),
              ElementsAre(HasSubstr("`robot` must be a robot's name or file in quotes, such as "
                                    "\"epuck\", or a table; this is an integer")));
}

TEST(Robots, HaveTheSameSizesWithABodyAsWithAnOutline) {
  const MissionEntry entry{
      read("", "robot = { body = { shape = \"circle\", diameter = 0.018 } }\n")};
  EXPECT_EQ(value_of(parse_mission(mission_text(entry), "x.toml")), entry);
}

// Box2D takes a contact's friction from those of the two surfaces, and 0 times any number is 0.
TEST(Robots, ThatSlideOnEachOtherAloneAreDiscsWithoutObjects) {
  const auto robot = [](const std::string& outline, const std::string& friction) {
    return "robots = 1\nrobot = { name = \"mine\", body = { " + outline +
           ", robot_friction = " + friction + ", wall_friction = 0.5 } }\n";
  };
  const std::string disc = "shape = \"circle\", diameter = 0.1";
  const std::string box = "shape = \"square\", side = 0.1";
  const std::string object =
      "objects = [ { shape = \"box\", x = 1, y = 0, length = 0.1, width = 0.1, mass = 1, friction "
      "= 1 } ]\n";
  const auto refused = ElementsAre(HasSubstr("`robot_friction` must be at least 0.000001"));
  EXPECT_THAT(complaints("", robot(disc, "0")), IsEmpty());
  EXPECT_THAT(complaints(object, robot(disc, "0")), refused);
  EXPECT_THAT(complaints("", robot(box, "0")), refused);
  EXPECT_THAT(complaints("", robot(box, "1e-60")), refused);
  EXPECT_THAT(complaints("", robot(box, "0.01")), IsEmpty());
}

}  // namespace
}  // namespace swarmsmith

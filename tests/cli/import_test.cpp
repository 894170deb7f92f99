#include <algorithm>

#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"

namespace swarmsmith::cli {
namespace {

/// Aggregation with five robots for ten seconds, as heads of exported files have it, and as a file.
const std::string kMission =
    "name = \"cave\"\npreset = \"aggregation\"\nrobots = 5\nduration = \"10 s\"\n";
const std::string kHead =
    "#: format = 1\n#: flavour = \"watermelon\"\n#: profile = \"argos3\"\n#: [[mission]]\n"
    "#: name = \"cave\"\n#: preset = \"aggregation\"\n#: robots = 5\n#: duration = \"10 s\"\n";

std::ptrdiff_t lines_in(const std::string& text) {
  return std::ranges::count(text, '\n');
}

class Import : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    write_file(folder_ / name, text);
    return (folder_ / name).string();
  }

  TemporaryFolder folder_;
  std::string store_ = (folder_ / "q.db").string();
};

/// Scores alone, without who has them.
std::vector<std::string> scores_in(const std::string& json_lines) {
  std::vector<std::string> scores;
  std::istringstream lines(json_lines);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("\"score\"");
    scores.push_back(line.substr(at, line.find_first_of(",}", at) - at));
  }
  return scores;
}

TEST_F(Import, KeepsTheWholeMissionAndProfileOfAHead) {
  const std::string machines = file("m.fsm", kHead + kExploreText + "\n");
  const Ran imported = run_well({"import", machines, "--into", store_});
  const Ran direct = run_well({"evaluate", machines, "--seeds", "1-3", "--json"});
  const Ran stored =
      run_well({"evaluate", "best", store_, "--seeds", "1-3", "--json", "--no-store"});
  EXPECT_EQ(scores_in(stored.out), scores_in(direct.out));
  EXPECT_THAT(stored.out, HasSubstr("argos3"));
  // What is exported again says it, too.
  const Ran exported = run_well({"export", store_, "--design", "d1"});
  EXPECT_THAT(exported.out, AllOf(HasSubstr("#: robots = 5\n"), HasSubstr("\"argos3\"")));
}

TEST_F(Import, TakesAMissionFile) {
  const std::string mission = file("cave.toml", "format = 1\n" + kMission);
  const std::string machines = file("m.txt", "a " + kExploreText + "\nb " + kStopText + "\n");
  const Ran all =
      run({"import", machines, "--flavour", "watermelon", "--mission", mission, "--into", store_});
  ASSERT_EQ(all.code, 0) << all.err;
  const std::string table = file("m.csv", "mission,fsm\nhole," + kExploreText + "\n");
  const Ran one = run_well({"import", table, "--flavour", "watermelon", "--mission",
                            "hole=" + mission, "--into", store_});
  const Ran direct = run({"evaluate", machines, "--flavour", "watermelon", "--mission", mission,
                          "--seeds", "7", "--json"});
  const Ran stored = run_well({"evaluate", "best", store_, "--seeds", "7", "--json"});
  auto wanted = scores_in(direct.out);
  wanted.push_back(wanted.front());
  EXPECT_EQ(scores_in(stored.out), wanted);
  EXPECT_THAT(refusal({"import", machines, "--flavour", "watermelon", "--mission",
                       (folder_ / "none.toml").string(), "--into", store_}),
              HasSubstr("none.toml"));
}

TEST_F(Import, SaysThatTheStoreHasAnotherMissionOfThisName) {
  write_store(store_);  // of the built-in aggregation
  const auto imported = [&](const std::string& robots) {
    const std::string head =
        "#: format = 1\n#: flavour = \"watermelon\"\n#: [[mission]]\n"
        "#: name = \"aggregation\"\n#: preset = \"aggregation\"\n" +
        robots;
    return run({"import", file("m.fsm", head + kExploreText + "\n"), "--into", store_});
  };
  EXPECT_EQ(imported("").err, "");
  const Ran other = imported("#: robots = 7\n");
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("d1 of the store has another mission aggregation"));
}

TEST_F(Import, RefusesMachinesBehindOptionsOfAnotherProgram) {
  const std::string machines =
      file("ho.txt", " --robots 22 --rabsi 2 --rabar 0.7 " + kStopText + "\n");
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"import", machines, "--flavour", "chocolate", "--mission", "aggregation", "--into",
            store_},
           {"evaluate", machines, "--flavour", "chocolate", "--mission", "aggregation"},
           {"evaluate", "--robots 22 --rabsi 2 --rabar 0.7 " + kStopText, "--flavour", "chocolate",
            "--mission", "aggregation"}}) {
    EXPECT_THAT(refusal(words), HasSubstr("`--robots`, `--rabsi`, `--rabar`"));
  }
  EXPECT_FALSE(std::filesystem::exists(store_));
  EXPECT_THAT(refusal({"evaluate", "--robots", "22", "--nstates", "1", "--s0", "1", "--flavour",
                       "chocolate", "--mission", "aggregation"}),
              HasSubstr("--robots"));
}

TEST_F(Import, ReadsGenomesAndTreesOfTheOlderForm) {
  std::string genome = "/*Fitness: 8.5*/\ngenomestart 1\n";
  for (int i = 1; i <= 17; ++i)
    genome += "node " + std::to_string(i) + (i <= 15 ? " 0 1 " : " 0 0 ") +
              (i < 15    ? "1"
               : i == 15 ? "3"
                         : "2") +
              "\n";
  for (int i = 0; i < 30; ++i)
    genome += "gene 0 " + std::to_string(i % 15 + 1) + (i < 15 ? " 16 " : " 17 ") + "0.5 0 0 1 1\n";
  genome += "genomeend 1\n";
  const std::string gen = file("gen_0", genome);
  const Ran scored = run_well({"evaluate", gen, "--flavour", "chocolate", "--mission",
                               "aggregation", "--seeds", "1", "--json"});
  EXPECT_THAT(scored.err, HasSubstr("read neighbours and floor in other units"));
  std::string weights = "0.5";
  for (int i = 1; i < 30; ++i)
    weights += ",0.5";
  EXPECT_EQ(scores_in(run({"evaluate", "--network", "rm1.2", "--weights", weights, "--flavour",
                           "chocolate", "--mission", "aggregation", "--seeds", "1", "--json"})
                          .out),
            scores_in(scored.out));
  ASSERT_EQ(
      run({"import", gen, "--flavour", "chocolate", "--mission", "aggregation", "--into", store_})
          .code,
      0);
  EXPECT_THAT(run({"show", "c1", store_}).out, HasSubstr("--network rm1.2 --weights 0.5,"));

  // The programs of genomes with the inputs rm1.1 have our units.
  std::string single = "genomestart 1\n";
  for (int i = 1; i <= 27; ++i)
    single += "node " + std::to_string(i) + (i <= 25 ? " 0 1 " : " 0 0 ") +
              (i < 25    ? "1"
               : i == 25 ? "3"
                         : "2") +
              "\n";
  single += "gene 0 1 26 0.5 0 0 1 1\ngenomeend 1\n";
  const Ran of_epucks =
      run_well({"evaluate", file("gen_2", single), "--flavour", "chocolate-epuck", "--mission",
                SWARMSMITH_SOURCE_DIR "/examples/missions/epuck/rt-aac.toml", "--seeds", "1"});
  EXPECT_THAT(of_epucks.err, Not(HasSubstr("other units")));

  // A refusal is one line.
  std::string evolved = genome;
  evolved.insert(evolved.find("gene 0"), "node 19 0 0 0\n");
  const std::string refused = refusal(
      {"evaluate", file("gen_1", evolved), "--flavour", "chocolate", "--mission", "aggregation"});
  EXPECT_THAT(refused, HasSubstr("a genome of NEAT with 1 hidden node"));
  EXPECT_EQ(lines_in(refused), 1) << refused;

  const std::vector<std::string> old = {"--rootnode", "0", "--nchildsroot", "1", "--n0",   "0",
                                        "--nc0",      "1", "--c0x0",        "0", "--p0x0", "0.5",
                                        "--a0",       "1"};
  std::vector<std::string> words = {"evaluate"};
  words.insert(words.end(), old.begin(), old.end());
  for (const char* word : {"--flavour", "chocolate", "--mission", "aggregation", "--seeds", "1"})
    words.emplace_back(word);
  const Ran tree = run_well(words);
  std::string text;
  for (const std::string& word : old)
    text += word + " ";
  const std::string trees = file("bt.txt", " " + text + "\n");
  ASSERT_EQ(
      run({"import", trees, "--flavour", "chocolate", "--mission", "aggregation", "--into", store_})
          .code,
      0);
  const Ran modules =
      run({"query", "SELECT module, occurrences FROM v_modules ORDER BY module", store_, "--csv"});
  EXPECT_EQ(modules.out, "module,occurrences\nblack_floor,1\nstop,1\n");
  EXPECT_EQ(run({"figure", "machine", store_, "--candidate", "c1000001", "-o",
                 (folder_ / "t.svg").string()})
                .code,
            0);
}

TEST_F(Import, RefusesOptionsThatTheFilesContentsDoNotUse) {
  const std::string machines = file("m.fsm", kStopText + "\n");
  const std::string scores = file("s.csv", "design,seed,score\n1,3,2\n");
  write_store((folder_ / "demo.db").string());
  for (const auto& [words, what] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{machines, "--flavour", "watermelon", "--source", "real"}, "machines"},
           {{machines, "--flavour", "watermelon", "--cost-of", "aggregation"}, "machines"},
           {{machines, "--flavour", "watermelon", "--replace"}, "machines"},
           {{folder_.path().string(), "--replace"}, "a log of irace"},
           {{scores, "--source", "real", "--flavour", "watermelon"}, "scores"},
           {{scores, "--source", "real", "--method", "m"}, "scores"},
           {{scores, "--source", "real", "--name", "n"}, "scores"}}) {
    std::vector<std::string> all{"import", "--mission", "aggregation", "--into",
                                 (folder_ / "demo.db").string()};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_THAT(refusal(all), HasSubstr(": it has no effect on " + what));
  }
}

TEST_F(Import, SaysOnceThatAFileIsOfAnotherKind) {
  const std::string mission = file("cave.toml", "format = 1\n" + kMission);
  const std::string picture = file("p.png", "\x89PNG\r\n\x1a\nnothing\nmore\n");
  write_store((folder_ / "demo.db").string());
  for (const std::string& wrong : {mission, picture}) {
    for (const auto& words : std::vector<std::vector<std::string>>{
             {"evaluate", wrong, "--flavour", "chocolate", "--mission", "aggregation"},
             {"import", wrong, "--flavour", "chocolate", "--into", store_}}) {
      const std::string said = refusal(words);
      EXPECT_THAT(said, AllOf(HasSubstr(wrong + ": this is a "), HasSubstr("; expected ")));
      EXPECT_LE(lines_in(said), 2) << said;
    }
  }
  EXPECT_THAT(refusal({"import", (folder_ / "demo.db").string(), "--flavour", "chocolate", "--into",
                       store_}),
              HasSubstr("this is a store"));
}

}  // namespace
}  // namespace swarmsmith::cli

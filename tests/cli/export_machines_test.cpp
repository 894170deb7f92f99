#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class ExportMachines : public WithStore {
 protected:
  std::string place(const std::string& name) const { return (folder_ / name).string(); }

  std::string text_of(const std::string& name) const { return whole_file(folder_ / name); }
};

TEST_F(ExportMachines, WritesOneToStandardOutput) {
  const Ran svg = run_well({"export", store_, "--format", "svg"});
  EXPECT_THAT(svg.out, StartsWith("<svg "));
  EXPECT_THAT(svg.out, HasSubstr("<title>d1 c1, aggregation, watermelon</title>"));
  EXPECT_THAT(svg.out, HasSubstr(">Exploration<"));
  EXPECT_THAT(svg.out, HasSubstr("width=\"84mm\""));
  EXPECT_THAT(run({"export", store_, "--format", "tikz"}).out, HasSubstr("\\begin{tikzpicture}"));
  EXPECT_THAT(run({"export", store_, "--format", "dot"}).out, StartsWith("digraph "));
}

TEST_F(ExportMachines, WritesSeveralIntoAFolder) {
  EXPECT_THAT(refusal({"export", store_, "--format", "svg", "--what", "all"}),
              HasSubstr("2 machines need as many files"));
  const Ran ran =
      run({"export", store_, "--format", "svg", "--what", "all", "-o", place("new/f"), "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(json::parse(ran.out)["files"],
            (json::array({place("new/f/d1-c1.svg"), place("new/f/d1-c2.svg")})));
  EXPECT_THAT(text_of("new/f/d1-c2.svg"), HasSubstr(">Stop<"));
  // One machine goes into a folder that is there, too.
  EXPECT_EQ(run({"export", store_, "--format", "tikz", "-o", place("new/f")}).code, 0);
  EXPECT_TRUE(fs::exists(place("new/f/d1-c1.tex")));
}

TEST_F(ExportMachines, TakesOneCandidateOrDesign) {
  EXPECT_THAT(run({"export", store_, "--format", "svg", "--candidate", "c2"}).out,
              HasSubstr(">Stop<"));
  EXPECT_THAT(run({"export", store_, "--candidate", "c2"}).out, HasSubstr("--s0 1"));
  EXPECT_EQ(run({"export", store_, "--format", "dot", "--design", "d1"}).code, 0);
  const Ran missing = run({"export", store_, "--format", "svg", "--candidate", "c9"});
  EXPECT_EQ(missing.code, 4);
  EXPECT_THAT(missing.err, HasSubstr("no candidate c9"));
  EXPECT_EQ(run({"export", store_, "--design", "d2"}).code, 4);
  EXPECT_EQ(run({"export", store_, "--design", "c2"}).code, 2);
}

TEST_F(ExportMachines, RefusesOptionsThatMeanNothing) {
  EXPECT_THAT(run({"export", store_, "--format", "svg", "--width", "9mm"}).err,
              HasSubstr("60mm to 1000mm"));
  EXPECT_EQ(run({"export", store_, "--format", "dot", "--width", "90mm"}).code, 2);
  EXPECT_EQ(run({"export", store_, "--format", "svg", "--seed", "3"}).code, 2);
  EXPECT_EQ(run({"export", store_, "--format", "argos", "--seed", "0"}).code, 2);
  EXPECT_THAT(run({"export", store_, "--format", "pdf"}).err, HasSubstr("-o FILE"));
  // Each of these wrote something else than was asked for.
  const std::string file = place("out");
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--what", "starts", "--format", "svg"},
            "--format: --what starts writes a table: leave --format out"},
           {{"--what", "patches", "--format", "json"},
            "--format: --what patches writes a table: leave --format out"},
           {{"--format", "irace", "--what", "all"},
            "--what: it has no effect with --format irace: the folder has all of a design"},
           {{"--format", "irace", "--candidate", "c2"},
            "--candidate: it has no effect with --format irace: the folder has all of a design"},
           {{"--format", "json", "--irace", "3.5"},
            "--irace: it has no effect with --format json"}}) {
    std::vector<std::string> all{"export", store_, "-o", file};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_THAT(refusal(all), HasSubstr(said));
    EXPECT_FALSE(fs::exists(file));
  }
}

TEST_F(ExportMachines, SaysWhichPackageMakesPdfs) {
  const char* path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", folder_.path().c_str(), 1);
  const Ran ran = run({"export", store_, "--format", "pdf", "-o", place("m.pdf")});
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("librsvg2-bin"));
  EXPECT_FALSE(fs::exists(place("m.pdf")));
}

TEST_F(ExportMachines, WritesAnExperimentOfTheOriginal) {
  const Ran ran = run_well({"export", store_, "--format", "argos", "--seed", "5"});
  EXPECT_THAT(ran.out, HasSubstr("fsm-config=\"--nstates 1 --s0 0 --rwm0 10\""));
  EXPECT_THAT(ran.out, HasSubstr("random_seed=\"5\""));
  EXPECT_THAT(ran.out, HasSubstr("d1 c1, aggregation, watermelon"));
  EXPECT_THAT(ran.err, HasSubstr("designed for the flavour watermelon;"));
}

}  // namespace
}  // namespace swarmsmith::cli

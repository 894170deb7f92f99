#include <filesystem>
#include <fstream>

#include "base/text/whole_file.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/scenario_file.h"
#include "irace_core/files/setup.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// The examples of Debian's package r-cran-irace, which is irace 3.5 (docs/irace-examples.md
/// says what they need). Their licence keeps them out of our tree: they are read where the package
/// is installed, in a folder that holds what the examples expect to be there.
class DebianExamples : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path package = "/usr/lib/R/site-library/irace";
    if (!fs::is_directory(package / "examples")) GTEST_SKIP() << "r-cran-irace is not installed";
    fs::copy(package / "examples", folder_ / "examples", fs::copy_options::recursive);
    fs::copy(package / "templates", folder_ / "templates", fs::copy_options::recursive);
  }

  void make_file(const std::string& name) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "\n";
  }

  /// As read in the example's folder.
  IraceSetupOrErrors read(const std::string& example, std::vector<std::string> words = {}) const {
    const fs::path folder = folder_ / ("examples/" + example);
    words.insert(words.end(), {"--scenario", "scenario.txt"});
    const auto line = read_irace_command_line(words, folder);
    EXPECT_TRUE(line);
    return read_irace_setup(*line, {folder, "/usr/bin:/bin"});
  }

  TemporaryFolder folder_;
};

TEST_F(DebianExamples, PythonTrivialReadsUnchanged) {
  const auto setup = value_of(read("target-runner-python/trivial"));
  EXPECT_THAT(setup.training, ElementsAre("instance1", "instance2"));
  EXPECT_EQ(setup.space.size(), 3U);
  EXPECT_EQ(setup.target_runner.filename(), "target-runner.py");
  EXPECT_THAT(setup.warnings, IsEmpty());
}

TEST_F(DebianExamples, AcotspReadsUnchangedWhereItsFoldersAre) {
  EXPECT_THAT(read("acotsp").error(), testing::SizeIs(2));
  make_file("examples/acotsp/Instances/1.tsp");
  fs::create_directories(folder_ / "examples/acotsp/acotsp-arena");
  const auto setup = value_of(read("acotsp"));
  EXPECT_EQ(setup.race.max_experiments, 5000);
  EXPECT_EQ(setup.space.size(), 11U);
  EXPECT_EQ(setup.space.digits(), 2);
  EXPECT_EQ(setup.space.forbidden().size(), 1U);
  // irace refuses its table of configurations, too: q0 has a value where it is inactive.
  EXPECT_THAT(read("acotsp", {"--configurations-file", "default.txt"}).error(),
              ElementsAre(testing::Field(&Error::message, HasSubstr("'q0': must be NA"))));
  EXPECT_THAT(setup.warnings,
              AllOf(Contains(HasSubstr("[global]")), Contains(HasSubstr("[forbidden]"))));
}

TEST_F(DebianExamples, SpearReadsUnchangedWhereItsInstancesAre) {
  make_file("examples/Spear/SWV-scrambled-first302/a.cnf");
  make_file("examples/Spear/SWV-scrambled-last302/b.cnf");
  const auto setup = value_of(read("Spear"));
  EXPECT_EQ(setup.race.test_type, TestType::TTest);
  EXPECT_EQ(setup.space.size(), 26U);
  EXPECT_EQ(setup.test.size(), 1U);
  const auto mixed = value_of(read("Spear", {"--parameter-file", "parameters-mixed.txt"}));
  EXPECT_EQ(mixed.space.size(), 26U);
}

TEST_F(DebianExamples, MoacoReadsUnchangedWhereItsFoldersAre) {
  make_file("examples/moaco/Instances/kroAB.tsp");
  fs::create_directories(folder_ / "examples/moaco/execdir");
  const auto setup = value_of(read("moaco"));
  EXPECT_TRUE(setup.race.target_evaluator);
  EXPECT_EQ(setup.space.size(), 16U);
  EXPECT_THAT(setup.warnings, Contains(HasSubstr("'||' is read as '|'")));
}

TEST_F(DebianExamples, TheParameterTemplateReadsUnchanged) {
  fs::copy_file(folder_ / "templates/parameters.txt.tmpl",
                folder_ / "examples/target-runner-python/trivial/template.txt");
  const auto setup =
      value_of(read("target-runner-python/trivial", {"--parameter-file", "template.txt"}));
  EXPECT_EQ(setup.space.size(), 5U);
  EXPECT_THAT(setup.warnings, Contains(HasSubstr("'&&' is read as '&'")));
}

TEST_F(DebianExamples, MatlabNeedsRAndSaysSo) {
  EXPECT_THAT(why_not(read("matlab")).where, HasSubstr("scenario.txt:"));
}

TEST_F(DebianExamples, TheScenarioTemplateReadsWithEveryOptionAsAComment) {
  const auto text = value_of(read_whole_file(folder_ / "templates/scenario.txt.tmpl"));
  // Its options are lines of "## name = default": switched on, they must be ones that we know.
  std::string all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    const std::size_t name = line.find_first_not_of("# ");
    const std::size_t equals = line.find(" = ");
    if (equals != std::string::npos && line.find(' ', name) == equals) {
      all += line.substr(name) + "\n";
    }
    begin = end + 1;
  }
  const auto nothing = [](const std::string&) { return std::optional<std::string>(); };
  const auto scenario =
      parse_irace_scenario(all, folder_ / "scenario.txt", {read_whole_file, nothing});
  ASSERT_TRUE(scenario) << to_string(scenario.error().front()) << "\n" << all;
  EXPECT_GT(scenario->settings.all().size(), 40U);
}

}  // namespace
}  // namespace swarmsmith

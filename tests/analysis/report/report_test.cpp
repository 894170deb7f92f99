#include "analysis/report/report.h"

#include <fmt/format.h>
#include <regex>

#include "analysis/report/supplement.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/xml_check.h"

namespace swarmsmith {
namespace {

using testing::Field;

Expected<std::string> as_is(CandidateId candidate) {
  return to_string(candidate) + "\n";
}

/// Two designs whose names mean something in HTML, which only an import could bring.
SyntheticCampaign hostile_campaign() {
  SyntheticCampaign campaign = synthetic_campaign({.designs = 2, .iterations = 3});
  campaign.campaign.name = "<script>alert(1)</script> & \"co\"";
  campaign.campaign.deciding = R"({"mission.<i>m</i>.duration":"\"120 s\"","race.mu":"5"})";
  for (DesignRow& design : campaign.designs) {
    design.mission = "<i>m</i>";
    design.method = "it's \"<x>\"";
  }
  return campaign;
}

std::unique_ptr<StoreReader> stored(const std::filesystem::path& path,
                                    const SyntheticCampaign& campaign) {
  fill_store(path, campaign);
  return open_reader(path);
}

struct ReportTest : FilledStore {
  ReportTest() : FilledStore(hostile_campaign()) {}

  std::string report(const ReportOptions& options = {.program = "swarmsmith <test>"}) {
    return value_of(html_report(*reader, options));
  }
};

TEST_F(ReportTest, IsWellFormedWithEveryNameEscaped) {
  const std::string text = report();
  EXPECT_EQ(xml_trouble(text), "");
  EXPECT_THAT(text, Not(HasSubstr("<script")));
  EXPECT_THAT(text, Not(HasSubstr("<i>")));
  EXPECT_THAT(text, Not(HasSubstr("<x>")));
  EXPECT_THAT(text, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;co&quot;"));
  EXPECT_THAT(text, HasSubstr("&lt;i&gt;m&lt;/i&gt;"));
  EXPECT_THAT(text, HasSubstr("swarmsmith &lt;test&gt;"));
}

TEST_F(ReportTest, AsksNoServer) {
  const std::string text = report();
  const std::regex attribute(R"re(\s(src|srcset|href|action|poster|data|background)="([^"]*)")re");
  for (std::sregex_iterator it(text.begin(), text.end(), attribute), end; it != end; ++it) {
    const std::string target = (*it)[2];
    EXPECT_TRUE(target.starts_with("#") || target.starts_with("data:")) << target;
  }
  EXPECT_THAT(text, Not(HasSubstr("@import")));
  EXPECT_THAT(text, Not(HasSubstr("url(")));
  EXPECT_FALSE(std::regex_search(text, std::regex("<[^>]* on[a-z]+=\"")));
}

TEST_F(ReportTest, ListsWhatItsContentsPromise) {
  const std::string text = report();
  const std::regex link("<a href=\"#(p[0-9]+)\">");
  std::size_t links = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it, ++links)
    EXPECT_THAT(text, HasSubstr(" id=\"" + (*it)[1].str() + "\""));
  EXPECT_GT(links, 5U);
  for (const char* part : {"Result", "Scores", "The winners, drawn", "Races", "What was asked",
                           "Design d1:", "Design d2:", "The race of d1", "Parameters of d1",
                           "Where it comes from", "All settings"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, HasSubstr(reader->digest()));
}

TEST_F(ReportTest, BeginsWithTheResultAndEndsWithSettingsFoldedAway) {
  const std::string text = report();
  std::size_t at = 0;
  for (const char* part : {"Question: which machines", ">Result<", "<title>Scores", " scored ",
                           "The same for LaTeX", ">Scores<", ">Races<", "<details>"}) {
    const std::size_t next = text.find(part, at);
    ASSERT_NE(next, std::string::npos) << part;
    at = next;
  }
  const std::string_view folded = std::string_view(text).substr(text.find("<details>\n"));
  for (const char* part : {"What was asked", "All settings", "Where it comes from"})
    EXPECT_THAT(folded, HasSubstr(part));
}

TEST_F(ReportTest, DrawsRunsWhereItIsGivenThem) {
  const std::string text = report({.runs_from_above = [](DesignId design) -> Expected<std::string> {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"><title>runs of " + to_string(design) +
           "</title></svg>";
  }});
  EXPECT_THAT(text, HasSubstr("<title>runs of d"));
  EXPECT_EQ(xml_trouble(text), "");
}

TEST_F(ReportTest, ManyDesignsHaveChaptersWhenTheyAreAsked) {
  const auto many = stored(folder / "many.db", synthetic_campaign({.designs = 4, .iterations = 2}));
  EXPECT_THAT(html_report(*many, {}).value_or(""), Not(HasSubstr("Design d1:")));
  const std::string all = html_report(*many, {.all_designs = true}).value_or("");
  EXPECT_THAT(all, HasSubstr("Design d1:"));
  EXPECT_THAT(all, HasSubstr("Design d4:"));
}

TEST_F(ReportTest, TellsHowFarItIs) {
  std::vector<std::size_t> told;
  report({.progress = [&](std::size_t parts) { told.push_back(parts); }});
  EXPECT_GT(told.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(told));
}

TEST_F(ReportTest, DrawsEachKindThatTheStoreHasSomethingOf) {
  EXPECT_THAT(report(), HasSubstr("<title>Convergence"));
}

TEST_F(ReportTest, IsTheSameEachTime) {
  EXPECT_EQ(report(), report());
}

TEST_F(ReportTest, GivesChaptersToTheDesignsThatAreNamed) {
  const std::string text = report({.designs = {DesignId{2}}});
  EXPECT_THAT(text, Not(HasSubstr("Design d1:")));
  EXPECT_THAT(text, HasSubstr("Design d2:"));
  const Error unknown = why_not(html_report(*reader, {.designs = {DesignId{9}}}));
  EXPECT_EQ(unknown.kind, ErrorKind::NotFound);
  EXPECT_THAT(unknown.message, HasSubstr("d9"));
}

TEST(Report, OfACampaignThatHasJustBegunSaysSo) {
  const TemporaryFolder folder;
  SyntheticCampaign campaign = hostile_campaign();
  campaign.batches.clear();
  const auto reader = stored(folder / "s.db", campaign);
  const auto text = value_of(html_report(*reader, {}));
  EXPECT_EQ(xml_trouble(text), "");
  EXPECT_THAT(text, HasSubstr("No winner was evaluated outside of its race yet."));
  EXPECT_EQ(why_not(supplement(*reader, {.machine_file = as_is})).kind, ErrorKind::NotFound);
}

std::vector<std::string> paths_of(const std::vector<SupplementFile>& files) {
  std::vector<std::string> paths;
  for (const SupplementFile& file : files)
    paths.push_back(file.path);
  return paths;
}

TEST_F(ReportTest, ASupplementHasSafeNamesInOrder) {
  const auto files =
      value_of(supplement(*reader, {.machine_file = as_is, .program = "p", .with_pdfs = true}));
  const std::vector<std::string> paths = paths_of(files);
  EXPECT_TRUE(std::ranges::is_sorted(paths));
  EXPECT_EQ(std::ranges::adjacent_find(paths), paths.end());
  const std::regex safe("[A-Za-z0-9._-]+(/[A-Za-z0-9._-]+)?");
  for (const std::string& path : paths)
    EXPECT_TRUE(std::regex_match(path, safe)) << path;
  EXPECT_THAT(paths, Contains("controllers/d1-_i_m__i_-it_s___x__-1.txt"));
  EXPECT_THAT(paths, Contains("results.csv"));
  EXPECT_THAT(paths, Contains("report.html"));
  EXPECT_THAT(paths, Contains("designs/d1-_i_m__i_-it_s___x__-1.html"));
  const auto page = std::ranges::find(files, "report.html", &SupplementFile::path)->text;
  EXPECT_THAT(page, HasSubstr("<a href=\"designs/d1-_i_m__i_-it_s___x__-1.html\">d1</a>"));
  EXPECT_THAT(paths, Contains("figures/convergence.csv"));
  // Each figure of one design is there for each of the two.
  for (const std::string_view kind : {"race", "sampling", "parallel", "importance"}) {
    EXPECT_EQ(std::ranges::count_if(paths,
                                    [&](const std::string& path) {
                                      return path.starts_with(fmt::format("figures/{}-d", kind)) &&
                                             path.ends_with(".svg");
                                    }),
              2)
        << kind << " " << testing::PrintToString(paths);
  }
  const auto again =
      supplement(*reader, {.machine_file = as_is, .program = "p", .with_pdfs = true});
  for (std::size_t i = 0; i < files.size(); ++i)
    EXPECT_EQ(files[i].text, (*again)[i].text) << paths[i];
}

TEST_F(ReportTest, ASupplementSaysWhatAnotherRunDoesNotRepeat) {
  SyntheticCampaign campaign = synthetic_campaign({.designs = 2});
  campaign.campaign.deciding = R"({"engine.version":"5"})";
  const auto readme_of = [&](const std::string& name) {
    const auto files = supplement(*stored(folder / name, campaign),
                                  {.machine_file = as_is, .program = "p 1", .with_pdfs = false});
    return std::ranges::find(*files, "README.md", &SupplementFile::path)->text;
  };
  const std::string as_it_ran = readme_of("plain.db");
  EXPECT_THAT(as_it_ran, HasSubstr("the engine that made the scores: 5."));
  EXPECT_THAT(as_it_ran, Not(HasSubstr("commands")));
  EXPECT_THAT(as_it_ran, Not(HasSubstr("swarmsmith evaluate"))) << "nothing was simulated";
  campaign.batches.push_back({CommandRow{.number = 1,
                                         .kind = CommandKind::Extend,
                                         .design = DesignId{2},
                                         .step = 7,
                                         .budget = 300},
                              CommandRow{.number = 2, .kind = CommandKind::Pause, .step = 1},
                              CommandRow{.number = 3, .kind = CommandKind::Cancel}});
  const std::string extended = readme_of("extended.db");
  EXPECT_THAT(extended, HasSubstr("a run without them gives other races and scores:\n\n"
                                  "- `extend` d2 by 300 experiments, after step 7 of the race\n"));
  EXPECT_THAT(extended, Not(HasSubstr("cancel"))) << "it never took effect";
  campaign.batches.push_back({CampaignStateRow{"stopped"}});
  EXPECT_THAT(readme_of("stopped.db"), HasSubstr("was not finished when this supplement was written"
                                                 " (stopped)"));
}

TEST_F(ReportTest, ASupplementSaysWhatItsFilesAre) {
  const auto with =
      supplement(*reader, {.machine_file = as_is, .program = "p 1", .with_pdfs = true});
  const auto without =
      supplement(*reader, {.machine_file = as_is, .program = "p 1", .with_pdfs = false});
  ASSERT_TRUE(with && without);
  const auto readme_of = [](const auto& files) {
    return std::ranges::find(files, "README.md", &SupplementFile::path)->text;
  };
  EXPECT_THAT(readme_of(*with), HasSubstr("`figures/*.pdf`"));
  EXPECT_THAT(readme_of(*without), Not(HasSubstr(".pdf")));
  EXPECT_THAT(readme_of(*with), HasSubstr("`" + reader->digest() + "`"));
  const auto results = std::ranges::find(*with, "results.csv", &SupplementFile::path)->text;
  EXPECT_EQ(std::ranges::count(results, '\n'), 1 + 2 * 4);
  EXPECT_THAT(results, HasSubstr("\"it's \"\"<x>\"\"\""));
}

}  // namespace
}  // namespace swarmsmith

#include "coordinator/service/metrics_text.h"
#include "tests/support/not_empty.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace swarmsmith {
namespace {

/// A sample: name, labels as written, value.
struct Sample {
  std::string name;
  std::string labels;
  double value = 0;
};

/// What a scraper makes of the text; complains about what none would take.
struct Exposition {
  std::map<std::string, std::string> types;
  std::vector<Sample> samples;
  std::vector<std::string> complaints;

  explicit Exposition(const std::string& text) {
    static const std::regex kType(R"(# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge|histogram))");
    static const std::regex kHelp(R"(# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) \S.*)");
    static const std::regex kSample(
        R"re(([a-zA-Z_:][a-zA-Z0-9_:]*)(\{([a-zA-Z_]\w*="([^"\\]|\\["\\n])*",?)+\})? (\S+))re");
    std::istringstream in(text);
    std::string current;
    std::smatch match;
    if (text.empty() || text.back() != '\n') complaints.push_back("no line end at the end");
    for (std::string line; std::getline(in, line);) {
      if (std::regex_match(line, match, kHelp)) continue;
      if (std::regex_match(line, match, kType)) {
        current = match[1];
        if (!types.emplace(current, match[2]).second) complaints.push_back("twice: " + line);
      } else if (std::regex_match(line, match, kSample)) {
        const std::string name = match[1];
        const std::string rest = name.starts_with(current) ? name.substr(current.size()) : "?";
        const bool fits = types[current] == "histogram"
                              ? rest == "_bucket" || rest == "_sum" || rest == "_count"
                              : rest.empty();
        if (!fits) complaints.push_back("sample outside of its metric: " + line);
        samples.push_back({name, match[2], std::stod(match[5])});
      } else {
        complaints.push_back("no line of the format: " + line);
      }
    }
  }

  double value(const std::string& name, const std::string& labels = "") const {
    for (const Sample& sample : samples) {
      if (sample.name == name && sample.labels == labels) return sample.value;
    }
    ADD_FAILURE() << "no sample " << name << labels;
    return -1;
  }
};

LiveStatus busy_status() {
  LiveStatus status;
  status.workers = 3;
  status.malformed_by = {{"header", 2}};
  status.over_budget = {{"hello", 7}};
  status.refused = {{"unlisted key", 5}};
  CampaignStatus campaign;
  campaign.name = "a \"b\"\\\n";
  campaign.designs = {{.id = {1}, .state = DesignState::Racing, .used = 10, .budget = 100}};
  campaign.meters.timed_out = 4;
  campaign.meters.evaluation.observe(0.002);
  campaign.meters.evaluation.observe(5000.0);
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector<CampaignStatus>{campaign});
  return status;
}

TEST(MetricsText, IsWhatAScraperReads) {
  const Exposition page(metrics_text(busy_status()));
  EXPECT_THAT(page.complaints, ::testing::IsEmpty());
  EXPECT_EQ(page.value("swarmsmith_workers", "{state=\"connected\"}"), 3);
  EXPECT_EQ(page.value("swarmsmith_malformed_total", "{reason=\"header\"}"), 2);
  EXPECT_EQ(page.value("swarmsmith_over_budget_total", "{reason=\"hello\"}"), 7);
  EXPECT_EQ(page.value("swarmsmith_refused_total", "{reason=\"unlisted key\"}"), 5);
  const std::string name = R"(campaign="a \"b\"\\\n")";
  EXPECT_EQ(page.value("swarmsmith_failed_total", "{" + name + ",reason=\"timed out\"}"), 4);
  EXPECT_EQ(page.value("swarmsmith_design_used", "{" + name + ",design=\"d1\"}"), 10);
  EXPECT_EQ(page.value("swarmsmith_evaluation_seconds_bucket", "{" + name + ",le=\"0.001\"}"), 0);
  EXPECT_EQ(page.value("swarmsmith_evaluation_seconds_bucket", "{" + name + ",le=\"0.003\"}"), 1);
  EXPECT_EQ(page.value("swarmsmith_evaluation_seconds_bucket", "{" + name + ",le=\"1000\"}"), 1);
  EXPECT_EQ(page.value("swarmsmith_evaluation_seconds_bucket", "{" + name + ",le=\"+Inf\"}"), 2);
  EXPECT_EQ(page.value("swarmsmith_evaluation_seconds_count", "{" + name + "}"), 2);
}

TEST(MetricsText, CountersEndInTotalAndNothingElseDoes) {
  const Exposition page(metrics_text(busy_status()));
  for (const auto& [name, type] : not_empty(page.types))
    EXPECT_EQ(type == "counter", name.ends_with("_total")) << name;
}

TEST(MetricsText, SaysTheSameBeforeAnythingIsKnown) {
  const Exposition page(metrics_text(LiveStatus{}));
  EXPECT_THAT(page.complaints, ::testing::IsEmpty());
  EXPECT_EQ(page.types.size(), metric_names().size());
}

TEST(MetricsText, HasTheMetricsOfThePageAndNoOthers) {
  const std::string text = whole_file(SWARMSMITH_SOURCE_DIR "/docs/observability.md");
  static const std::regex kRow(R"(\n\| `(swarmsmith_[a-z_]+)` \|)");
  std::set<std::string> documented;
  for (std::sregex_iterator at(text.begin(), text.end(), kRow), end; at != end; ++at)
    documented.insert((*at)[1]);
  const std::vector<std::string> names = metric_names();
  EXPECT_EQ(documented, std::set<std::string>(names.begin(), names.end()));
}

}  // namespace
}  // namespace swarmsmith

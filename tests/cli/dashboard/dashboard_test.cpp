#include "cli/dashboard/dashboard.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <latch>
#include <mutex>
#include <thread>

#include "base/text/gzip.h"
#include "cli/dashboard/live_answers.h"
#include "cli/run/dashboard_setup.h"
#include "coordinator/service/http_address.h"
#include "coordinator/service/http_server.h"
#include "tests/cli/dashboard/asking.h"
#include "tests/support/checks.h"
#include "tests/support/http_peer.h"
#include "web/pages.h"

namespace swarmsmith::cli {
namespace {

using nlohmann::json;

const std::string kToken = "0123456789abcdef0123456789abcdef";
const std::string kBearer = "Authorization: Bearer " + kToken + "\r\n";

std::string body_of(const std::string& answer) {
  return answer.substr(answer.find("\r\n\r\n") + 4);
}

std::string header_of(const std::string& answer, const std::string& name) {
  const std::size_t at = answer.find("\r\n" + name + ": ");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 4;
  return answer.substr(from, answer.find("\r\n", from) - from);
}

/// A dashboard behind a real socket.
class DashboardTest : public WithStore {
 protected:
  void serve(HttpOptions options = {}) {
    DashboardOptions dashboard{.stores = {{store_, 0}}};
    dashboard.program = SWARMSMITH_BIN_DIR "/swarmsmith";
    dashboard.version = "swarmsmith test";
    dashboard.patience = patience_;
    dashboard.act = [this](const std::filesystem::path&, const CommandRow& command) {
      commands_.push_back(command);
      return Expected<std::string>("done");
    };
    site_ = make_dashboard(std::move(dashboard));
    if (options.address.host.empty()) options.address = {"127.0.0.1", 0};
    options.site = site_;
    if (options.token.empty()) options.act_token = kToken;
    options.has_loop = false;
    server_ = HttpServer::start(std::move(options)).value();
    const std::string address = server_->address();
    port_ = std::stoi(address.substr(address.rfind(':') + 1));
  }

  std::string get(const std::string& path, const std::string& headers = "") const {
    return http_answer(port_, "GET", path, headers);
  }
  std::string post(const std::string& path, const std::string& headers = "") const {
    return http_answer(port_, "POST", path, headers);
  }

  std::shared_ptr<HttpSite> site_;
  std::unique_ptr<HttpServer> server_;
  std::vector<CommandRow> commands_;
  /// Of a loaded machine, too, answers are wanted.
  std::chrono::milliseconds patience_ = std::chrono::hours(1);
  int port_ = 0;
};

TEST_F(DashboardTest, WhatTakesLongIsToldAndFetchedFromTheSameAddress) {
  patience_ = std::chrono::milliseconds(0);
  serve();
  int told = 0;
  // Each width is another question.
  for (int width = 60; width < 80; ++width) {
    const std::string path =
        "/api/v1/c1/figures/convergence.csv?width=" + std::to_string(width) + "mm";
    std::string answer = get(path);
    while (answer.starts_with("HTTP/1.1 202")) {
      ++told;
      EXPECT_EQ(header_of(answer, "Location"), path);
      EXPECT_EQ(header_of(answer, "Retry-After"), "1");
      const json pending = json::parse(body_of(answer))["pending"];
      EXPECT_EQ(pending["place"], path);
      EXPECT_TRUE(pending["seconds"].is_number());
      EXPECT_TRUE(pending["state"] == "computing" || pending["state"] == "waiting");
      answer = get(path);
    }
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200")) << answer;
    EXPECT_THAT(body_of(answer), HasSubstr("design")) << answer;
  }
  EXPECT_GT(told, 0);
  // What is wrong with a question is said in the same way.
  std::string wrong = get("/api/v1/c1/designs/d77/race");
  while (wrong.starts_with("HTTP/1.1 202"))
    wrong = get("/api/v1/c1/designs/d77/race");
  EXPECT_THAT(wrong, StartsWith("HTTP/1.1 404"));
}

TEST_F(DashboardTest, PagesComeWithTheirPolicies) {
  serve();
  if (page_files().empty()) {
    EXPECT_THAT(get("/"), HasSubstr("built without its pages"));
    GTEST_SKIP() << "built without pages (SWARMSMITH_DASHBOARD)";
  }
  for (const PageFile& file : page_files()) {
    const std::string answer = get(std::string(file.path), "Accept-Encoding: gzip, br\r\n");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200")) << file.path;
    EXPECT_EQ(header_of(answer, "Content-Type"), file.type);
    EXPECT_EQ(header_of(answer, "Content-Encoding"), "gzip");
    EXPECT_EQ(body_of(answer), file.packed);
    EXPECT_THAT(header_of(answer, "Content-Security-Policy"),
                StartsWith("default-src 'none'; script-src 'self'; style-src 'self'"));
    EXPECT_EQ(header_of(answer, "X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(header_of(answer, "Referrer-Policy"), "no-referrer");
    EXPECT_EQ(header_of(answer, "Cross-Origin-Resource-Policy"), "same-origin");
    EXPECT_EQ(header_of(answer, "Cache-Control"), "no-cache");
    EXPECT_EQ(header_of(answer, "Access-Control-Allow-Origin"), "");
    const std::string plain = get(std::string(file.path));
    EXPECT_EQ(header_of(plain, "Content-Encoding"), "");
    EXPECT_EQ(body_of(plain), gunzip(file.packed, 1 << 24).value());
  }
}

TEST_F(DashboardTest, CodeAndStyleStaySmall) {
  if (page_files().empty()) GTEST_SKIP() << "built without pages (SWARMSMITH_DASHBOARD)";
  std::size_t code = 0;
  std::size_t packed = 0;
  std::size_t plain = 0;
  for (const PageFile& file : page_files()) {
    if (file.path.ends_with(".js")) code += file.packed.size();
    packed += file.packed.size();
    plain += gunzip(file.packed, 1 << 24).value().size();
  }
  EXPECT_LE(plain, 107'000U);
  EXPECT_GT(code, 0U);
  EXPECT_LE(code, 37'000U);
  EXPECT_LE(packed, 40'500U);
}

TEST_F(DashboardTest, NoPathIsAFile) {
  serve();
  for (const char* path : {"/../demo.db", "/demo.db", "/..%2fdemo.db", "/etc/passwd",
                           "/api/v1/c1/figures/..%2f..%2fx.svg", "/api/v1/../../etc/passwd",
                           "/api/v1/c1/runs/..%2f..%2fdemo.db/trajectory", "//", "/api/v2/live"}) {
    const std::string answer = get(path);
    EXPECT_THAT(answer, testing::ContainsRegex("^HTTP/1.1 40[04]")) << path << "\n" << answer;
    EXPECT_THAT(answer, Not(HasSubstr("SQLite format"))) << path;
  }
}

TEST_F(DashboardTest, AStatementIsNotCutAtAZeroByte) {
  serve();
  const std::string answer = get("/api/v1/c1/query?sql=SELECT%201%00%20FROM%20nothing");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(answer, HasSubstr("zero byte"));
  EXPECT_THAT(get("/api/v1/c1/scores?design=d1%00"), StartsWith("HTTP/1.1 400"));
}

TEST_F(DashboardTest, AnUnchangedAnswerIsNotSentAgain) {
  serve();
  const std::string path = "/api/v1/c1/designs/d1";
  const std::string first = get(path, "Accept-Encoding: gzip\r\n");
  const std::string etag = header_of(first, "ETag");
  ASSERT_FALSE(etag.empty());
  EXPECT_EQ(gunzip(body_of(first), 1 << 24).value(), body_of(get(path)));
  EXPECT_THAT(header_of(first, "Server-Timing"), StartsWith("total;dur="));
  const std::string again = get(path, "If-None-Match: " + etag + "\r\n");
  EXPECT_THAT(again, StartsWith("HTTP/1.1 304"));
  EXPECT_EQ(body_of(again), "");
  EXPECT_THAT(get(path, "If-None-Match: \"other\"\r\n"), StartsWith("HTTP/1.1 200"));
}

TEST_F(DashboardTest, LiveTellsWhatIsThere) {
  serve();
  const json rest = json::parse(body_of(get("/api/v1/live")));
  EXPECT_EQ(rest["v"], 1);
  EXPECT_EQ(rest["running"], false);
  EXPECT_TRUE(rest["status"].is_null());
  EXPECT_EQ(rest["may_act"], true);
  EXPECT_EQ(rest["pid"], getpid());
  const json& campaign = rest["campaigns"][0];
  EXPECT_EQ(campaign["c"], "c1");
  EXPECT_EQ(campaign["name"], "demo");
  EXPECT_EQ(campaign["state"], "finished");
  EXPECT_EQ(campaign["digest"], StoreReader::open(store_).value()->campaign().digest);
  const json& design = campaign["designs"][0];
  EXPECT_EQ(design["id"], "d1");
  EXPECT_EQ(design["best"], "c1");
  EXPECT_EQ(design["best_mean"], 2.5);
  EXPECT_EQ(design["test_mean"], 3);
  EXPECT_EQ(design["test_runs"], 1);
  EXPECT_EQ(design["paused"], false);
  EXPECT_EQ(design["used"], 2);
  EXPECT_GT(design["version"], 0);
  EXPECT_EQ(rest["looks"], json::array());
}

TEST_F(DashboardTest, LiveNumbersAreThoseOfTheLoop) {
  serve();
  LiveStatus status;
  status.workers = 3;
  status.used_per_s = 10;
  CampaignStatus campaign{.name = "demo"};
  campaign.designs.push_back({.id = DesignId{1},
                              .state = DesignState::Racing,
                              .used = 500,
                              .budget = 2000,
                              .iteration = 2,
                              .best = CandidateId{2},
                              .best_mean = 7,
                              .paused = true});
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector{std::move(campaign)});
  status.fleet = std::make_shared<const std::vector<WorkerStatus>>(
      std::vector<WorkerStatus>{{.number = 4, .state = "connected", .host = "lab7"}});
  site_->publish(status);
  const json live = json::parse(body_of(get("/api/v1/live")));
  EXPECT_EQ(live["running"], true);
  EXPECT_EQ(live["status"]["workers"], 3);
  EXPECT_FALSE(live["status"].contains("fleet"));
  EXPECT_EQ(live["campaigns"][0]["used"], 500);
  EXPECT_EQ(live["campaigns"][0]["eta_s"], 150);
  const json& design = live["campaigns"][0]["designs"][0];
  EXPECT_EQ(design["state"], "racing");
  EXPECT_EQ(design["best"], "c2");
  EXPECT_EQ(design["best_mean"], 7);
  EXPECT_TRUE(design["test_mean"].is_null());
  EXPECT_EQ(design["paused"], true);
  const json workers = json::parse(body_of(get("/api/v1/workers")));
  EXPECT_EQ(workers["workers"][0]["host"], "lab7");
  const json history = json::parse(body_of(get("/api/v1/history")));
  EXPECT_EQ(history["t_s"].size(), 1U);
  EXPECT_EQ(history["slots"].size(), 1U);
  const json causes = json::parse(body_of(get("/api/v1/causes")))["causes"];
  EXPECT_EQ(causes.size(), kIdleCauses);
  for (const json& cause : causes) {
    EXPECT_TRUE(live["status"]["slot_times"]["idle_s"].contains(cause["name"])) << cause;
    EXPECT_NE(cause["why"], "");
    EXPECT_NE(cause["todo"], "");
  }
  EXPECT_TRUE(history.contains("start_up"));
}

TEST_F(DashboardTest, WhatNeedsALookIsSaidWithItsPage) {
  serve();
  LiveStatus status;
  status.conflicts = 1;
  status.lost_workers = 2;
  status.failed = 3;
  CampaignStatus campaign{.name = "demo", .trouble = "the disk is full"};
  campaign.designs.push_back({.id = DesignId{1}, .state = DesignState::Stopped});
  status.campaigns =
      std::make_shared<const std::vector<CampaignStatus>>(std::vector{std::move(campaign)});
  std::vector<std::pair<std::string, std::string>> found;
  for (const Look& look : looks_of(status))
    found.emplace_back(look.text, look.page);
  EXPECT_THAT(
      found,
      ElementsAre(
          std::pair("1 conflict: two results of one evaluation differ in their bits", "fleet"),
          std::pair("no worker is connected", "fleet"), std::pair("2 workers lost", "fleet"),
          std::pair("3 attempts failed", "c1")));
  site_->publish(status);
  const json looks = json::parse(body_of(get("/api/v1/live")))["looks"];
  ASSERT_EQ(looks.size(), 6U) << looks;
  EXPECT_THAT(looks[4]["text"].get<std::string>(), EndsWith(": the disk is full"));
  EXPECT_EQ(looks[4]["page"], "c1");
  EXPECT_EQ(looks[5], json({{"text", "d1 has stopped"}, {"page", "c1/d1"}}));
}

TEST_F(DashboardTest, MethodsAreAllowedByName) {
  serve();
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD"}) {
    const std::string answer = http_answer(port_, method, "/api/v1/live", kBearer);
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 405")) << method;
    EXPECT_EQ(header_of(answer, "Allow"), "GET");
  }
  for (const char* method : {"GET", "PUT", "DELETE", "HEAD"}) {
    const std::string answer = http_answer(port_, method, "/api/v1/c1/designs/d1/pause", kBearer);
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 405")) << method;
    EXPECT_EQ(header_of(answer, "Allow"), "POST");
  }
  EXPECT_TRUE(commands_.empty());
}

class DashboardSetupTest : public WithStore {
 protected:
  std::unique_ptr<DashboardSetup> setup(const CoordinatorArgument& coordinator = {}) const {
    DashboardOptions options{.stores = {{store_, 0}, {second_}}};
    options.program = SWARMSMITH_BIN_DIR "/swarmsmith";
    return DashboardSetup::make(std::move(options), coordinator, DashboardSetup::Secret::New);
  }

  std::filesystem::path second_ = folder_ / "second.db";
};

TEST_F(DashboardSetupTest, RemovesItsOwnTokenAndNotThatOfALaterRun) {
  const std::filesystem::path file = token_file_of(store_);
  setup().reset();
  EXPECT_FALSE(std::filesystem::exists(file));
  auto first = setup();
  const auto later = setup();
  first.reset();
  EXPECT_EQ(read_token(file).value_or("gone"), later->token());
}

TEST_F(DashboardSetupTest, ANamedCoordinatorIsThatOfTheFirstStoreAlone) {
  const Campaign campaign = one_design_campaign();
  ASSERT_TRUE(Store::open(second_, campaign_row(campaign), design_rows(campaign)));
  const auto at_wrong_place = setup({.coordinator = (folder_ / "none.coordinator").string()});
  const auto pause = [&](const std::string& store) {
    return at_wrong_place->site()->answer(
        {.acts = true, .path = "/api/v1/" + store + "/designs/d1/pause", .peer = "ann@lab"});
  };
  const SiteAnswer of_second = pause("c2");
  EXPECT_EQ(of_second.status, 200) << of_second.body;
  EXPECT_NE(pause("c1").status, 200);
}

TEST_F(DashboardTest, AnotherNameIsAnotherHost) {
  HttpOptions options;
  options.names = {"proxy.lab"};
  serve(std::move(options));
  for (const char* path : {"/", "/api/v1/live"}) {
    for (const char* host : {"evil.example", "127.0.0.1.evil.example", "proxy.lab.evil"}) {
      const std::string answer =
          HttpPeer(port_)
              .say("GET " + std::string(path) + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n")
              .hear();
      EXPECT_THAT(answer, StartsWith("HTTP/1.1 421")) << host;
    }
    EXPECT_THAT(HttpPeer(port_)
                    .say("GET " + std::string(path) + " HTTP/1.1\r\nHost: proxy.lab\r\n\r\n")
                    .hear(),
                StartsWith("HTTP/1.1 200"));
  }
}

TEST_F(DashboardTest, ActsNeedTheTokenAndAPageOfOurs) {
  serve();
  const std::string path = "/api/v1/c1/designs/d1/pause";
  EXPECT_THAT(post(path), StartsWith("HTTP/1.1 401"));
  EXPECT_EQ(json::parse(body_of(post(path)))["error"]["kind"], "no_token");
  EXPECT_THAT(post(path, "Authorization: Bearer " + kToken.substr(1) + "\r\n"),
              StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(post(path, "Cookie: token=" + kToken + "\r\n"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(post(path + "?token=" + kToken), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(post(path, kBearer + "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(post(path, kBearer + "Origin: null\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(post(path, kBearer + "Sec-Fetch-Site: cross-site\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(post(path, kBearer + "Sec-Fetch-Site: same-site\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_TRUE(commands_.empty());
  const std::string done =
      post(path, kBearer + "Origin: http://localhost\r\nSec-Fetch-Site: same-origin\r\n");
  EXPECT_THAT(done, StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(body_of(done), "{\"v\":1,\"command\":\"pause\",\"design\":\"d1\",\"done\":\"done\"}\n");
  ASSERT_EQ(commands_.size(), 1U);
  EXPECT_EQ(commands_[0].kind, CommandKind::Pause);
  EXPECT_EQ(commands_[0].design, DesignId{1});
  EXPECT_THAT(commands_[0].who, testing::MatchesRegex("dashboard .+@127\\.0\\.0\\.1"));
}

TEST_F(DashboardTest, ActsAreThoseOfTheCommandLine) {
  serve();
  EXPECT_THAT(post("/api/v1/c1/resume", kBearer), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(post("/api/v1/c1/designs/d1/cancel", kBearer), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(post("/api/v1/c1/designs/d1/extend?budget=5000", kBearer),
              StartsWith("HTTP/1.1 200"));
  ASSERT_EQ(commands_.size(), 3U);
  EXPECT_FALSE(commands_[0].design);
  EXPECT_EQ(commands_[1].kind, CommandKind::Cancel);
  EXPECT_EQ(commands_[2].budget, 5000);
  EXPECT_THAT(post("/api/v1/c1/designs/d1/extend", kBearer), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(post("/api/v1/c1/designs/d1/extend?budget=-3", kBearer), StartsWith("HTTP/1.1 400"));
  for (const char* path : {"/api/v1/c1/cancel", "/api/v1/c2/pause", "/api/v1/c1/designs/d1/explode",
                           "/api/v1/c1/designs/c1/pause"})
    EXPECT_THAT(post(path, kBearer), StartsWith("HTTP/1.1 405")) << path;
  EXPECT_EQ(commands_.size(), 3U);
}

TEST_F(DashboardTest, WithATokenOfOnesOwnPagesOpenAndNumbersDoNot) {
  HttpOptions options;
  options.token = kToken;
  serve(std::move(options));
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(get("/api/v1/live"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(get("/api/v1/c1/designs/d1"), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(get("/api/v1/live", kBearer), StartsWith("HTTP/1.1 200"));
}

TEST_F(DashboardTest, AnotherUserOfThisHostSeesNothing) {
  serve();
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to become another user";
  constexpr uid_t kNobody = 65534;
  const pid_t child = fork();
  if (child == 0) {
    if (setuid(kNobody) != 0) _exit(9);
    for (const char* path : {"/", "/api/v1/live", "/api/v1/c1"}) {
      const std::string answer = http_answer(port_, "GET", path, "");
      if (!answer.starts_with("HTTP/1.1 403")) _exit(1);
    }
    // Who has the secret may: it says more than a number of a user.
    _exit(http_answer(port_, "GET", "/api/v1/live", kBearer).starts_with("HTTP/1.1 200") ? 0 : 2);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(DashboardTest, ManySilentConnectionsKeepNoOtherWaiting) {
  serve();
  std::vector<HttpPeer> silent;
  for (int i = 0; i < 200; ++i)
    silent.emplace_back(port_).say("GET /api/v1/live HTT");
  EXPECT_THAT(get("/api/v1/live"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200"));
}

TEST_F(DashboardTest, MoreHeavyQuestionsThanFitAreTurnedAway) {
  // A statement is under way and four wait, for a moment: each is another question, so that nothing
  // is shared.
  serve();
  const std::string endless =
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n";
  std::vector<SiteRequest> requests;
  std::atomic<bool> gone = false;
  std::atomic<int> answered = 0;
  std::atomic<int> refused = 0;
  std::vector<std::jthread> askers;
  constexpr int kAskers = 9;
  for (int i = 0; i < kAskers; ++i) {
    askers.emplace_back([&, i] {
      SiteRequest request{.path = "/api/v1/c1/query"};
      request.parameters["sql"] = endless + " WHERE i <> " + std::to_string(-i);
      request.is_gone = [&] { return gone.load(); };
      const SiteAnswer answer = site_->answer(request);
      const bool busy =
          answer.body.find("too many answers are being computed") != std::string::npos;
      busy ? ++refused : ++answered;
      if (busy) {
        bool says_when = false;
        for (const auto& [name, value] : answer.headers)
          says_when = says_when || (name == "Retry-After" && value == "1");
        EXPECT_TRUE(says_when);
        EXPECT_EQ(answer.status, 503);
      }
      // All but five are refused at once; then those that wait need wait no longer.
      if (refused >= kAskers - 5) gone = true;
    });
  }
  askers.clear();
  EXPECT_GE(refused, kAskers - 5);
  EXPECT_GE(answered, 1);
  EXPECT_THAT(get("/api/v1/c1/designs/d1/race"), StartsWith("HTTP/1.1 200"));
}

TEST_F(DashboardTest, SeveralPagesOfAPersonAreNotTurnedAway) {
  // A page of results asks for some twenty figures at once; three of them are open.
  serve();
  std::atomic<int> refused = 0;
  {
    std::vector<std::jthread> askers;
    for (int i = 0; i < 60; ++i) {
      askers.emplace_back([&, i] {
        SiteRequest request{.path = "/api/v1/c1/figures/machine.svg"};
        request.parameters["width"] = std::to_string(60 + i) + "mm";
        refused += site_->answer(request).status == 503 ? 1 : 0;
      });
    }
  }
  EXPECT_EQ(refused, 0);
}

TEST_F(DashboardTest, MarkupInNamesStaysText) {
  const std::string hostile = (folder_ / "hostile.db").string();
  const std::string name = R"x(<img src=x onerror="alert(1)">)x";
  Campaign campaign = one_design_campaign();
  campaign.name = name;
  write_store(hostile, campaign);
  const SiteAnswer answer = Asking(hostile).answer("live");
  EXPECT_EQ(json::parse(answer.body)["campaigns"][0]["name"], name);
  EXPECT_EQ(answer.type, "application/json");
}

TEST(DashboardTokenTest, TheSecretIsForItsOwnerAlone) {
  const TemporaryFolder folder;
  const std::filesystem::path file = token_file_of(folder / "demo.db");
  EXPECT_EQ(file, folder / "demo.db.token");
  const std::string token = new_token();
  EXPECT_EQ(token.size(), 64U);
  EXPECT_NE(token, new_token());
  ASSERT_TRUE(write_token(file, token));
  EXPECT_EQ(read_token(file).value(), token);
  // An older one is replaced, and no link is followed.
  const std::filesystem::path victim = folder / "victim";
  write_file(victim, "mine");
  std::filesystem::remove(file);
  std::filesystem::create_symlink(victim, file);
  ASSERT_TRUE(write_token(file, token));
  EXPECT_FALSE(std::filesystem::is_symlink(file));
  EXPECT_EQ(std::filesystem::file_size(victim), 4U);
  EXPECT_FALSE(write_token(folder / "nowhere" / "x", token));
}

}  // namespace
}  // namespace swarmsmith::cli

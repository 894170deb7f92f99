#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/dashboard/dashboard.h"
#include "tests/cli/cli_support.h"
#include "tests/support/synthetic_campaign.h"

namespace swarmsmith::cli {

/// A dashboard of one store, asked without a socket.
class Asking {
 public:
  explicit Asking(const std::filesystem::path& store, DashboardOptions options = {}) {
    options.stores = {{store, std::nullopt}};
    options.program = SWARMSMITH_BIN_DIR "/swarmsmith";
    // Of a loaded machine, too, answers are wanted; who wants 202 says so.
    if (options.patience == DashboardOptions{}.patience) options.patience = std::chrono::hours(1);
    site = make_dashboard(std::move(options));
  }

  /// `path` below api/v1/.
  SiteAnswer answer(const std::string& path,
                    const std::map<std::string, std::string>& parameters = {},
                    bool acts = false) const {
    SiteRequest request{.acts = acts, .path = "/api/v1/" + path, .parameters = parameters};
    request.peer = "anna@127.0.0.1";
    return site->answer(request);
  }
  std::string text(const std::string& path,
                   const std::map<std::string, std::string>& parameters = {}) const {
    const SiteAnswer got = answer(path, parameters);
    EXPECT_EQ(got.status, 200) << path << ": " << got.body;
    return got.body;
  }
  nlohmann::json json(const std::string& path,
                      const std::map<std::string, std::string>& parameters = {}) const {
    return nlohmann::json::parse(text(path, parameters));
  }
  /// Status and kind of an error: "404 not_found".
  std::string error(const std::string& path,
                    const std::map<std::string, std::string>& parameters = {}) const {
    const SiteAnswer got = answer(path, parameters);
    const auto told = nlohmann::json::parse(got.body);
    if (!told.contains("error")) return std::to_string(got.status);
    EXPECT_FALSE(told["error"]["message"].get<std::string>().empty());
    return std::to_string(got.status) + " " + told["error"]["kind"].get<std::string>();
  }

  std::shared_ptr<HttpSite> site;
};

/// A store of what looks like races: two designs, three iterations each.
inline void write_synthetic_store(const std::filesystem::path& file,
                                  const SyntheticSize& size = {}) {
  SyntheticCampaign campaign = synthetic_campaign(size);
  auto store = Store::open(file, campaign.campaign, campaign.designs);
  ASSERT_TRUE(store) << to_string(store.error());
  for (std::vector<Row>& batch : campaign.batches)
    (*store)->append(std::move(batch));
  (*store)->flush();
}

}  // namespace swarmsmith::cli

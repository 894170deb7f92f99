#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/dashboard/dashboard.h"
#include "cli/run/coordinator_link.h"
#include "console/output.h"
#include "coordinator/service/http_site.h"

namespace swarmsmith::cli {

/// A dashboard with the secret that acts need; the secret's file lives as long as this.
class DashboardSetup {
 public:
  enum class Secret {
    OfOnesOwn,  ///< in a token file
    New,        ///< written beside the first store
    Joined,     ///< that of the process that runs the first store's campaign; new without one
  };
  /// `coordinator`: who is asked to act on campaigns that run.
  static std::unique_ptr<DashboardSetup> make(DashboardOptions options,
                                              const CoordinatorArgument& coordinator,
                                              Secret secret);
  ~DashboardSetup();
  DashboardSetup(const DashboardSetup&) = delete;
  DashboardSetup& operator=(const DashboardSetup&) = delete;

  const std::shared_ptr<HttpSite>& site() const { return site_; }
  /// Empty where the user gave the token.
  const std::string& token() const { return token_; }
  /// Says where the pages are, and how they are reached from elsewhere; the secret to a terminal
  /// alone. `address`: HOST:PORT.
  void announce(Output& output, const std::string& address) const;

 private:
  DashboardSetup() = default;

  std::shared_ptr<HttpSite> site_;
  std::string token_;
  std::filesystem::path file_;
};

}  // namespace swarmsmith::cli

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/output/run_listener.h"
#include "console/exit_code.h"
#include "console/output.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/service/service.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The campaign's name, or its store if others have the same name.
std::string name_among(const std::vector<Campaign>& campaigns, const Campaign& campaign);

/// The campaigns of one run, each with its store, its races and its exit code. Errors are printed,
/// with the campaign's name first if there are several.
class CampaignMembers {
 public:
  /// `campaigns` must outlive it. `keeps_store`: an interrupted run can continue later.
  CampaignMembers(Output& output, const std::vector<Campaign>& campaigns, bool keeps_store);

  /// Opens the stores, reports the campaigns' stored progress to `listener`, and closes the stores
  /// of finished campaigns.
  ExitCode open_stores(RunListener& listener);
  /// Replays the races of the unfinished campaigns as far as their stores have them.
  ExitCode begin();
  /// Sets the exit code of each campaign that was served. `trouble` is the reason why workers could
  /// not start.
  void end(const ServiceEnd& end, const std::string& trouble);

  std::size_t size() const { return members_.size(); }
  ExitCode end_of(std::size_t place) const { return members_[place].end; }
  /// Indices of the unfinished campaigns; the service has them in this order.
  const std::vector<std::size_t>& running() const { return running_; }
  const Campaign& campaign(std::size_t place) const { return *members_[place].campaign; }

  /// The unfinished campaigns, for the service.
  std::vector<ServiceCampaign> served() const;
  std::vector<const Campaign*> campaigns() const;
  /// The first worker number that none of their stores uses.
  std::int64_t first_worker() const;
  /// The command-line arguments that let workers run the programs of these campaigns.
  std::vector<std::string> allowed_programs() const;
  /// The paths of the coordinator's files, one beside each store, so that each store leads to the
  /// coordinator.
  std::vector<std::filesystem::path> coordinator_files() const;

 private:
  struct Member {
    const Campaign* campaign;
    std::string name;                ///< unique among the campaigns
    std::unique_ptr<Store> store{};  ///< closed if the campaign was already finished
    std::unique_ptr<CampaignRunner> runner{};
    std::int64_t unwritten = 0;  ///< evaluations that the store could not write
    ExitCode end = ExitCode::Done;
  };

  void replay(Member& member, std::vector<DesignPlan> plans);
  ExitCode end_of(const Member& member, const std::string& reason, const std::string& trouble);
  ExitCode lose(const Member& member, const std::string& fate);
  ExitCode fail_of(const Member& member, Error error);
  std::string in_front(const Member& member, const std::string& mark) const;
  void print_resume(const Member& member);

  Output& output_;
  bool keeps_store_;
  std::vector<Member> members_;
  std::vector<std::size_t> running_;  ///< indices into `members_`
};

}  // namespace swarmsmith::cli

#include "cli/run/campaign_members.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <set>
#include <utility>

#include "base/plain_text.h"
#include "cli/arguments/store_argument.h"
#include "cli/run/run_signals.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/programs.h"
#include "coordinator/design/plans.h"
#include "coordinator/launchers/worker_program.h"
#include "coordinator/pool/principal.h"
#include "coordinator/service/paused_designs.h"
#include "proto/access/coordinator_file.h"

namespace swarmsmith::cli {
namespace {

/// The store may be locked for a moment by a command to a campaign that does not run (pause,
/// resume).
constexpr std::chrono::milliseconds kPatience{2000};

}  // namespace

std::string name_among(const std::vector<Campaign>& campaigns, const Campaign& campaign) {
  const bool is_alone = std::ranges::count(campaigns, campaign.name, &Campaign::name) == 1;
  return is_alone ? campaign.name : campaign.store.string();
}

CampaignMembers::CampaignMembers(Output& output, const std::vector<Campaign>& campaigns,
                                 bool keeps_store)
    : output_(output), keeps_store_(keeps_store) {
  for (const Campaign& campaign : campaigns)
    members_.push_back({.campaign = &campaign, .name = name_among(campaigns, campaign)});
}

ExitCode CampaignMembers::open_stores(RunListener& listener) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Campaign& campaign = *members_[i].campaign;
    StoreOptions options;
    options.patience = kPatience;
    // A run of a program may have cost minutes, so it is stored at once.
    if (campaign.target) options.gather = std::chrono::milliseconds(0);
    auto store =
        Store::open(campaign.store, campaign_row(campaign), design_rows(campaign), options);
    if (!store) return fail(output_, exit_code_of_store(store.error()), store.error());
    for (const DesignStateRow& state : (*store)->design_states())
      listener.restore(i, state);
    for (const TestedDesign& tested : (*store)->tested_designs())
      listener.restore(i, tested);
    const std::vector<CommandRow> commands = (*store)->commands();
    for (const CommandRow& command : commands)
      listener.restore(i, command);
    if (const StoredTrust trust = (*store)->trust(); trust.distrusted) {
      std::string way_on = "`swarmsmith verify` evaluates them again; continue from a backup";
      if (!trust.quarantined.empty()) {
        way_on = "`swarmsmith recover " + campaign.store.string() + " --without-key \"" +
                 key_of_principal(trust.quarantined.back().principal) +
                 "\" -o NEW.db` makes a store without the results of that key, and the campaign "
                 "continues from there with --store NEW.db";
      }
      return fail(output_, ExitCode::Store,
                  {ErrorKind::Conflict,
                   "scores in this store are not reliable (`swarmsmith query STORE \"SELECT "
                   "text FROM event WHERE severity = 'error'\"` says why); " +
                       way_on,
                   campaign.store.string()});
    }
    if ((*store)->finished() && !waits_for_extension(commands)) continue;
    members_[i].store = std::move(*store);
    running_.push_back(i);
  }
  return ExitCode::Done;
}

ExitCode CampaignMembers::begin() {
  bool well = true;
  for (const std::size_t i : running_) {
    for (const Error& fault : check_programs(*members_[i].campaign)) {
      print_error(output_, fault);
      well = false;
    }
  }
  if (!well) return ExitCode::Usage;
  for (const std::size_t i : running_) {
    auto plans = plans_of(*members_[i].campaign);
    if (!plans) return fail(output_, ExitCode::Usage, plans.error());
    replay(members_[i], std::move(*plans));
    if (const auto error = members_[i].runner->error()) return fail_of(members_[i], *error);
  }
  return ExitCode::Done;
}

void CampaignMembers::replay(Member& member, std::vector<DesignPlan> plans) {
  Store& store = *member.store;
  const std::string file = member.campaign->store.string();
  const std::vector<CommandRow> commands = store.commands();
  const std::vector<DesignId> ended = ended_designs(store.design_states(), commands);
  const auto scores = store.scores();
  if (!scores.empty()) {
    print_note(output_, "continuing with " +
                            counted(scores.size(), "evaluation that is", "evaluations that are") +
                            " in " + file);
  }
  member.runner = std::make_unique<CampaignRunner>(
      std::move(plans), by_design(scores, store.steps(), ended), ended, commands);
  std::vector<DesignId> paused = member.runner->unfinished();
  const std::set<DesignId> all_paused = paused_designs(commands);
  std::erase_if(paused, [&](DesignId design) { return !all_paused.contains(design); });
  if (paused.empty()) return;
  print_note(output_, listed(paused) + " paused: continue with `swarmsmith resume " + file + " " +
                          to_string(paused.front()) + "`");
}

void CampaignMembers::end(const ServiceEnd& end, const std::string& trouble) {
  for (std::size_t i = 0; i < running_.size(); ++i) {
    Member& member = members_[running_[i]];
    member.unwritten = end.unwritten[i];
    if (!end.lost[i].empty()) {
      member.end = lose(member, end.lost[i]);
    } else if (end.distrusted[i]) {
      member.end = fail(output_, ExitCode::Store, in_front(member, ": ") + end.reasons[i]);
    } else {
      member.end = end_of(member, end.reasons[i], trouble);
    }
  }
}

/// The exit code of a campaign, after printing what went wrong.
ExitCode CampaignMembers::end_of(const Member& member, const std::string& reason,
                                 const std::string& trouble) {
  if (const auto error = member.runner->error()) return fail_of(member, *error);
  if (!reason.empty()) {
    print_resume(member);
    return fail(output_, ExitCode::OverFailureLimit, in_front(member, ": ") + reason);
  }
  if (member.store->finished()) return ExitCode::Done;
  if (!trouble.empty()) return ExitCode::Unreachable;
  if (ending_signal() == SIGXCPU) {
    print_error(output_, {ErrorKind::Unavailable,
                          "stopped: this process has used the processor time that it may use "
                          "(ulimit -t)",
                          member.campaign->store.string()});
  }
  print_resume(member);
  if (ending_signal() == SIGXCPU) return ExitCode::Terminated;
  return ending_signal() == SIGTERM ? ExitCode::Terminated : ExitCode::Interrupted;
}

ExitCode CampaignMembers::lose(const Member& member, const std::string& fate) {
  return fail(
      output_, ExitCode::Store,
      {ErrorKind::Conflict, in_front(member, ": ") + fate, member.campaign->store.string()});
}

ExitCode CampaignMembers::fail_of(const Member& member, Error error) {
  error.message.insert(0, in_front(member, ": "));
  return fail(output_, error.kind == ErrorKind::Corrupt ? ExitCode::Store : ExitCode::Failed,
              error);
}

/// The name of the campaign among the others, if there are several.
std::string CampaignMembers::in_front(const Member& member, const std::string& mark) const {
  return members_.size() > 1 ? member.name + mark : "";
}

void CampaignMembers::print_resume(const Member& member) {
  if (!keeps_store_) return;
  const std::string store = member.campaign->store.string();
  if (member.unwritten == 0) {
    print_note(output_,
               "everything so far is in " + store + "; the same command continues from there");
    return;
  }
  // Printed even with --quiet, because work is lost.
  print_error(output_, {ErrorKind::Unavailable,
                        counted(member.store->scores().size(), "evaluation is", "evaluations are") +
                            " stored; " +
                            counted(member.unwritten, "more could not be written, and is",
                                    "more could not be written, and are") +
                            " made again when the same command continues",
                        store});
}

std::vector<ServiceCampaign> CampaignMembers::served() const {
  std::vector<ServiceCampaign> served;
  for (const std::size_t i : running_) {
    const Member& member = members_[i];
    served.push_back({campaign_digest(*member.campaign), member.store.get(), member.runner.get(),
                      member.name, design_rows(*member.campaign),
                      real_store(member.campaign->store), searches_of(*member.campaign),
                      member.campaign->race.max_time, member.campaign->target.has_value()});
  }
  return served;
}

std::vector<const Campaign*> CampaignMembers::campaigns() const {
  std::vector<const Campaign*> campaigns;
  for (const std::size_t i : running_)
    campaigns.push_back(members_[i].campaign);
  return campaigns;
}

std::int64_t CampaignMembers::first_worker() const {
  std::int64_t first = 1;
  for (const std::size_t i : running_)
    first = std::max(first, members_[i].store->next_worker());
  return first;
}

std::vector<std::filesystem::path> CampaignMembers::coordinator_files() const {
  std::vector<std::filesystem::path> paths;
  for (const std::size_t i : running_)
    paths.push_back(coordinator_file_of(real_store(members_[i].campaign->store)));
  return paths;
}

std::vector<std::string> CampaignMembers::allowed_programs() const {
  std::vector<std::string> arguments;
  for (const std::size_t i : running_) {
    if (!members_[i].campaign->target) continue;
    for (std::string& argument : allow_arguments(*members_[i].campaign->target))
      arguments.push_back(std::move(argument));
  }
  return arguments;
}

}  // namespace swarmsmith::cli

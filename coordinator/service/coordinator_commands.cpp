// The coordinator's other half: what people ask of running campaigns. Commands are rows, and
// whoever asked is told when they are on disk: what was confirmed outlives a crash.

#include <algorithm>

#include "coordinator/service/coordinator.h"
#include "coordinator/service/paused_designs.h"

namespace swarmsmith {

void Coordinator::on_command(const Peer& peer, const pb::Command& command, TimePoint now) {
  if (!budgets_.may_command(now)) {
    budgets_.leave_out("command");
    return send(peer.id, command_reply_of(false, "too many commands at once: ask again later"));
  }
  const Expected<std::uint32_t> index = campaign_of(command);
  const Expected<std::string> done =
      index ? obey(*index, command) : Expected<std::string>(Unexpected(index.error()));
  std::string frame = command_reply_of(done.has_value(), done ? *done : to_string(done.error()));
  if (!done) return send(peer.id, std::move(frame));
  campaigns_[*index].replies.push_back({peer.id, std::move(frame)});
}

Expected<std::uint32_t> Coordinator::campaign_of(const pb::Command& command) const {
  if (command.campaign().empty()) {
    if (campaigns_.size() == 1) return 0U;
    return bad_input("this coordinator runs " + std::to_string(campaigns_.size()) +
                     " campaigns: name the store of the one that is meant");
  }
  const auto at = std::ranges::find(facts_.campaign_digests, command.campaign());
  if (at == facts_.campaign_digests.end()) {
    return unexpected(ErrorKind::NotFound, "this coordinator does not run the campaign",
                      command.campaign());
  }
  return static_cast<std::uint32_t>(at - facts_.campaign_digests.begin());
}

Expected<std::string> Coordinator::obey(std::uint32_t index, const pb::Command& command) {
  Campaign& campaign = campaigns_[index];
  const CommandRow row{.number = campaign.commands + 1,
                       .kind = command_kind_of(command.kind()),
                       .design = {command.design()},
                       .budget = command.budget(),
                       .who = command.who()};
  if (row.kind == CommandKind::Unknown)
    return bad_input("a command that this version does not know");
  if (campaign.stopped) return bad_input("the campaign has stopped: " + *campaign.stopped);
  if (is_of_leases(row.kind)) return pause(index, row);
  if (auto done = campaign.source->carry_out(row); !done) return Unexpected(done.error());
  ++campaign.commands;
  campaign.told = true;
  campaign.sees_no_further = false;
  const std::string name = to_string(row.design);
  if (row.kind == CommandKind::Cancel) return name + " is cancelled";
  return name + " gets " + std::to_string(row.budget) + " experiments more";
}

/// Pauses or resumes; asking twice changes nothing. What runs already ends, and counts.
Expected<std::string> Coordinator::pause(std::uint32_t index, const CommandRow& command) {
  Campaign& campaign = campaigns_[index];
  const std::vector<DesignId> unfinished = campaign.source->unfinished();
  auto rows = rows_of_pause(command, unfinished, campaign.paused);
  if (!rows) {
    return unexpected(
        ErrorKind::NotFound,
        "the campaign has no such design, or it is over; those that are not: " + listed(unfinished),
        to_string(command.design));
  }
  for (CommandRow& row : *rows) {
    row.number = ++campaign.commands;
    apply_pause(row, campaign.paused);
    scheduler_.hold_design(index, row.design.value, row.kind == CommandKind::Pause);
    campaign.own_rows.emplace_back(row);
  }
  return sentence_of_pause(command.kind, *rows);
}

/// A campaign that waits for a person says so, once.
void Coordinator::note_if_all_is_paused(Campaign& campaign) {
  bool all = !campaign.paused.empty() && !campaign.stopped;
  if (all) {
    const std::vector<DesignId> left = campaign.source->unfinished();
    all = !left.empty() && std::ranges::all_of(left, [&](DesignId design) {
      return campaign.paused.contains(design);
    });
    if (all && !campaign.all_paused) {
      campaign.own_rows.emplace_back(
          EventRow{.severity = "warning",
                   .kind = "all that is left is paused; `swarmsmith resume` goes on",
                   .text = event_text({{"designs", listed(left)}})});
    }
  }
  campaign.all_paused = all;
}

}  // namespace swarmsmith

#include "cli/run/ask_campaign.h"

#include <algorithm>
#include <memory>

#include "cli/run/command_at_rest.h"
#include "proto/access/coordinator_file.h"
#include "storage/store.h"

namespace swarmsmith::cli {

Expected<std::string> ask_campaign(const std::filesystem::path& path,
                                   const CoordinatorArgument& coordinator,
                                   const CommandRow& command) {
  const auto reader = StoreReader::open(path);
  if (!reader) return Unexpected(reader.error());
  if ((*reader)->campaigns().size() > 1) {
    return unexpected(ErrorKind::Conflict,
                      "the store holds several campaigns and is read-only (merged); open the "
                      "campaign's own store",
                      path.string());
  }
  if ((*reader)->campaigns().front().state == "imported") {
    return unexpected(ErrorKind::Conflict,
                      "the campaign was imported: it does not run, so nothing can be asked of it",
                      path.string());
  }
  const CampaignRow campaign = (*reader)->campaign();
  const std::vector<DesignRow> designs = (*reader)->designs();
  if (command.design && std::ranges::find(designs, command.design, &DesignRow::id) == designs.end())
    return unexpected(ErrorKind::NotFound, "the campaign has no such design",
                      to_string(command.design));
  const auto by_wire = [&] {
    return command_by_wire(coordinator.search(coordinator_file_of(real_store(path)).string()),
                           campaign.digest, command);
  };
  if (coordinator.is_named() || has_writer(path)) return by_wire();
  const auto store = Store::open(path, campaign, designs);
  if (store) return command_at_rest(**store, campaign, path, command);
  if (store.error().kind == ErrorKind::Conflict) return by_wire();
  return Unexpected(store.error());
}

}  // namespace swarmsmith::cli

#include "coordinator/campaign/internal/read_workers.h"

#include <vector>

#include "base/address.h"

namespace swarmsmith {
namespace {

/// Not allowed in lines of a batch script and on command lines.
constexpr std::string_view kNoBreaks = "\n\r";

/// `local` is the only key with two types.
void read_local(TableReader& table, Campaign& campaign) {
  const Node* node = table.take("local");
  if (node == nullptr) return;
  if (const auto* text = std::get_if<std::string>(&node->value); text && *text == "auto") return;
  if (std::holds_alternative<std::int64_t>(node->value)) {
    campaign.local_workers = table.integer("local", {0, 10'000});
    return;
  }
  table.complain("local",
                 "`local` must be \"auto\" (as many slots as cores) or a number of "
                 "workers");
}

/// Reads one option for sbatch.
std::optional<std::string> read_word(TableReader& table, std::string_view key) {
  auto word = table.text(key);
  if (!word) return word;
  if (!word->empty() && word->find_first_of(kNoBreaks) == std::string::npos) return word;
  table.complain(key, "`" + std::string(key) + "` must be one line of text, and not empty");
  return std::nullopt;
}

/// Reads more options for sbatch or ssh.
std::vector<std::string> read_options(TableReader& table) {
  auto words = table.texts("options");
  if (!words) return {};
  for (const std::string& word : *words) {
    if (!word.empty() && word.find_first_of(kNoBreaks) == std::string::npos) continue;
    table.complain("options", "`options` must be words without line breaks, none of them empty");
    return {};
  }
  return std::move(*words);
}

/// [workers.slurm]
void read_slurm(TableReader& workers, SlurmOptions& slurm) {
  auto table = workers.table("slurm");
  if (!table) return;
  slurm.jobs = table->integer("jobs", {1, 10'000}).value_or(slurm.jobs);
  slurm.cpus_per_task = table->integer("cpus_per_task", {1, 1024}).value_or(slurm.cpus_per_task);
  slurm.time = read_word(*table, "time").value_or(slurm.time);
  slurm.partition = read_word(*table, "partition").value_or(slurm.partition);
  slurm.options = read_options(*table);
  table->finish();
}

/// [workers.ssh]
void read_ssh(TableReader& workers, const std::filesystem::path& folder, SshOptions& ssh) {
  auto table = workers.table("ssh");
  if (!table) return;
  if (const auto hosts = table->text("hosts")) {
    if (hosts->empty()) table->complain("hosts", "`hosts` is empty; it names a host file");
    ssh.hosts = folder / *hosts;
  } else if (!table->has("hosts")) {
    table->complain("hosts", "[workers.ssh] needs `hosts`, the name of a host file");
  }
  ssh.options = read_options(*table);
  table->finish();
}

/// Reads which launcher starts workers; the tables of the other launchers are checked too.
void read_launcher(TableReader& table, const std::filesystem::path& folder, LaunchOptions& launch) {
  static const std::vector<std::string> kLaunchers = {"local", "ssh", "slurm"};
  read_slurm(table, launch.slurm);
  read_ssh(table, folder, launch.ssh);
  launch.ship = table.boolean("ship").value_or(launch.ship);
  const auto name = table.choice("launcher", kLaunchers);
  if (!name) return;
  if (*name == "ssh" && !table.has("ssh")) {
    table.complain("launcher",
                   "`launcher` is \"ssh\", but the table [workers.ssh] with `hosts`, the name of a "
                   "host file, is missing");
  }
  launch.kind = *name == "ssh"     ? LaunchOptions::Kind::Ssh
                : *name == "slurm" ? LaunchOptions::Kind::Slurm
                                   : LaunchOptions::Kind::Local;
}

}  // namespace

std::optional<std::string> read_bind(TableReader& table) {
  const auto bind = table.text("bind");
  if (!bind) return bind;
  constexpr std::string_view kScheme = "tcp://";
  std::string_view address = *bind;
  if (address.starts_with(kScheme)) address.remove_prefix(kScheme.size());
  if (parse_address(address)) return bind;
  table.complain("bind",
                 "`bind` must be an address with a port, such as \"127.0.0.1:5555\" or "
                 "\"[fd00::1]:5555\"; this is \"" +
                     *bind + "\"");
  return std::nullopt;
}

void read_workers(TableReader& root, const std::filesystem::path& folder, Campaign& campaign) {
  // The user should see the errors of programs (irace facts, 18.3).
  campaign.stop_on_failure = campaign.target.has_value();
  auto table = root.table("workers");
  if (!table) return;
  read_local(*table, campaign);
  read_launcher(*table, folder, campaign.launch);
  campaign.bind = read_bind(*table).value_or(campaign.bind);
  campaign.task_timeout_s = table->seconds("timeout", {0.1, 1e6}).value_or(campaign.task_timeout_s);
  campaign.audit_every =
      table->integer("audit_every", {0, 1'000'000}).value_or(campaign.audit_every);
  campaign.retries = table->integer("retries", {0, 1000}).value_or(campaign.retries);
  static const std::vector<std::string> kOnFailure = {"reject", "stop"};
  if (const auto action = table->choice("on_failure", kOnFailure)) {
    campaign.stop_on_failure = action == "stop";
  }
  table->finish();
}

}  // namespace swarmsmith

#include <memory>

#include "base/text/json.h"
#include "cli/commands/commands.h"
#include "proto/access/allow_list.h"
#include "proto/access/key_folder.h"
#include "proto/access/role_text.h"

namespace swarmsmith::cli {
namespace {

struct KeygenArguments {
  std::string folder;
  std::string client;
  std::string role;
  std::string expires;
};

void print_files(Output& output, const std::vector<std::filesystem::path>& files) {
  if (output.json) {
    const auto name_of = [](const std::filesystem::path& file) { return file.string(); };
    output.out << JsonObject().add("files", json_list(files, name_of)).text() << "\n";
    return;
  }
  for (const std::filesystem::path& file : files)
    output.out << file.string() << "\n";
}

ExitCode fail_to_write(Output& output, const Error& error) {
  return fail(output, error.kind == ErrorKind::Unavailable ? ExitCode::Failed : ExitCode::Usage,
              error);
}

ExitCode make_folder(const KeyFolder& folder, Output& output) {
  const auto files = make_key_folder(folder);
  if (!files) return fail_to_write(output, files.error());
  print_files(output, *files);
  print_note(output,
             "server.key and clients.toml stay with the coordinator; each worker's host needs "
             "worker.key, people who give commands operator.key, people who only look reader.key");
  return ExitCode::Done;
}

ExitCode make_client(const KeyFolder& folder, const KeygenArguments& arguments, Output& output) {
  NewClient client{.name = arguments.client, .role = Role::Worker, .expires = std::nullopt};
  if (!arguments.role.empty()) client.role = *role_of(arguments.role);
  if (!arguments.expires.empty()) {
    client.expires = date_of(arguments.expires);
    if (!client.expires) {
      return fail(
          output, ExitCode::Usage,
          Error{ErrorKind::BadInput, "`" + arguments.expires + "` is not a date such as 2027-01-31",
                "--expires"});
    }
  }
  const auto file = add_client(folder, client);
  if (!file) return fail_to_write(output, file.error());
  print_files(output, {*file});
  print_note(output, "\"" + client.name + "\" is in " + folder.clients().string() +
                         "; a running coordinator accepts it within a second");
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_keygen(Options& options) {
  auto arguments = std::make_shared<KeygenArguments>();
  options.text("DIR", arguments->folder,
               "Folder of the keys (default: SWARMSMITH_KEYS, else ~/.config/swarmsmith/keys)");
  options.text("--client NAME", arguments->client,
               "Add a key for the client of this name, and list it");
  options.choice("--role", arguments->role, {kRoleNames.begin(), kRoleNames.end()},
                 "Role of that client (default: worker)");
  options.text("--expires DATE", arguments->expires, "Last day of that key, in UTC: 2027-01-31");
  return [arguments](Output& output) {
    const KeyFolder folder =
        arguments->folder.empty() ? default_key_folder() : KeyFolder{arguments->folder};
    if (!arguments->client.empty()) return make_client(folder, *arguments, output);
    if (arguments->role.empty() && arguments->expires.empty()) return make_folder(folder, output);
    return fail(output, ExitCode::Usage, "--role and --expires need --client NAME");
  };
}

}  // namespace swarmsmith::cli

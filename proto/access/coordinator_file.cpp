#include "proto/access/coordinator_file.h"

#include <unistd.h>
#include <algorithm>
#include <ctime>

#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "proto/access/secret_file.h"
#include "proto/curve.h"
#include "proto/socket.h"

namespace swarmsmith {
namespace {

constexpr unsigned kOpenMode = 0644;
constexpr unsigned kOwnMode = 0600;
/// Enough addresses for a host with many interfaces.
constexpr std::size_t kMostOthers = 64;

std::string line(const char* key, const std::string& value) {
  return std::string(key) + " = " + value + "\n";
}

bool is_to_connect_to(const std::string& endpoint) {
  const auto address = address_of(endpoint);
  return address && !is_wildcard(address->host) && address->port != 0;
}

void read_endpoint(TableReader& root, CoordinatorFile& coordinator) {
  if (!root.has("endpoint")) root.complain("endpoint", "the file needs an `endpoint`");
  const auto endpoint = root.text("endpoint");
  if (!endpoint) return;
  coordinator.endpoint = *endpoint;
  if (!is_to_connect_to(*endpoint))
    root.complain("endpoint", "`endpoint` must be the address to connect to: \"tcp://HOST:PORT\"");
}

void read_others(TableReader& root, CoordinatorFile& coordinator) {
  coordinator.others = root.texts("others").value_or(std::vector<std::string>());
  if (coordinator.others.size() > kMostOthers ||
      !std::ranges::all_of(coordinator.others, is_to_connect_to)) {
    root.complain("others", "`others` must be at most 64 addresses to connect to");
  }
}

}  // namespace

std::string text_of(const CoordinatorFile& coordinator) {
  std::string text =
      "# Address of the coordinator of the campaign beside this file, while it runs:\n"
      "# swarmsmith worker --coordinator THIS_FILE\nformat = 1\n";
  text += line("endpoint", quoted_text(coordinator.endpoint));
  std::string others;
  // No more than readers take.
  const std::size_t count = std::min(coordinator.others.size(), kMostOthers);
  for (std::size_t i = 0; i < count; ++i)
    others += (others.empty() ? "" : ", ") + quoted_text(coordinator.others[i]);
  if (!others.empty()) text += line("others", "[" + others + "]");
  if (!coordinator.public_key.empty()) text += line("key", quoted_text(coordinator.public_key));
  if (coordinator.insecure_plaintext) text += line("insecure_plaintext", "true");
  text += line("pid", std::to_string(coordinator.pid));
  text += line("host", quoted_text(coordinator.host));
  text += line("started", quoted_text(coordinator.started));
  if (!coordinator.http.empty()) text += line("http", quoted_text(coordinator.http));
  return text;
}

Expected<CoordinatorFile> parse_coordinator_file(std::string_view text, const std::string& file) {
  const auto document = parse_document(text, file);
  if (!document) return Unexpected(document.error());
  Complaints complaints(file);
  TableReader root(*document, "", complaints);
  read_format(root);
  CoordinatorFile coordinator;
  read_endpoint(root, coordinator);
  read_others(root, coordinator);
  if (const auto key = root.text("key")) {
    coordinator.public_key = *key;
    if (!is_key(*key)) root.complain("key", "`key` must be a public key of 40 characters");
  }
  coordinator.insecure_plaintext = root.boolean("insecure_plaintext").value_or(false);
  coordinator.pid = root.integer("pid", {0, INT64_MAX}).value_or(0);
  coordinator.host = root.text("host").value_or("");
  coordinator.started = root.text("started").value_or("");
  coordinator.http = root.text("http").value_or("");
  // Unknown keys are allowed: they come from a newer coordinator.
  if (!complaints.empty()) return Unexpected(complaints.take().front());
  return coordinator;
}

Expected<CoordinatorFile> read_coordinator_file(const std::filesystem::path& file) {
  Expected<std::string> text = read_private_file(file, "coordinator file", Privacy::Integral);
  if (!text) return Unexpected(text.error());
  return parse_coordinator_file(*text, file.string());
}

Expected<void> write_coordinator_file(const std::filesystem::path& file,
                                      const CoordinatorFile& coordinator) {
  const auto address = address_of(coordinator.endpoint);
  // Only this user and root may connect on loopback without keys, so other users need no address
  // (docs/security.md, "A host with other users").
  const bool is_own = coordinator.public_key.empty() && address && is_loopback(address->host);
  return replace_file(file, text_of(coordinator), is_own ? kOwnMode : kOpenMode);
}

void remove_coordinator_file(const std::filesystem::path& file, const CoordinatorFile& ours) {
  // A later coordinator of the same store may have replaced the file.
  const auto there = read_coordinator_file(file);
  if (there && there->pid == ours.pid && there->host == ours.host &&
      there->started == ours.started) {
    ::unlink(file.c_str());
  }
}

std::filesystem::path coordinator_file_of(const std::filesystem::path& store) {
  return store.string() + ".coordinator";
}

std::string wall_clock_text() {
  const std::time_t now = std::time(nullptr);
  struct tm parts = {};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace swarmsmith

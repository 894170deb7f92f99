#include "cli/commands/http_flags.h"

namespace swarmsmith::cli {

void HttpFlags::declare(Options& options, const std::string& otherwise) {
  options.text("--http", http,
               "Address and port of /metrics, /healthz, /readyz, /status (" + otherwise + ")");
  options.text("--http-token-file", token_file, "File of the secret that their readers must show");
}

void HttpFlags::put(RunOptions& run, const std::string& otherwise) const {
  run.http = http == "none" ? "" : http.empty() ? otherwise : http;
  run.http_next_port = http.empty();
  run.http_token_file = token_file;
}

}  // namespace swarmsmith::cli

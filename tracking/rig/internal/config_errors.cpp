#include "tracking/rig/internal/config_errors.h"

#include "tracking/rig/issue.h"

namespace swarmsmith {

std::vector<Error> config_errors(std::vector<Error> errors) {
  for (Error& error : errors) {
    if (issue_code_from_name(error.message.substr(0, error.message.find(':')))) continue;
    // A missing file keeps its kind of error, since its contents are not wrong.
    const ErrorKind kind = error.kind;
    error = error_of(IssueCode::Config, std::move(error.message), std::move(error.where));
    if (kind == ErrorKind::NotFound) error.kind = kind;
  }
  return errors;
}

std::string need_text(TableReader& table, std::string_view key, std::string_view example) {
  const auto text = table.text(key);
  if (text && !text->empty()) return *text;
  if (text || !table.has(key)) {
    table.complain(key, table.name() + " needs a `" + std::string(key) + "`, such as \"" +
                            std::string(example) + "\"");
  }
  return "";
}

}  // namespace swarmsmith

#pragma once

#include <string>

#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// What `read` finds in the tables of a printed text, without a complaint.
template <class Read>
auto read_printed(const std::string& text, const Read& read) {
  const auto document = parse_document(text, "printed.toml");
  require(document.has_value(), "what is printed is TOML");
  Complaints complaints("printed.toml");
  TableReader root(*document, "", complaints);
  auto value = read(root);
  require(complaints.empty(), "what is printed can be read");
  return value;
}

}  // namespace swarmsmith::fuzz

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "console/options.h"

namespace swarmsmith {

/// The store: `--store`, otherwise SWARMSMITH_STORE, otherwise none (empty).
std::string store_word(const std::string& option);

/// The options that say when a run begins.
struct StartArguments {
  std::string start;
  std::optional<std::int64_t> sync_hidden;
  std::optional<std::int64_t> sync_shown;

  void declare(Options& options);
  bool are_given() const { return !start.empty() || sync_hidden || sync_shown; }
};

/// The command line of `track score`.
struct ScoreArguments {
  std::vector<std::string> videos;
  std::vector<std::string> times;
  std::string arena;
  std::string run;
  std::string mission;
  std::string design;
  std::string candidate;
  StartArguments begin;
  std::string patches;
  std::string name;
  std::string recorded;
  bool takes_tags_for_centres = false;
  bool all_checks = false;
  std::string into;
  std::string store;
  std::string csv;
  std::string report;

  void declare(Options& options);
};

}  // namespace swarmsmith

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/figures/figure.h"
#include "cli/arguments/store_argument.h"
#include "console/options.h"

namespace swarmsmith::cli {

/// The words of the command `figure`, as typed.
struct FigureArguments {
  std::string kind;
  StoreArgument store;
  std::string file;
  std::string width;
  std::string font;
  std::string design;
  std::string candidate;
  std::vector<std::string> seeds;
  std::string purpose;
  std::string per;
  FigureOptions options;  ///< what needs no reading

  void declare(Options& words);
};

/// Those that are drawn from views, then those that simulate.
std::vector<FigureKind> all_figure_kinds();

/// What the words mean, before any store is opened. Errors: BadInput, with the option.
Expected<FigureOptions> read_options(const FigureArguments& arguments);

}  // namespace swarmsmith::cli

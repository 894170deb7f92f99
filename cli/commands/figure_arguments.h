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

/// The arguments of the command `figure`, as typed.
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
  FigureOptions options;  ///< options that need no parsing

  void declare(Options& words);
};

/// The figures drawn from views, then the figures that simulate.
std::vector<FigureKind> all_figure_kinds();

/// Parses the arguments before any store is opened. Errors: BadInput, with the option.
Expected<FigureOptions> read_options(const FigureArguments& arguments);

}  // namespace swarmsmith::cli

#include <memory>

#include "analysis/report/report.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/arguments/program_name.h"
#include "cli/arguments/store_argument.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/commands.h"
#include "cli/commands/runs_from_above.h"
#include "console/counter.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

struct ReportArguments {
  StoreArgument store;
  std::vector<std::string> designs;
  std::string file = "report.html";
};

ExitCode run_report(const ReportArguments& arguments, Output& output) {
  ReportOptions options{.program = program_name()};
  for (const std::string& text : arguments.designs) {
    if (text == "all") {
      options.all_designs = true;
      continue;
    }
    const auto id = parse_thing_id(text);
    if (!id || id->letter != 'd') {
      return fail(
          output, ExitCode::Usage,
          Error{ErrorKind::BadInput,
                "must be a design such as d3, or \"all\", not \"" + text + "\"", "--design"});
    }
    options.designs.push_back({std::stoll(id->digits)});
  }
  const bool to_output = arguments.file == "-";
  if (to_output && output.json) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput,
                      "--json writes to standard output; name a file for the report", "-o"});
  }
  const auto store = arguments.store.open_whole();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  Counter counter(output, "wrote", "parts of the report");
  std::int64_t parts = 0;
  options.progress = [&](std::size_t written) {
    parts = static_cast<std::int64_t>(written);
    counter.tell(parts, 0);
  };
  options.runs_from_above = [&](DesignId design) {
    return runs_from_above(arguments.store, design);
  };
  const auto report = html_report(**store, options);
  counter.tell(parts, parts);
  if (!report) {
    const bool no_design = report.error().kind == ErrorKind::NotFound;
    return fail(output, no_design ? ExitCode::NoSuchId : ExitCode::Store, report.error());
  }
  if (to_output) {
    write_data(output, *report);
    return ExitCode::Done;
  }
  if (const auto written = write_whole_file(arguments.file, *report); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    output.out << JsonObject().add("file", arguments.file).add("bytes", report->size()).text()
               << "\n";
  } else {
    output.out << arguments.file << "\n";
  }
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_report(Options& options) {
  auto arguments = std::make_shared<ReportArguments>();
  arguments->store.declare(options);
  options.text("-o,--output FILE", arguments->file,
               "Write to this file (default report.html; - for "
               "standard output)");
  options.texts("--design DESIGN", arguments->designs,
                "Design that gets a chapter, such as d3, or all (default: all of up to three)");
  return [arguments](Output& output) { return run_report(*arguments, output); };
}

}  // namespace swarmsmith::cli

#include <filesystem>
#include <memory>
#include <utility>

#include "analysis/drawing/svg.h"
#include "analysis/figures/figure.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/commands/commands.h"
#include "cli/commands/figure_arguments.h"
#include "console/pdf.h"
#include "console/terminal.h"

namespace swarmsmith::cli {
namespace {

/// One line per kind, with its options below it.
std::string kinds_text() {
  std::string text = "Kinds:\n";
  for (const FigureKind& kind : all_figure_kinds()) {
    const std::string name(kind.name);
    text += "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') +
            std::string(kind.summary) + "\n";
    std::string options(kind.options);
    for (std::size_t at = 0; (at = options.find(' ', at)) != std::string::npos; at += 4)
      options.replace(at, 1, ", --");
    if (!options.empty()) text += std::string(14, ' ') + "--" + options + "\n";
  }
  return text;
}

std::string kinds_json() {
  const auto kind_json = [](const FigureKind& kind) {
    return JsonObject().add("kind", kind.name).add("summary", kind.summary);
  };
  return JsonObject().add("kinds", json_list(all_figure_kinds(), kind_json)).text() + "\n";
}

/// The number of rows below the headline; quoted cells may contain line feeds.
std::size_t rows_of_csv(const std::string& csv) {
  std::size_t rows = 0;
  bool quoted = false;
  for (const char letter : csv) {
    if (letter == '"') quoted = !quoted;
    if (letter == '\n' && !quoted) ++rows;
  }
  return rows == 0 ? 0 : rows - 1;
}

/// The ending of the file's name, which selects the format; ".svg" for standard output.
Expected<std::string> figure_ending(const FigureArguments& arguments, const Output& output) {
  if (arguments.file.empty() || arguments.file == "-") {
    if (!output.json) return std::string(".svg");
    return bad_input("--json writes to standard output; name a file for the figure", "-o");
  }
  std::string ending = std::filesystem::path(arguments.file).extension().string();
  for (const char* known : {".svg", ".pdf", ".png", ".csv", ".tex"})
    if (ending == known) return ending;
  return bad_input("the file's extension must be .svg, .pdf, .png, .csv or .tex", arguments.file);
}

ExitCode figure_exit_code(const Error& error) {
  if (error.kind == ErrorKind::NotFound) return ExitCode::NoSuchId;
  if (error.kind == ErrorKind::Corrupt) return ExitCode::Store;
  return error.kind == ErrorKind::Conflict ? ExitCode::Failed : ExitCode::Usage;
}

/// The bytes of the file with this ending.
Expected<std::string> bytes_of(Figure figure, const std::string& ending, const std::string& kind) {
  if (ending == ".csv") return std::move(figure.csv);
  if (ending == ".pdf" && !figure.pages.empty()) return pdf_of_svgs(figure.pages);
  if (ending == ".pdf") return pdf_of_svg(figure.svg);
  if (ending == ".png") return png_of_svg(figure.svg);
  if (ending == ".svg") return std::move(figure.svg);
  if (!figure.tex.empty()) return std::move(figure.tex);
  return bad_input("the figure `" + kind + "` has no TeX form; write an .svg, .pdf, .png or .csv",
                   "-o");
}

/// "winners-3.png" for page 3 of "winners.png".
std::filesystem::path numbered(const std::filesystem::path& file, std::size_t number) {
  std::filesystem::path page = file;
  page.replace_filename(file.stem().string() + "-" + std::to_string(number) +
                        file.extension().string());
  return page;
}

/// rsvg-convert cannot draw a higher picture at 300 dots per inch: its limit is 32,767 dots.
constexpr std::size_t kMostPagesOfPicture = 11;

/// Writes each page as a separate picture.
ExitCode write_pages(const std::vector<std::string>& pages, const std::string& file,
                     Output& output) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto bytes = png_of_svg(pages[i]);
    if (!bytes) return fail(output, ExitCode::Failed, bytes.error());
    files.push_back(numbered(file, i + 1));
    if (const auto written = write_whole_file(files.back(), *bytes); !written)
      return fail(output, ExitCode::Failed, written.error());
  }
  if (output.json) {
    output.out << JsonObject().add("files", files).text() << "\n";
  } else {
    print_note(output, std::to_string(files.size()) + " pages, from " + files.front() + " to " +
                           files.back());
  }
  return ExitCode::Done;
}

ExitCode draw_figure(const FigureKind& kind, const FigureArguments& arguments, Output& output) {
  const auto options = read_options(arguments);
  if (!options) return fail(output, ExitCode::Usage, options.error());
  if (const auto refused = refused_option(kind, *options))
    return fail(output, ExitCode::Usage, *refused);
  const auto ending = figure_ending(arguments, output);
  if (!ending) return fail(output, ExitCode::Usage, ending.error());
  // --paper removes elements that tables do not have, so it is allowed for all files of a script.
  if ((*ending == ".csv" || *ending == ".tex") && !arguments.font.empty()) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "has no effect on a " + *ending + " file", "--font"});
  }
  auto store = arguments.store.open_whole();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  if (const auto missing = missing_in(**store, *options))
    return fail(output, figure_exit_code(*missing), *missing);
  auto figure = kind.make(**store, *options);
  if (!figure) return fail(output, figure_exit_code(figure.error()), figure.error());
  if (!arguments.font.empty()) {
    std::vector<std::string*> sheets{&figure->svg};
    for (std::string& page : figure->pages)
      sheets.push_back(&page);
    for (std::string* sheet : sheets) {
      auto dressed = with_font(std::move(*sheet), arguments.font);
      if (!dressed) return fail(output, ExitCode::Usage, dressed.error());
      *sheet = std::move(*dressed);
    }
  }
  if (*ending == ".png" && figure->pages.size() > kMostPagesOfPicture)
    return write_pages(figure->pages, arguments.file, output);
  const std::size_t points = rows_of_csv(figure->csv);
  const auto bytes = bytes_of(std::move(*figure), *ending, arguments.kind);
  if (!bytes) {
    const bool is_usage = bytes.error().kind == ErrorKind::BadInput;
    return fail(output, is_usage ? ExitCode::Usage : ExitCode::Failed, bytes.error());
  }
  if (arguments.file.empty() || arguments.file == "-") {
    write_data(output, *bytes);
    return ExitCode::Done;
  }
  if (const auto written = write_whole_file(arguments.file, *bytes); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    output.out << JsonObject()
                      .add("figure", arguments.kind)
                      .add("file", arguments.file)
                      .add("points", points)
                      .text()
               << "\n";
  }
  return ExitCode::Done;
}

ExitCode run_figure(const FigureArguments& arguments, Output& output) {
  for (const FigureKind& kind : all_figure_kinds())
    if (kind.name == arguments.kind) return draw_figure(kind, arguments, output);
  output.out << (output.json ? kinds_json() : kinds_text());
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_figure(Options& options) {
  auto arguments = std::make_shared<FigureArguments>();
  arguments->declare(options);
  options.explain(kinds_text());
  return [arguments](Output& output) { return run_figure(*arguments, output); };
}

}  // namespace swarmsmith::cli

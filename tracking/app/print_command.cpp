#include <charconv>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "console/pdf.h"
#include "tracking/app/commands.h"
#include "tracking/printing/board_sheet.h"
#include "tracking/printing/survey_sheet.h"
#include "tracking/printing/tag_sheet.h"

namespace swarmsmith {
namespace {

/// The arena of the thesis; the default for a survey form.
constexpr std::string_view kAreaOfTheThesis = "4.91";

Expected<double> number_from(const std::string& text, std::string_view option) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && stop == text.data() + text.size() && value > 0) return value;
  return bad_input("\"" + text + "\" is not a positive number", std::string(option));
}

enum class Form { Pdf, Svg };

Expected<Form> form_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".pdf") return Form::Pdf;
  if (ending == ".svg") return Form::Svg;
  return bad_input("the file's ending must be .pdf or .svg", file);
}

/// One file per page: tags.svg, or tags-1.svg, tags-2.svg, ...
std::vector<std::string> names_of_pages(const std::string& file, std::size_t pages) {
  if (pages == 1) return {file};
  std::vector<std::string> names;
  const std::filesystem::path path(file);
  for (std::size_t page = 1; page <= pages; ++page) {
    std::filesystem::path name = path;
    name.replace_filename(path.stem().string() + "-" + std::to_string(page) +
                          path.extension().string());
    names.push_back(name.string());
  }
  return names;
}

/// Writes pages to the named file, and lists the files that were written.
ExitCode write_pages(std::span<const std::string> pages, const std::string& file, Form form,
                     Output& output) {
  std::vector<std::string> names = {file};
  if (form == Form::Pdf) {
    const auto pdf = pdf_of_svgs(pages);
    if (!pdf) return fail(output, ExitCode::Failed, pdf.error());
    if (const auto written = write_whole_file(file, *pdf); !written)
      return fail(output, ExitCode::Failed, written.error());
  } else {
    names = names_of_pages(file, pages.size());
    for (std::size_t page = 0; page < pages.size(); ++page) {
      if (const auto written = write_whole_file(names[page], pages[page]); !written)
        return fail(output, ExitCode::Failed, written.error());
    }
  }
  if (!output.json) {
    print_note(output, "wrote " + counted(pages.size(), "page") + " to " + names.front() +
                           (names.size() > 1 ? " to " + names.back() : "") +
                           "; print at 100 %, and measure the ruler");
    return ExitCode::Done;
  }
  output.out << JsonObject().add("pages", pages.size()).add("files", names).text() << "\n";
  return ExitCode::Done;
}

struct TagArguments {
  std::string ids;
  std::string family = "tag36h11";
  std::string edge;
  std::string paper = "A4";
  std::string area = std::string(kAreaOfTheThesis);
  std::string file;
};

/// The common arguments of printing tags and survey forms.
struct ReadTagArguments {
  std::vector<int> ids;
  double edge_m = 0;
  Paper paper;
  Form form = Form::Pdf;
};

Expected<ReadTagArguments> read(const TagArguments& arguments) {
  const auto ids = ids_from_text(arguments.ids);
  if (!ids) return tl::unexpected(ids.error());
  const auto edge = number_from(arguments.edge, "--edge");
  if (!edge) return tl::unexpected(edge.error());
  const auto paper = paper_from_name(arguments.paper);
  if (!paper) return tl::unexpected(paper.error());
  const auto form = form_of(arguments.file);
  if (!form) return tl::unexpected(form.error());
  return ReadTagArguments{*ids, *edge, *paper, *form};
}

ExitCode print_tags(const TagArguments& arguments, Output& output) {
  const auto words = read(arguments);
  if (!words) return fail(output, ExitCode::Usage, words.error());
  const auto pages = tag_sheets({arguments.family, words->ids, words->edge_m, words->paper});
  if (!pages) return fail(output, ExitCode::Usage, pages.error());
  return write_pages(*pages, arguments.file, words->form, output);
}

ExitCode print_survey(const TagArguments& arguments, Output& output) {
  const auto words = read(arguments);
  if (!words) return fail(output, ExitCode::Usage, words.error());
  const auto area = number_from(arguments.area, "--area");
  if (!area) return fail(output, ExitCode::Usage, area.error());
  const auto page =
      survey_sheet({regular_dodecagon(*area), words->ids, words->edge_m, words->paper});
  if (!page) return fail(output, ExitCode::Usage, page.error());
  return write_pages({&*page, 1}, arguments.file, words->form, output);
}

struct BoardArguments {
  std::string board;
  std::string paper = "A4";
  std::string file;
};

ExitCode print_board(const BoardArguments& arguments, Output& output) {
  const auto board = parse_board(arguments.board);
  if (!board) return fail(output, ExitCode::Usage, board.error());
  const auto paper = paper_from_name(arguments.paper);
  if (!paper) return fail(output, ExitCode::Usage, paper.error());
  const auto form = form_of(arguments.file);
  if (!form) return fail(output, ExitCode::Usage, form.error());
  const auto page = board_sheet(*board, *paper);
  if (!page) return fail(output, ExitCode::Usage, page.error());
  return write_pages({&*page, 1}, arguments.file, *form, output);
}

void declare_tag_words(Options& options, TagArguments& arguments) {
  options.text("--ids IDS", arguments.ids, "Ids and ranges of ids, such as 1-3,100-105",
               Options::Need::Required);
  options.text("--edge METRES", arguments.edge, "Edge of the black border in metres, such as 0.10",
               Options::Need::Required);
  options.choice("--paper", arguments.paper, paper_names(), "Paper");
  options.text("-o,--output FILE", arguments.file, "File to write, .pdf or .svg",
               Options::Need::Required);
}

}  // namespace

CommandRun declare_print_tags(Options& options) {
  auto arguments = std::make_shared<TagArguments>();
  options.text("--family FAMILY", arguments->family, "Family of the tags (default tag36h11)");
  declare_tag_words(options, *arguments);
  return [arguments](Output& output) { return print_tags(*arguments, output); };
}

CommandRun declare_print_board(Options& options) {
  auto arguments = std::make_shared<BoardArguments>();
  options.text("BOARD", arguments->board, "Such as charuco:11x8:0.023:0.017:5x5_100",
               Options::Need::Required);
  options.choice("--paper", arguments->paper, paper_names(), "Paper");
  options.text("-o,--output FILE", arguments->file, "File to write, .pdf or .svg",
               Options::Need::Required);
  return [arguments](Output& output) { return print_board(*arguments, output); };
}

CommandRun declare_print_survey(Options& options) {
  auto arguments = std::make_shared<TagArguments>();
  declare_tag_words(options, *arguments);
  options.text("--area AREA", arguments->area,
               "Area of the dodecagon in square metres (default 4.91)");
  return [arguments](Output& output) { return print_survey(*arguments, output); };
}

}  // namespace swarmsmith

#include "tests/support/printed_page.h"

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "base/process/process.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {

namespace {

/// A program of poppler-utils with its words, in `folder`, where the document is `in.pdf`; what it
/// wrote.
Expected<std::string> run_tool(const std::string& name, std::vector<std::string> words,
                               const TemporaryFolder& folder, const std::string& pdf) {
  const auto program = find_program(name);
  if (!program) {
    return unexpected(ErrorKind::Unavailable,
                      name + " is not there; install the Debian package poppler-utils");
  }
  std::ofstream(folder / "in.pdf", std::ios::binary) << pdf;
  words.insert(words.begin(), *program);
  const Interrupt never;
  const auto end = run_process({.words = std::move(words),
                                .folder = folder.path().string(),
                                .limit = std::chrono::minutes(1)},
                               never);
  if (!end || end->exit_code != 0) return unexpected(ErrorKind::Unavailable, name + " failed");
  return end->output.text;
}

}  // namespace

Expected<std::vector<PrintedPage>> printed_pages(const std::string& pdf, int dpi) {
  const TemporaryFolder folder;
  const auto done = run_tool(
      "pdftocairo", {"-gray", "-png", "-r", std::to_string(dpi), "in.pdf", "p"}, folder, pdf);
  if (!done) return tl::unexpected(done.error());
  // Names end in -1 or, of ten pages and more, in -01.
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<PrintedPage> pages;
  for (const auto& file : files) {
    const cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    pages.push_back(
        {image.cols, image.rows, {image.begin<unsigned char>(), image.end<unsigned char>()}});
  }
  return pages;
}

Expected<std::vector<PageSize>> page_sizes(const std::string& pdf) {
  constexpr double kPoint = 25.4 / 72;
  const TemporaryFolder folder;
  const auto said = run_tool("pdfinfo", {"-f", "1", "-l", "-1", "in.pdf"}, folder, pdf);
  if (!said) return tl::unexpected(said.error());
  const std::regex line(R"(Page +[0-9]+ size: +([0-9.]+) x ([0-9.]+) pts)");
  std::vector<PageSize> sizes;
  for (auto at = std::sregex_iterator(said->begin(), said->end(), line);
       at != std::sregex_iterator(); ++at)
    sizes.push_back({kPoint * std::stod((*at)[1]), kPoint * std::stod((*at)[2])});
  return sizes;
}

}  // namespace swarmsmith

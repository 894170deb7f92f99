#include "tests/support/printed_page.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "base/process/process.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {

Expected<std::vector<PrintedPage>> printed_pages(const std::string& pdf, int dpi) {
  const auto program = find_program("pdftocairo");
  if (!program) {
    return unexpected(ErrorKind::Unavailable,
                      "pdftocairo is not there; install the Debian package poppler-utils");
  }
  const TemporaryFolder folder;
  std::ofstream(folder / "in.pdf", std::ios::binary) << pdf;
  const Interrupt never;
  const auto end = run_process({.words = {*program, "-gray", "-png", "-r", std::to_string(dpi),
                                          (folder / "in.pdf").string(), (folder / "p").string()},
                                .limit = std::chrono::minutes(1)},
                               never);
  if (!end || end->exit_code != 0) return unexpected(ErrorKind::Unavailable, "pdftocairo failed");
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

std::vector<PageSize> page_sizes(const std::string& pdf) {
  constexpr double kPoint = 25.4 / 72;
  const std::regex box(R"(/MediaBox \[ *0 0 ([0-9.]+) ([0-9.]+) *\])");
  std::vector<PageSize> sizes;
  for (auto at = std::sregex_iterator(pdf.begin(), pdf.end(), box); at != std::sregex_iterator();
       ++at)
    sizes.push_back({kPoint * std::stod((*at)[1]), kPoint * std::stod((*at)[2])});
  return sizes;
}

}  // namespace swarmsmith

#include "console/pdf.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <utility>
#include <vector>

#include "base/process/process.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20U;

/// A text in memory that another process can read as a file.
class TextInMemory {
 public:
  explicit TextInMemory(std::string_view text) : descriptor_(memfd_create("svg", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !text.empty()) {
      const ssize_t size = write(descriptor_, text.data(), text.size());
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) {
        close(std::exchange(descriptor_, -1));
        break;
      }
      text.remove_prefix(static_cast<std::size_t>(size));
    }
  }
  ~TextInMemory() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  TextInMemory(const TextInMemory&) = delete;
  TextInMemory& operator=(const TextInMemory&) = delete;

  bool is_there() const { return descriptor_ >= 0; }
  std::string name() const {
    return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_;
};

/// An output format of rsvg-convert.
struct Format {
  const char* name;
  const char* begin;  ///< its first bytes
  std::vector<std::string> words;
};

Unexpected not_made(const Format& format, const std::string& why) {
  return unexpected(ErrorKind::Unavailable, why, format.name);
}

/// The first line of a program's message, for use in a sentence.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it gives no reason" : line;
}

Expected<std::string> converted(const Format& format, std::span<const std::string> pages) {
  const auto program = find_program("rsvg-convert");
  if (!program) {
    return not_made(
        format,
        "the program rsvg-convert, which makes it, is not installed; install the Debian package "
        "librsvg2-bin, or write an .svg");
  }
  // Without this fixed date, two PDFs of the same drawing would differ.
  ProcessCall call{.words = {"env", "SOURCE_DATE_EPOCH=0", *program},
                   .limit = std::chrono::minutes(1),
                   .keep = kLargestFile};
  call.words.insert(call.words.end(), format.words.begin(), format.words.end());
  std::deque<TextInMemory> drawings;
  for (const std::string& page : pages) {
    drawings.emplace_back(page);
    if (!drawings.back().is_there())
      return not_made(format, std::string("no memory: ") + std::strerror(errno));
    call.words.push_back(drawings.back().name());
  }
  const Interrupt never;
  const auto end = run_process(call, never);
  if (!end) return not_made(format, to_string(end.error()));
  if (end->why == ProcessEnd::Why::Limit)
    return not_made(format, "rsvg-convert took over a minute");
  const bool is_made = end->output.text.starts_with(format.begin) && end->output.complete();
  if (end->exit_code != 0 || end->signal != 0 || !is_made)
    return not_made(format, "rsvg-convert failed: " + first_line(end->errors.text));
  return end->output.text;
}

}  // namespace

Expected<std::string> pdf_of_svg(std::string_view svg) {
  const std::string page(svg);
  return pdf_of_svgs({&page, 1});
}

Expected<std::string> png_of_svg(std::string_view svg) {
  const std::string page(svg);
  // The picture gives its size in mm, and rsvg-convert assumes 90 pixels per inch by default.
  return converted({"PNG", "\x89PNG", {"-f", "png", "-d", "300", "-p", "300", "-b", "white"}},
                   {&page, 1});
}

Expected<std::string> pdf_of_svgs(std::span<const std::string> pages) {
  return converted({"PDF", "%PDF", {"-f", "pdf"}}, pages);
}

}  // namespace swarmsmith

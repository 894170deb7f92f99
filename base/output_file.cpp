#include "base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// Device, inode and birth time, since inode numbers are reused.
using Identity =
    std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::int64_t, std::uint32_t>;

struct Inputs {
  std::mutex mutex;
  std::set<Identity> files;
};

Inputs& inputs() {
  static Inputs known;
  return known;
}

/// The identity of a regular file; symbolic links are followed.
std::optional<Identity> identity_of(const fs::path& file) {
  struct statx status {};
  constexpr unsigned kWanted = STATX_TYPE | STATX_INO | STATX_BTIME;
  if (::statx(AT_FDCWD, file.c_str(), 0, kWanted, &status) != 0 || !S_ISREG(status.stx_mode)) {
    return std::nullopt;
  }
  return Identity{status.stx_dev_major, status.stx_dev_minor, status.stx_ino,
                  status.stx_btime.tv_sec, status.stx_btime.tv_nsec};
}

bool is_input(const fs::path& file) {
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return false;
  const std::scoped_lock lock(inputs().mutex);
  return inputs().files.contains(*identity);
}

std::string beginning_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(4096, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// The first line that is neither empty nor a comment.
std::string_view first_line(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
      line.remove_suffix(1);
    if (!line.empty() && line.front() != '#') return line;
  }
  return {};
}

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '"' || c == ' ';
  });
}

bool is_toml(std::string_view line) {
  if (line.starts_with('[')) {
    const std::size_t end = line.find(']');
    const std::size_t begin = line.find_first_not_of('[');
    return end != std::string_view::npos && begin < end &&
           is_name(line.substr(begin, end - begin)) &&
           std::isdigit(static_cast<unsigned char>(line[begin])) == 0;
  }
  return is_name(line.substr(0, line.find('='))) && line.find('=') != std::string_view::npos &&
         !line.starts_with("--");
}

/// The target of a symbolic link, which need not exist yet.
fs::path followed(fs::path file) {
  constexpr int kMostLinks = 40;
  std::error_code failed;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(file, failed)); ++i) {
    const fs::path target = fs::read_symlink(file, failed);
    if (failed) break;
    file = target.is_absolute() ? target : file.parent_path() / target;
  }
  return file;
}

/// Whether both names are one file, which need not exist yet.
bool is_one_file(const fs::path& one, const fs::path& other) {
  const fs::path first = followed(one);
  const fs::path second = followed(other);
  const std::optional<Identity> identity = identity_of(first);
  if (identity) return identity == identity_of(second);
  std::error_code failed;
  if (fs::exists(first, failed)) return false;  // a device or a pipe
  // Of a relative path that is not there yet, weakly_canonical may leave a relative one.
  const auto place_of = [](const fs::path& file) {
    std::error_code none;
    return fs::weakly_canonical(fs::absolute(file, none), none).lexically_normal();
  };
  const fs::path place = place_of(first);
  return !place.empty() && place == place_of(second);
}

}  // namespace

void note_input(const fs::path& file) {
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return;
  const std::scoped_lock lock(inputs().mutex);
  inputs().files.insert(*identity);
}

void forget_input(const fs::path& file) {
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return;
  const std::scoped_lock lock(inputs().mutex);
  inputs().files.erase(*identity);
}

FileKind kind_of(std::string_view beginning) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, FileKind>, 9> kSignatures{
      {{"SQLite format 3\0"sv, FileKind::Store},
       {"\x1a\x45\xdf\xa3"sv, FileKind::Video},
       {"RIFF"sv, FileKind::Video},
       {"\x89PNG"sv, FileKind::Picture},
       {"\xff\xd8\xff"sv, FileKind::Picture},
       {"%PDF"sv, FileKind::Pdf},
       {"\x1f\x8b"sv, FileKind::Gzip},
       {"{"sv, FileKind::Json},
       {"[{"sv, FileKind::Json}}};
  for (const auto& [signature, kind] : kSignatures) {
    if (beginning.starts_with(signature)) return kind;
  }
  if (beginning.size() > 8 && beginning.substr(4, 4) == "ftyp") return FileKind::Video;
  std::string lower(beginning.substr(0, 1000));
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower.find("<html") != std::string::npos || lower.starts_with("<!doctype html"))
    return FileKind::WebPage;
  if (lower.find("<svg") != std::string::npos) return FileKind::Svg;
  const std::string_view line = first_line(beginning);
  if (is_toml(line)) return FileKind::Toml;
  const bool is_table = line.find(',') != std::string_view::npos && !line.starts_with("--") &&
                        line.find('\\') == std::string_view::npos &&
                        line.find('(') == std::string_view::npos;
  return is_table ? FileKind::Table : FileKind::Text;
}

std::string_view name_of(FileKind kind) {
  constexpr std::array<std::string_view, 11> kNames{
      "a store", "a video",     "a picture",       "a PDF file",    "an SVG picture", "a web page",
      "JSON",    "a TOML file", "compressed data", "a table (CSV)", "a text"};
  return kNames.at(static_cast<std::size_t>(kind));
}

Expected<fs::path> output_place(const fs::path& file, FileKind kind) {
  fs::path place = followed(file);
  const std::optional<Identity> there = identity_of(place);
  if (!there) return place;
  if (is_input(place)) {
    return bad_input(
        "is an input of this command, and would be overwritten; name another file to write",
        file.string());
  }
  const std::string beginning = beginning_of(place);
  if (beginning.empty()) return place;
  const FileKind is = kind_of(beginning);
  if (is != kind) {
    return bad_input("already exists and is " + std::string(name_of(is)) + ", not " +
                         std::string(name_of(kind)) +
                         "; name another file to write, or remove this one first",
                     file.string());
  }
  return place;
}

Expected<void> each_its_own_file(const std::vector<NamedOutput>& outputs) {
  for (std::size_t later = 1; later < outputs.size(); ++later) {
    const NamedOutput& output = outputs[later];
    if (output.file.empty() || output.file == "-") continue;
    for (std::size_t i = 0; i < later; ++i) {
      const std::string& other = outputs[i].file;
      if (other.empty() || other == "-" || !is_one_file(other, output.file)) continue;
      return bad_input("names the same file as " + std::string(outputs[i].option) + ": " +
                           output.file + "; give each its own file",
                       std::string(output.option));
    }
  }
  return {};
}

Error cannot_write(const std::string& file, int reason) {
  Error error{ErrorKind::Unavailable, "cannot be written", file};
  std::error_code trouble;
  const fs::path folder = fs::path(file).parent_path();
  if (fs::is_directory(file, trouble)) {
    error.message += ": this is a folder; name a file";
  } else if (!folder.empty() && !fs::exists(folder, trouble) && !trouble) {
    error.message += ": there is no folder " + folder.string();
  } else if (reason != 0) {
    error.message += ": " + std::generic_category().message(reason);
  }
  return error;
}

}  // namespace swarmsmith

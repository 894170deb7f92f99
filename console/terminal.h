#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "console/output.h"

namespace swarmsmith::cli {

/// What stands between a program and its terminal: everything that is written to it comes out as
/// text that is shown (base/shown_text.h), whoever wrote it and whatever is in it. Only what the
/// program itself says is `Verbatim` passes as it is.
class ShownBuffer : public std::streambuf {
 public:
  explicit ShownBuffer(std::streambuf* behind) : behind_(behind) {}
  ~ShownBuffer() override;
  ShownBuffer(const ShownBuffer&) = delete;
  ShownBuffer& operator=(const ShownBuffer&) = delete;

  /// Whether all of it was written.
  bool pass(std::string_view bytes);

 protected:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* bytes, std::streamsize size) override;
  int sync() override;

 private:
  bool show(std::string_view text);
  bool put(std::string_view bytes);

  std::streambuf* behind_;
  std::string begun_;  ///< a character whose last bytes have not come yet
};

/// Bytes that are no text of others: control sequences of our own.
struct Verbatim {
  std::string_view bytes;
};
std::ostream& operator<<(std::ostream& stream, Verbatim verbatim);

/// Goes to the begin of the line and empties it.
inline constexpr Verbatim kClearLine{"\r\x1b[2K"};

/// An answer that programs read (CSV, an exported file, a picture), to standard output: exact in
/// files and pipes, shown on a terminal.
void write_data(Output& output, std::string_view bytes);

}  // namespace swarmsmith::cli

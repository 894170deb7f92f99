#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "console/output.h"

namespace swarmsmith {

/// The stream between a program and its terminal. It converts all text to shown text
/// (base/shown_text.h), whatever its source. Only text that the program marks as `Verbatim` is not
/// changed.
class ShownBuffer : public std::streambuf {
 public:
  explicit ShownBuffer(std::streambuf* behind) : behind_(behind) {}
  ~ShownBuffer() override;
  ShownBuffer(const ShownBuffer&) = delete;
  ShownBuffer& operator=(const ShownBuffer&) = delete;

  /// Returns whether everything was written.
  bool pass(std::string_view bytes);

 protected:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* bytes, std::streamsize size) override;
  int sync() override;

 private:
  bool show(std::string_view text);
  bool put(std::string_view bytes);

  std::streambuf* behind_;
  std::string begun_;  ///< first bytes of a character whose other bytes have not arrived yet
};

/// Bytes of our own, such as control sequences.
struct Verbatim {
  std::string_view bytes;
};
std::ostream& operator<<(std::ostream& stream, Verbatim verbatim);

/// Moves the cursor to the start of the line and clears the line.
inline constexpr Verbatim kClearLine{"\r\x1b[2K"};

/// Writes an answer for programs (CSV, an exported file, a picture) to standard output: exact bytes
/// to files and pipes, shown text on a terminal.
void write_data(Output& output, std::string_view bytes);

}  // namespace swarmsmith

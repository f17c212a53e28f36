// Reads the numbers of a Gmsh file one after the other, from text or binary. Private to io/msh.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "geometry/polyhedron.h"

namespace voussoir {

/// All errors are InputError "FILE:LINE: …", or "FILE, byte N: …" for binary files.
class MshValues {
 public:
  MshValues(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  /// The following numbers are binary; with `swapped` they have the other byte order.
  void set_binary(bool swapped) { binary_ = true, swapped_ = swapped; }
  bool binary() const { return binary_; }

  /// The next word of text, also in a binary file; empty at the end.
  std::string_view word();
  /// A whole number written as text, also in a binary file.
  std::int64_t whole_word(const char* what);
  /// The name of the next section without its "$"; empty at the end of the file.
  std::string section();
  /// Moves past the end of a section that has been read; the next word must be "$EndNAME".
  void end_section(const std::string& name);
  /// Skips a section.
  void skip_section(const std::string& name);
  /// Moves past the end of the line, after which numbers begin.
  void end_line();

  std::int64_t integer(std::size_t width, const char* what);  // `width`: bytes in a binary file, 4 or 8
  double real(const char* what);
  Vec3 point();
  /// Checks a number of entries that need at least so many bytes each (text, binary) of the rest of the file.
  std::size_t count(std::int64_t found, std::size_t least_text, std::size_t least_binary, const char* what) const;
  /// Checks that a record of a text file ends with its line, so that a missing or additional number is found at its
  /// place.
  void end_record(const char* what);
  void skip(std::size_t numbers, std::size_t width);  // skips numbers

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks();
  std::string_view take(std::size_t width, const char* what);

  std::string_view bytes_;
  std::string file_;
  std::size_t at_ = 0, token_ = 0;  // positions of the next read and of the last word
  bool binary_ = false, swapped_ = false;
};

}  // namespace voussoir

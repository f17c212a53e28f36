// The numbers of a Gmsh file one after the other, whether it is text or binary. Private to io/msh.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "geometry/polyhedron.h"

namespace voussoir {

/// All errors are InputError "FILE:LINE: …", or "FILE, byte N: …" where the file is binary.
class MshValues {
 public:
  MshValues(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  /// From here on numbers are binary, those of the other byte order when the file is `swapped`.
  void set_binary(bool swapped) { binary_ = true, swapped_ = swapped; }
  bool binary() const { return binary_; }

  /// The next word of text, also in a binary file; empty at the end.
  std::string_view word();
  /// A whole number of text, also in a binary file.
  std::int64_t whole_word(const char* what);
  /// The name of the next section without its "$"; empty at the end of the file.
  std::string section();
  /// Goes past the end of a section that has been read: the next word must be "$EndNAME".
  void end_section(const std::string& name);
  /// Goes past the end of a section that is of no interest.
  void skip_section(const std::string& name);
  /// Numbers begin after this line end.
  void end_line();

  std::int64_t integer(std::size_t width, const char* what);  // of so many bytes where binary: 4 or 8
  double real(const char* what);
  Vec3 point();
  /// A number of things, each of which takes at least so many bytes (text, binary) of what is left of the file.
  std::size_t count(std::int64_t found, std::size_t least_text, std::size_t least_binary, const char* what) const;
  /// In text every record has a line to itself, which ends here: a number too few or too many is found where it is.
  void end_record(const char* what);
  void skip(std::size_t numbers, std::size_t width);  // of no interest

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks();
  std::string_view take(std::size_t width, const char* what);

  std::string_view bytes_;
  std::string file_;
  std::size_t at_ = 0, token_ = 0;  // where reading goes on, and where what was read last begins
  bool binary_ = false, swapped_ = false;
};

}  // namespace voussoir

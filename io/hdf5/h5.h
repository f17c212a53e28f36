// A thin layer over the C interface of HDF5: handles that close themselves, datasets with unit and checksum, and errors
// with file, dataset and reason.
#pragma once
#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solver/base/error.h"

namespace voussoir::h5 {

template <class T>
concept Element = std::same_as<T, double> || std::same_as<T, float> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, std::uint8_t>;

using Shape = std::vector<std::size_t>;
/// In an expected shape: any size.
inline constexpr std::size_t any = static_cast<std::size_t>(-1);

/// The innermost description on the error stack of HDF5. Empties the stack.
std::string last_reason();

/// Owns one HDF5 identifier (hid_t, a 64-bit integer).
class Handle {
 public:
  using Closer = int (*)(std::int64_t);
  Handle() = default;
  Handle(std::int64_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), closer_(other.closer_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { close(); }
  int close();
  std::int64_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  std::int64_t id_ = -1;
  Closer closer_ = nullptr;
};

/// Texts for HDF5: UTF-8 of one length, padded with nulls to the longest.
struct PaddedTexts {
  explicit PaddedTexts(const std::vector<std::string>& values);
  std::size_t longest = 1;
  std::string bytes;
  Handle type;
};

/// An HDF5 file. Paths of datasets are "group/name"; groups on the way are made as needed. A new file is built in
/// memory and written atomically with save(), so that no incomplete file remains. Reading throws InputError, writing
/// RunError.
class File {
 public:
  File(File&&) noexcept;
  ~File();
  static File create(const std::string& path);
  static File open(const std::string& path);
  static bool is_hdf5(const std::string& path);
  /// Finishes a new file and writes it atomically to its path; the object is of no use afterwards.
  void save();
  const std::string& path() const { return path_; }

  /// Row-major; an empty shape means one-dimensional. Chunked with Fletcher32 checksums; attribute `unit` unless empty.
  template <Element T>
  void write(const std::string& name, std::span<const T> values, const Shape& shape = {}, const std::string& unit = "");
  template <Element T>
  void write(const std::string& name, const std::vector<T>& values, const Shape& shape = {},
             const std::string& unit = "") {
    write(name, std::span<const T>(values), shape, unit);
  }
  /// One dimension of fixed-length UTF-8 texts, padded with nulls to the longest.
  void write_texts(const std::string& name, const std::vector<std::string>& values);
  std::vector<std::string> read_texts(const std::string& name) const;
  /// Reads a dataset whose shape must agree with `expected` (default: one dimension of any size). Integers are not read
  /// as floating-point numbers nor the other way round; sizes are converted.
  template <Element T>
  std::vector<T> read(const std::string& name, const Shape& expected = {any}) const;
  /// Reads into memory that has exactly the dataset's size.
  template <Element T>
  void read_to(const std::string& name, std::span<T> values) const;

  bool has(const std::string& name) const;
  Shape shape(const std::string& name) const;
  /// The first dimension. Throws InputError for a scalar.
  std::size_t rows(const std::string& name) const;
  std::string unit(const std::string& name) const;                 // "" when it has none
  std::vector<std::string> names(const std::string& group) const;  // members, sorted; empty when there is no such group
  std::vector<std::string> datasets() const;                       // paths of all datasets, sorted by group and name
  void make_group(const std::string& name);

  // Attributes of the root ("/"), a group or a dataset. Reading one that is missing or of another kind is an error.
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::string> attributes(const std::string& object) const;
  void set_text(const std::string& object, const std::string& name, const std::string& value);
  void set_texts(const std::string& object, const std::string& name, const std::vector<std::string>& values);
  void set_number(const std::string& object, const std::string& name, double value);
  void set_integer(const std::string& object, const std::string& name, std::int64_t value);
  std::string text(const std::string& object, const std::string& name) const;
  std::vector<std::string> texts(const std::string& object, const std::string& name) const;
  double number(const std::string& object, const std::string& name) const;
  std::int64_t integer(const std::string& object, const std::string& name) const;

  /// Throws InputError "FILE: DATASET: reason".
  [[noreturn]] void fail(const std::string& dataset, const std::string& reason) const;

 private:
  struct Memory;
  File(std::string path, Handle handle, std::unique_ptr<Memory> memory);
  Handle open_dataset(const std::string& name) const;
  Handle open_object(const std::string& name) const;
  Handle open_attribute(const std::string& object, const std::string& name) const;
  void write_raw(const std::string& name, const void* data, std::size_t size, std::int64_t type, std::size_t bytes,
                 Shape shape, const std::string& unit);
  void read_raw(const std::string& name, void* data, std::size_t size, std::int64_t type, bool floating) const;
  void write_strings(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                     bool scalar);
  void write_scalar(const std::string& object, const std::string& name, const void* value, std::int64_t type);
  std::size_t checked_size(const std::string& name, const Shape& expected, std::size_t bytes) const;

  std::string path_;
  std::unique_ptr<Memory> memory_;  // of a new file; must outlive the handle
  Handle handle_;
};

/// A sound HDF5 file, but not of the kind or version that was wanted.
struct ForeignFile : InputError {
  using InputError::InputError;
};

/// Throws ForeignFile unless the root's attributes are format = `format` and 1 <= format_version <= `newest`; returns
/// the version.
std::int64_t check_format(const File& file, const std::string& format, std::int64_t newest);

}  // namespace voussoir::h5

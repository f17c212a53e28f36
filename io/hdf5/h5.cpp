#include "io/hdf5/h5.h"

#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numeric>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir::h5 {

/// The innermost description of HDF5's error stack.
std::string last_reason() {
  std::string reason;
  const auto innermost = [](unsigned n, const H5E_error2_t* error, void* text) -> herr_t {
    if (n == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "HDF5 gave no reason" : reason;
}

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

namespace {

constexpr std::size_t chunk_bytes = std::size_t(1) << 20;

/// HDF5 prints its error stack by itself unless told not to.
void be_silent() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

template <class T>
hid_t memory_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::same_as<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

std::size_t count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>());
}

std::string spoken(const Shape& shape) {
  std::string text;
  for (const std::size_t n : shape) text += (text.empty() ? "" : " x ") + (n == any ? "any" : std::to_string(n));
  return text.empty() ? "a single value" : text;
}

/// Rows of about a mebibyte, the whole dataset when it is smaller: one flipped bit spoils one checksum either way.
std::vector<hsize_t> chunk_of(const Shape& shape, std::size_t bytes) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  const std::size_t row = std::max<std::size_t>(1, bytes * count(shape) / shape[0]);
  chunk[0] = std::clamp<hsize_t>(chunk_bytes / row, 1, shape[0]);
  return chunk;
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

herr_t collect_dataset(hid_t, const char* name, const H5O_info_t* info, void* names) {
  if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

}  // namespace

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(closer_, other.closer_);
  return *this;
}

int Handle::close() {
  const int result = id_ >= 0 && closer_ ? closer_(id_) : 0;
  id_ = -1;
  return result;
}

/// The bytes of a file built in memory. HDF5 grows them through the callbacks below and leaves them to us when it
/// closes the file: only then are they final (its ready-made image of an open file carries a wrong checksum in 1.10).
struct File::Memory {
  void* bytes = nullptr;
  ~Memory() { std::free(bytes); }

  static void* allocate(std::size_t size, H5FD_file_image_op_t, void* self) {
    return static_cast<Memory*>(self)->bytes = std::malloc(size);
  }
  static void* grow(void*, std::size_t size, H5FD_file_image_op_t, void* self) {
    void* grown = std::realloc(static_cast<Memory*>(self)->bytes, size);
    return grown ? static_cast<Memory*>(self)->bytes = grown : nullptr;
  }
  static void* copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  }
  static herr_t keep(void*, H5FD_file_image_op_t, void*) { return 0; }
  static void* same(void* self) { return self; }
  static herr_t leave(void*) { return 0; }
};

File::File(std::string path, Handle handle, std::unique_ptr<Memory> memory)
    : path_(std::move(path)), memory_(std::move(memory)), handle_(std::move(handle)) {}
File::File(File&&) noexcept = default;
File::~File() = default;

namespace {

/// Links and attributes in the object's header, however many: with too many for it HDF5 puts them into a fractal heap,
/// and 1.10.8 frees what is not its own when it meets damage in the header of one. No times: equal contents give equal
/// files.
void set_object_properties(const Handle& creation) {
  constexpr unsigned many = 10000;
  H5Pset_link_phase_change(creation.id(), many, many);
  H5Pset_attr_phase_change(creation.id(), many, many);
  H5Pset_obj_track_times(creation.id(), false);
}

}  // namespace

File File::create(const std::string& path) {
  be_silent();
  auto memory = std::make_unique<Memory>();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5FD_file_image_callbacks_t callbacks = {Memory::allocate, Memory::copy,  Memory::grow, Memory::keep,
                                           Memory::same,     Memory::leave, memory.get()};
  H5Pset_fapl_core(access.id(), std::size_t(4) << 20, false);
  H5Pset_meta_block_size(access.id(), 0);  // no room set aside: the file ends where its contents end
  H5Pset_small_data_block_size(access.id(), 0);
  H5Pset_file_image_callbacks(access.id(), &callbacks);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110);  // headers and indices with checksums too
  // HDF5 tells files in memory apart by name, and two files may be built for one path.
  const std::string name = fmt::format("memory {}", fmt::ptr(memory.get()));
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  set_object_properties(creation);  // of the root group
  Handle file(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (!file.valid()) throw RunError("cannot write {}: {}", path, last_reason());
  return File(path, std::move(file), std::move(memory));
}

bool File::is_hdf5(const std::string& path) {
  be_silent();
  return H5Fis_hdf5(path.c_str()) > 0;
}

File File::open(const std::string& path) {
  be_silent();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError("cannot read {}: there is no such file", path);
  if (std::filesystem::is_directory(path, ignored))
    throw InputError("cannot read {}: it is a folder, not a file", path);
  if (!is_hdf5(path)) throw InputError("{} is not an HDF5 file, or its beginning is damaged", path);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) throw InputError("{} is truncated or damaged: {}", path, last_reason());
  return File(path, std::move(file), nullptr);
}

void File::save() {
  const bool flushed = H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = H5Fget_file_image(handle_.id(), nullptr, 0);
  if (!flushed || size <= 0 || handle_.close() < 0) throw RunError("cannot write {}: {}", path_, last_reason());
  write_atomically(path_, std::span(static_cast<const std::byte*>(memory_->bytes), std::size_t(size)));
}

void File::fail(const std::string& dataset, const std::string& reason) const {
  throw InputError("{}: {}: {}", path_, dataset, reason);
}

// --- datasets
// ---------------------------------------------------------------------------------------------------------

void File::write_raw(const std::string& name, const void* data, std::size_t size, std::int64_t type, std::size_t bytes,
                     Shape shape, const std::string& unit) {
  if (shape.empty()) shape = {size};
  if (count(shape) != size)
    throw RunError("cannot write {}: {}: {} values do not fill the shape {}", path_, name, size, spoken(shape));
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(int(dims.size()), dims.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) make_group(name.substr(0, slash));
  H5Pset_obj_track_times(creation.id(), false);  // equal contents give equal files
  if (size > 0) {
    H5Pset_chunk(creation.id(), int(dims.size()), chunk_of(shape, bytes).data());
    H5Pset_fletcher32(creation.id());
  }
  const Handle set(H5Dcreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                   H5Dclose);
  if (!set.valid() || (size > 0 && H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
    throw RunError("cannot write {}: {}: {}", path_, name, last_reason());
  if (!unit.empty()) set_text(name, "unit", unit);
}

template <Element T>
void File::write(const std::string& name, std::span<const T> values, const Shape& shape, const std::string& unit) {
  write_raw(name, values.data(), values.size(), memory_type<T>(), sizeof(T), shape, unit);
}

PaddedTexts::PaddedTexts(const std::vector<std::string>& values) : type(H5Tcopy(H5T_C_S1), H5Tclose) {
  for (const std::string& value : values) longest = std::max(longest, value.size());
  for (const std::string& value : values) bytes += value + std::string(longest - value.size(), '\0');
  H5Tset_size(type.id(), longest);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
}

void File::write_texts(const std::string& name, const std::vector<std::string>& values) {
  const PaddedTexts texts(values);
  write_raw(name, texts.bytes.data(), values.size(), texts.type.id(), texts.longest, {}, "");
}

std::vector<std::string> File::read_texts(const std::string& name) const {
  const Handle set = open_dataset(name), type(H5Dget_type(set.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0)
    fail(name, "expected texts of fixed length");
  const std::size_t length = H5Tget_size(type.id()), size = checked_size(name, {any}, length);
  std::string padded(size * length, '\0');
  if (size > 0 && H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)
    fail(name, "damaged: " + last_reason());
  std::vector<std::string> values;
  for (std::size_t i = 0; i < size; ++i) {
    const std::string text = padded.substr(i * length, length);
    values.push_back(text.substr(0, text.find('\0')));
  }
  return values;
}

Handle File::open_dataset(const std::string& name) const {
  if (!has(name)) fail(name, "the dataset is missing");
  Handle set(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail(name, last_reason());
  return set;
}

Shape File::shape(const std::string& name) const {
  const Handle set = open_dataset(name), space(H5Dget_space(set.id()), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space.id());
  if (dimensions < 0) fail(name, last_reason());
  std::vector<hsize_t> dims(static_cast<std::size_t>(dimensions));
  H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr);
  return Shape(dims.begin(), dims.end());
}

std::size_t File::rows(const std::string& name) const {
  const Shape all = shape(name);
  if (all.empty()) fail(name, "is a single value. Expected rows.");
  return all.front();
}

std::size_t File::checked_size(const std::string& name, const Shape& expected, std::size_t bytes) const {
  const Shape found = shape(name);
  bool equal = found.size() == expected.size();
  for (std::size_t i = 0; equal && i < found.size(); ++i) equal = expected[i] == any || found[i] == expected[i];
  if (!equal) fail(name, "its shape is " + spoken(found) + ", expected " + spoken(expected));
  // A header that asks for more than the machine could ever hold is damage or malice, not data.
  double total = double(bytes);
  for (const std::size_t n : found) total *= double(n);
  if (total > 1e12) fail(name, "its shape " + spoken(found) + " is too large");
  return count(found);
}

void File::read_raw(const std::string& name, void* data, std::size_t size, std::int64_t type, bool floating) const {
  const Handle set = open_dataset(name), kind(H5Dget_type(set.id()), H5Tclose);
  if (H5Tget_class(kind.id()) != (floating ? H5T_FLOAT : H5T_INTEGER))
    fail(name, floating ? "expected floating-point numbers" : "expected integers");
  if (size > 0 && H5Dread(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fail(name, "damaged: " + last_reason());
}

template <Element T>
std::vector<T> File::read(const std::string& name, const Shape& expected) const {
  std::vector<T> values;
  try {
    values.resize(checked_size(name, expected, sizeof(T)));
  } catch (const std::bad_alloc&) {
    fail(name, "its shape " + spoken(shape(name)) + " does not fit into the memory");
  }
  read_raw(name, values.data(), values.size(), memory_type<T>(), std::floating_point<T>);
  return values;
}

template <Element T>
void File::read_to(const std::string& name, std::span<T> values) const {
  if (count(shape(name)) != values.size())
    fail(name, "its shape is " + spoken(shape(name)) + ", expected " + std::to_string(values.size()) + " values");
  read_raw(name, values.data(), values.size(), memory_type<T>(), std::floating_point<T>);
}

bool File::has(const std::string& name) const {
  // Step by step: asking for a member of a group that is missing is an error, and so is damage, which must not pass for
  // "not there".
  for (std::size_t at = name.find('/', 1);; at = name.find('/', at + 1)) {
    const htri_t exists = H5Lexists(handle_.id(), name.substr(0, at).c_str(), H5P_DEFAULT);
    if (exists < 0) fail(name, "damaged: " + last_reason());
    if (exists == 0) return false;
    if (at == std::string::npos) return true;
  }
}

std::string File::unit(const std::string& name) const {
  return has_attribute(name, "unit") ? text(name, "unit") : "";
}

std::vector<std::string> File::names(const std::string& group) const {
  std::vector<std::string> found;
  if (group != "/" && !has(group)) return found;
  const Handle handle(H5Gopen2(handle_.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!handle.valid()) fail(group, "expected a group: " + last_reason());
  if (H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &found) < 0)
    fail(group, last_reason());
  return found;
}

std::vector<std::string> File::datasets() const {
  std::vector<std::string> found;
  if (H5Ovisit2(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, collect_dataset, &found, H5O_INFO_BASIC) < 0)
    fail("/", last_reason());
  return found;
}

void File::make_group(const std::string& name) {
  if (name.empty() || has(name)) return;
  // One by one: groups that HDF5 makes on the way to another carry the time of day.
  if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) make_group(name.substr(0, slash));
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  set_object_properties(creation);
  const Handle group(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) throw RunError("cannot write {}: {}: {}", path_, name, last_reason());
}

#define VOUSSOIR_H5_INSTANTIATE(T)                                                                        \
  template void File::write<T>(const std::string&, std::span<const T>, const Shape&, const std::string&); \
  template std::vector<T> File::read<T>(const std::string&, const Shape&) const;                          \
  template void File::read_to<T>(const std::string&, std::span<T>) const;
VOUSSOIR_H5_INSTANTIATE(double)
VOUSSOIR_H5_INSTANTIATE(float)
VOUSSOIR_H5_INSTANTIATE(std::int64_t)
VOUSSOIR_H5_INSTANTIATE(std::int32_t)
VOUSSOIR_H5_INSTANTIATE(std::uint8_t)

}  // namespace voussoir::h5

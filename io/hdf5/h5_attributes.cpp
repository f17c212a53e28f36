// Attributes of HDF5 objects: text, lists of text, numbers.
#include <hdf5.h>

#include <algorithm>

#include "io/hdf5/h5.h"
#include "solver/base/error.h"

namespace voussoir::h5 {

namespace {

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

}  // namespace

Handle File::open_object(const std::string& name) const {
  if (name != "/" && !has(name)) fail(name, "missing");
  Handle object(H5Oopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.valid()) fail(name, last_reason());
  return object;
}

Handle File::open_attribute(const std::string& object, const std::string& name) const {
  if (!has_attribute(object, name)) fail(object, "the attribute '" + name + "' is missing");
  const Handle owner = open_object(object);
  Handle attribute(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(object, "the attribute '" + name + "' cannot be read: " + last_reason());
  return attribute;
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  const htri_t exists = H5Aexists(open_object(object).id(), name.c_str());
  if (exists < 0) fail(object, "its attributes cannot be read: " + last_reason());
  return exists > 0;
}

std::vector<std::string> File::attributes(const std::string& object) const {
  std::vector<std::string> found;
  const Handle owner = open_object(object);
  if (H5Aiterate2(owner.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &found) < 0)
    fail(object, last_reason());
  return found;
}

void File::write_scalar(const std::string& object, const std::string& name, const void* value, std::int64_t type) {
  const Handle owner = open_object(object), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(owner.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), type, value) < 0)
    throw RunError("cannot write {}: attribute '{}' of {}: {}", path_, name, object, last_reason());
}

void File::set_number(const std::string& object, const std::string& name, double value) {
  write_scalar(object, name, &value, H5T_NATIVE_DOUBLE);
}

void File::set_integer(const std::string& object, const std::string& name, std::int64_t value) {
  write_scalar(object, name, &value, H5T_NATIVE_INT64);
}

void File::write_strings(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                         bool scalar) {
  const PaddedTexts texts(values);
  const hsize_t size = values.size();
  const Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle owner = open_object(object);
  const Handle attribute(H5Acreate2(owner.id(), name.c_str(), texts.type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute.valid() || (size > 0 && H5Awrite(attribute.id(), texts.type.id(), texts.bytes.data()) < 0))
    throw RunError("cannot write {}: attribute '{}' of {}: {}", path_, name, object, last_reason());
}

void File::set_text(const std::string& object, const std::string& name, const std::string& value) {
  write_strings(object, name, {value}, true);
}

void File::set_texts(const std::string& object, const std::string& name, const std::vector<std::string>& values) {
  write_strings(object, name, values, false);
}

namespace {

std::vector<std::string> read_variable(hid_t attribute, hid_t type, hid_t space, std::size_t size) {
  std::vector<char*> pointers(size, nullptr);
  std::vector<std::string> values;
  if (H5Aread(attribute, type, pointers.data()) < 0) return values;
  for (const char* text : pointers) values.emplace_back(text ? text : "");
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  return values;
}

std::vector<std::string> read_fixed(hid_t attribute, hid_t type, std::size_t size) {
  const std::size_t length = H5Tget_size(type);
  std::string padded(size * length, '\0');
  std::vector<std::string> values;
  if (H5Aread(attribute, type, padded.data()) < 0) return values;
  for (std::size_t i = 0; i < size; ++i) {
    std::string text = padded.substr(i * length, length);
    values.push_back(text.substr(0, text.find('\0')));
  }
  return values;
}

}  // namespace

std::vector<std::string> File::texts(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(object, name);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose), space(H5Aget_space(attribute.id()), H5Sclose);
  if (H5Tget_class(type.id()) != H5T_STRING) fail(object, "the attribute '" + name + "' is not text");
  const auto size = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id())));
  if (size == 0) return {};
  std::vector<std::string> values = H5Tis_variable_str(type.id()) > 0
                                        ? read_variable(attribute.id(), type.id(), space.id(), size)
                                        : read_fixed(attribute.id(), type.id(), size);
  if (values.size() != size) fail(object, "the attribute '" + name + "' cannot be read: " + last_reason());
  return values;
}

std::string File::text(const std::string& object, const std::string& name) const {
  const std::vector<std::string> values = texts(object, name);
  if (values.size() != 1) fail(object, "the attribute '" + name + "' is not a single text");
  return values[0];
}

double File::number(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(object, name), type(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  double value = 0.0;
  if (H5Tget_class(type.id()) != H5T_FLOAT || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail(object, "the attribute '" + name + "' is not a number");
  return value;
}

std::int64_t File::integer(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(object, name), type(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  std::int64_t value = 0;
  if (H5Tget_class(type.id()) != H5T_INTEGER || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_INT64, &value) < 0)
    fail(object, "the attribute '" + name + "' is not an integer");
  return value;
}

std::int64_t check_format(const File& file, const std::string& format, std::int64_t newest) {
  if (!file.has_attribute("/", "format"))
    throw ForeignFile("{} is an HDF5 file without the attribute 'format', expected \"{}\": another program wrote it",
                      file.path(), format);
  const std::string found = file.text("/", "format");
  if (found != format) throw ForeignFile("{} is a \"{}\" file, expected \"{}\"", file.path(), found, format);
  const std::int64_t version = file.integer("/", "format_version");
  if (version < 1 || version > newest)
    throw ForeignFile("{} has format_version {}, this program reads 1 to {}: use a newer voussoir", file.path(),
                      version, newest);
  return version;
}

}  // namespace voussoir::h5

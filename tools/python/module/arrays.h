// Conversions between C++ and numpy.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <span>

#include "geometry/polyhedron.h"

namespace voussoir::python {

namespace py = pybind11;

/// An array of `count` rows (of `columns` numbers; 0: one number each, one dimension) filled by `value(row, column)`.
template <class T, class Value>
py::array_t<T> table(std::size_t count, std::size_t columns, const Value& value) {
  py::array_t<T> array(columns == 0 ? std::vector<std::size_t>{count} : std::vector<std::size_t>{count, columns});
  T* to = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < std::max<std::size_t>(columns, 1); ++c) *to++ = T(value(i, c));
  return array;
}

/// One number of each element.
template <class T, class Container, class Value>
py::array_t<T> column(const Container& of, const Value& value) {
  return table<T>(of.size(), 0, [&](std::size_t i, std::size_t) { return value(of[i]); });
}

/// One vector of each element, shape (n, 3).
template <class Container, class Value>
py::array_t<double> vectors(const Container& of, const Value& value) {
  return table<double>(of.size(), 3, [&](std::size_t i, std::size_t c) { return Vec3(value(of[i]))[Eigen::Index(c)]; });
}
inline py::array_t<double> vectors(const std::vector<Vec3>& of) {
  return vectors(of, [](const Vec3& v) { return v; });
}

/// A view of rows of data that `owner` keeps alive, without a copy: writing to the array changes the data. `stride` is
/// the distance of two rows, counted in elements.
template <class T>
py::array_t<T> view(T* data, std::size_t rows, std::size_t columns, std::size_t stride, py::handle owner) {
  return py::array_t<T>({rows, columns}, {stride * sizeof(T), sizeof(T)}, data, owner);
}

/// The vector of a sequence or array of three numbers. Throws InputError that begins with `what` for anything else.
Vec3 vector_of(const py::handle& three, const char* what);

}  // namespace voussoir::python

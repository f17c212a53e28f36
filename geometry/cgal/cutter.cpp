// The part of geometry/decompose that uses CGAL: a separate library, which is loaded when there is
// something to cut. Its arithmetic needs -frounding-math and its GPL parts stay out of the program itself.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/convex_decomposition_3.h>

#include <map>

#include "geometry/cgal/cut_shape.h"

namespace voussoir {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Kernel::Point_3 meeting_of(const std::array<Plane, 3>& planes) {
  std::array<Kernel::FT, 9> n;
  std::array<Kernel::FT, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) n[3 * i + k] = planes[i].normal[Eigen::Index(k)];
    d[i] = planes[i].offset;
  }
  // Cramer's rule, with the k-th column taken out for d.
  const auto determinant = [&](int column) {
    std::array<Kernel::FT, 9> m = n;
    if (column >= 0)
      for (std::size_t i = 0; i < 3; ++i) m[3 * i + std::size_t(column)] = d[i];
    return Kernel::FT(m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                      m[2] * (m[3] * m[7] - m[4] * m[6]));
  };
  const Kernel::FT whole = determinant(-1);
  return {determinant(0) / whole, determinant(1) / whole, determinant(2) / whole};
}

class Builder : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  explicit Builder(const ExactShape& shape) : shape_(shape) {}
  void operator()(Surface::HalfedgeDS& to) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(to, false);
    builder.begin_surface(shape_.corners.size(), shape_.faces.size());
    for (const auto& planes : shape_.corners) builder.add_vertex(meeting_of(planes));
    for (const auto& loop : shape_.faces) {
      builder.begin_facet();
      for (const int v : loop) builder.add_vertex_to_facet(std::size_t(v));
      builder.end_facet();
    }
    builder.end_surface();
    failed = builder.error();
  }
  bool failed = false;

 private:
  const ExactShape& shape_;
};

Polyhedron rounded(const Surface& surface) {
  Polyhedron out;
  std::map<Surface::Vertex_const_handle, int> number;
  for (auto v = surface.vertices_begin(); v != surface.vertices_end(); ++v) {
    number[v] = int(out.vertices.size());
    out.vertices.emplace_back(CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y()),
                              CGAL::to_double(v->point().z()));
  }
  for (auto f = surface.facets_begin(); f != surface.facets_end(); ++f) {
    auto& loop = out.faces.emplace_back();
    auto h = f->facet_begin();
    do {
      loop.push_back(number[h->vertex()]);
    } while (++h != f->facet_begin());
  }
  return out;
}

void cut_into(const ExactShape& shape, std::vector<Polyhedron>& pieces, std::string& trouble) {
  Surface surface;
  Builder builder(shape);
  surface.delegate(builder);
  if (builder.failed || !surface.is_valid() || !surface.is_closed()) {
    trouble = "its surface is not closed, or touches itself in an edge or a corner";
    return;
  }
  Nef nef(surface);
  CGAL::convex_decomposition_3(nef);
  auto volume = nef.volumes_begin();
  for (++volume; volume != nef.volumes_end(); ++volume) {  // the first is the space outside
    if (!volume->mark()) continue;
    Surface piece;
    nef.convert_inner_shell_to_polyhedron(volume->shells_begin(), piece);
    pieces.push_back(rounded(piece));
  }
}

void keep_quiet(const char*, const char*, const char*, int, const char*) {}

}  // namespace

extern "C" __attribute__((visibility("default"))) void voussoir_cut_shape(const ExactShape& shape,
                                                                          std::vector<Polyhedron>& pieces,
                                                                          std::string& trouble) {
  CGAL::set_error_handler(keep_quiet);
  CGAL::set_warning_handler(keep_quiet);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  try {
    cut_into(shape, pieces, trouble);
  } catch (const std::exception& error) {
    trouble = std::string("CGAL cannot cut it: ") + error.what();
  } catch (...) {
    trouble = "CGAL cannot cut it and gives no reason";
  }
}

}  // namespace voussoir

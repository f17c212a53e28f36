// The numbers of view.html.
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/assembly.h"
#include "solver/base/error.h"
#include "viz/colouring.h"
#include "viz/viewer/viewer_pack.h"
#include "viz/viewer/viewer_page.h"

namespace voussoir {

namespace {

constexpr std::size_t kMostForces = 500000;  // pairs × frames: about 2 MB of the page
constexpr double kEdgeAngle = 0.9903;  // cosine of 8 degrees: faces that turn less are one curved face (viz/scene.cpp)

std::string css(const Colour& colour) {
  std::array<int, 3> c{};
  for (std::size_t k = 0; k < 3; ++k) c[k] = int(std::lround(255.0 * std::clamp(colour[k], 0.0, 1.0)));
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

Box box_of(const ViewerScene& scene) {
  Box box;
  const auto take = [&](const Vec3& x) { box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x); };
  for (const ViewerStone& stone : scene.stones)
    for (const Vec3& x : stone.corners) take(x);
  for (const Vec3& x : scene.fill.nodes) take(x);
  return box;
}

/// Edges of flat loops where the two faces meet at an angle, or where there is one face only.
std::vector<std::uint32_t> sharp_edges(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& loops) {
  std::map<std::array<int, 2>, std::vector<Vec3>> normals;
  for (const std::vector<int>& loop : loops) {
    Polygon polygon;
    for (const int v : loop) polygon.push_back(points[std::size_t(v)]);
    const Vec3 normal = polygon_normal(polygon);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      normals[{std::min(a, b), std::max(a, b)}].push_back(normal);
    }
  }
  std::vector<std::uint32_t> edges;
  for (const auto& [edge, of] : normals)
    if (of.size() != 2 || of[0].dot(of[1]) < kEdgeAngle)
      edges.insert(edges.end(), {std::uint32_t(edge[0]), std::uint32_t(edge[1])});
  return edges;
}

/// Corners in 16 bits of the stone's size, triangles and edges by the stone's own corners.
void add_stones(ViewerPack& pack, const ViewerScene& scene, const Vec3& origin) {
  std::vector<float> centres, sizes;
  std::vector<std::int16_t> corners;
  std::vector<std::uint32_t> counts, triangles, edges, kinds;
  for (const ViewerStone& stone : scene.stones) {
    double size = 0.0;
    for (const Vec3& x : stone.corners) size = std::max(size, (x - stone.centre).cwiseAbs().maxCoeff());
    sizes.push_back(coarse_scale(size));
    for (int c = 0; c < 3; ++c) centres.push_back(float(stone.centre[c] - origin[c]));
    for (const Vec3& x : stone.corners)
      for (int c = 0; c < 3; ++c)
        corners.push_back(
            std::int16_t(std::lround(32767.0 * (x[c] - stone.centre[c]) / std::max(1e-30, double(sizes.back())))));
    std::uint32_t count = 0;
    for (const std::vector<int>& loop : stone.faces)
      for (std::size_t k = 2; k < loop.size(); ++k, ++count)
        triangles.insert(triangles.end(), {std::uint32_t(loop[0]), std::uint32_t(loop[k - 1]), std::uint32_t(loop[k])});
    const std::vector<std::uint32_t> own = sharp_edges(stone.corners, stone.faces);
    edges.insert(edges.end(), own.begin(), own.end());
    counts.insert(counts.end(), {std::uint32_t(stone.corners.size()), count, std::uint32_t(own.size() / 2)});
    kinds.insert(kinds.end(), {std::uint32_t(stone.component), std::uint32_t(stone.part), stone.fixed ? 1U : 0U});
  }
  pack.add("centres", centres);
  pack.add("sizes", sizes);
  pack.add("corners", corners);
  pack.add("counts", counts);  // corners, triangles, edges of each stone
  pack.add("triangles", triangles);
  pack.add("edges", edges);
  pack.add("kinds", kinds);  // component, part, fixed
}

void add_fill(ViewerPack& pack, const ViewerFill& fill, const Vec3& origin) {
  std::vector<float> nodes;
  for (const Vec3& x : fill.nodes)
    for (int c = 0; c < 3; ++c) nodes.push_back(float(x[c] - origin[c]));
  std::vector<std::uint32_t> triangles;
  std::vector<std::vector<int>> loops;
  for (const auto& t : fill.triangles) {
    for (const int v : t) triangles.push_back(std::uint32_t(v));
    loops.push_back({t.begin(), t.end()});
  }
  pack.add("fill_nodes", nodes);
  pack.add("fill_triangles", triangles);
  pack.add("fill_edges", sharp_edges(fill.nodes, loops));
}

/// Motions of the stones and, after them, of the nodes of the fill, which do not rotate.
PackedSeries motion_of(const ViewerScene& scene) {
  PackedSeries series{
      .items = scene.stones.size() + scene.fill.nodes.size(), .groups = 2, .width = 3, .steps = 2047, .frames = {}};
  for (const ViewerFrame& frame : scene.frames) {
    std::vector<double> numbers;
    const auto put = [&](const Vec3& u, const Vec3& r) {
      numbers.insert(numbers.end(), {u.x(), u.y(), u.z(), r.x(), r.y(), r.z()});
    };
    for (std::size_t i = 0; i < scene.stones.size(); ++i) put(frame.displacement[i], frame.rotation[i]);
    for (const Vec3& u : frame.fill) put(u, Vec3::Zero());
    series.frames.push_back(std::move(numbers));
  }
  return series;
}

PackedSeries values_of(const ViewerScene& scene) {
  PackedSeries series{.items = scene.stones.size(), .groups = 4, .width = 1, .steps = 2047, .frames = {}};
  for (const ViewerFrame& frame : scene.frames) {
    std::vector<double> numbers(4 * scene.stones.size(), 0.0);
    for (std::size_t i = 0; i < frame.values.size(); ++i)
      std::copy(frame.values[i].begin(), frame.values[i].end(), numbers.begin() + std::ptrdiff_t(4 * i));
    series.frames.push_back(std::move(numbers));
  }
  return series;
}

/// Forces of all frames, or only of the last if all would be too large for a page.
PackedSeries forces_of(const ViewerScene& scene, bool all) {
  PackedSeries series{.items = scene.pairs.size(), .groups = 3, .width = 1, .steps = 2047, .frames = {}};
  for (const ViewerFrame& frame : scene.frames) {
    if (!all && &frame != &scene.frames.back()) continue;
    std::vector<double> numbers(3 * scene.pairs.size(), 0.0);
    for (std::size_t i = 0; i < frame.forces.size(); ++i)
      std::copy(frame.forces[i].begin(), frame.forces[i].end(), numbers.begin() + std::ptrdiff_t(3 * i));
    series.frames.push_back(std::move(numbers));
  }
  return series;
}

/// Quantities for colours: those that are not zero everywhere, with a round upper end of the scale over all frames.
nlohmann::json fields_of(const ViewerScene& scene) {
  struct Field {
    const char *name, *title, *unit;
    double factor;  // from SI into the unit
    int value;      // of ViewerValue; −1: the displacement
  };
  static constexpr Field known[] = {
      {"opening", "largest joint opening since the start", "mm", 1e3, opening_value},
      {"slip", "largest joint slip since the start", "mm", 1e3, slip_value},
      {"displacement", "displacement relative to the ground", "mm", 1e3, -1},
      {"compression", "largest compression of a joint of the stone", "MPa", 1e-6, compression_value},
      {"shear", "largest shear stress of a joint of the stone", "MPa", 1e-6, shear_value}};
  nlohmann::json fields = nlohmann::json::array();
  for (const Field& field : known) {
    const double factor = scene.modes ? 1.0 : field.factor;
    std::vector<double> all;
    for (const ViewerFrame& frame : scene.frames) {
      for (std::size_t i = 0; i < scene.stones.size(); ++i)
        if (!scene.stones[i].fixed && (field.value < 0 || !frame.values.empty()))
          all.push_back(factor *
                        (field.value < 0 ? frame.displacement[i].norm() : frame.values[i][std::size_t(field.value)]));
      if (field.value < 0)
        for (const Vec3& u : frame.fill) all.push_back(factor * u.norm());
    }
    if (std::none_of(all.begin(), all.end(), [](double v) { return v > 0.0; })) continue;
    Colouring scale;
    set_top(scale, all, 0.0);
    fields.push_back({{"name", field.name},
                      {"title", scene.modes ? "displacement, share of the largest" : field.title},
                      {"unit", scene.modes ? "" : field.unit},
                      {"factor", factor},
                      {"value", field.value},
                      {"top", scene.modes ? 1.0 : scale.top}});
  }
  return fields;
}

nlohmann::json colours() {
  nlohmann::json scale = nlohmann::json::array(), components = nlohmann::json::array();
  constexpr int parts = 64;
  for (int k = 0; k <= parts; ++k) scale.push_back(css(scale_colour(double(k) / parts)));
  for (std::size_t c = 0; c < component_names().size(); ++c) components.push_back(css(component_colour(Component(c))));
  return {{"scale", scale},       {"components", components}, {"fixed", css(kFixed)},
          {"stone", css(kStone)}, {"outline", css(kOutline)}, {"picked", css(line_colour(4))}};
}

void check(const ViewerScene& scene) {
  if (scene.stones.empty()) throw InputError("there is nothing to view: the model has no stones");
  if (scene.frames.empty()) throw InputError("there is nothing to view: the run has no frames");
}

}  // namespace

ViewerData viewer_data(const ViewerScene& scene) {
  check(scene);
  const Box box = box_of(scene);
  const Vec3 origin = 0.5 * (box.low + box.high), size = box.high - box.low;
  ViewerPack pack;
  add_stones(pack, scene, origin);
  add_fill(pack, scene.fill, origin);
  pack.add("motion", motion_of(scene));
  pack.add("values", values_of(scene));
  std::vector<std::uint32_t> pairs;
  for (const auto& pair : scene.pairs) pairs.insert(pairs.end(), {std::uint32_t(pair[0]), std::uint32_t(pair[1])});
  pack.add("pairs", pairs);  // the fill is 2³² − 1
  pack.add("forces", forces_of(scene, scene.pairs.size() * scene.frames.size() <= kMostForces));
  nlohmann::json labels = nlohmann::json::array();
  for (const ViewerFrame& frame : scene.frames) labels.push_back(frame.label);
  const bool loaded = std::any_of(scene.frames.begin(), scene.frames.end(), [](const ViewerFrame& frame) {
    return std::any_of(frame.forces.begin(), frame.forces.end(),
                       [](const auto& f) { return f[0] != 0.0 || f[1] != 0.0; });
  });
  return {{{"title", scene.title},
           {"what", scene.what},
           {"modes", scene.modes},
           {"bears", loaded},
           {"origin", {origin.x(), origin.y(), origin.z()}},
           {"size", {size.x(), size.y(), size.z()}},
           {"components", component_names()},
           {"colours", colours()},
           {"fields", fields_of(scene)},
           {"frames", labels},
           {"sections", pack.sections()}},
          pack.compressed()};
}

std::string script_json(const nlohmann::json& json) {
  // In JSON "<" stands in texts only.
  std::string safe;
  for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace voussoir

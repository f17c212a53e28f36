// Contact between the backfill and the masonry around it: lost, or better than thought.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet fill = component(assembly, Component::backfill);
  const BlockSet masonry = where == "spandrels" ? masonry_part(assembly, "spandrels") : masonry_part(assembly, "all");
  scale_joints(assembly, values[0], [&](std::int64_t a, std::int64_t b) {
    return (fill[std::size_t(a)] && masonry[std::size_t(b)]) || (fill[std::size_t(b)] && masonry[std::size_t(a)]);
  });
}

std::vector<std::string> places(const Assembly& assembly) {
  bool fill = false, spandrels = false;
  for (const Block& b : assembly.blocks) {
    fill = fill || b.component == Component::backfill;
    spandrels = spandrels || b.component == Component::spandrel;
  }
  if (!fill) return {};
  return spandrels ? std::vector<std::string>{"all", "spandrels"} : std::vector<std::string>{"all"};
}

}  // namespace

Effect fill_interface() {
  return {"fill_interface",
          "the contact between backfill and masonry is lost, or better than thought",
          {{"factor", "-", "on the stiffness of those joints", 0.01, 10.0, 1.0, 0.3, 0.8, true}},
          places,
          apply,
          nullptr};
}

}  // namespace voussoir

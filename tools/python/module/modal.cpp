// Modes of a case or of the state of a run.
#include "solver/modal/damped_mode.h"
#include "solver/modal/modes.h"
#include "tools/modal/modal_source.h"
#include "tools/python/module/arrays.h"
#include "tools/python/module/module.h"

namespace voussoir::python {

namespace {

struct ModesWanted {
  int count = 10;
  std::string state;  // "intact" or "gravity"; empty: as the case says
  bool geometric = false;
  int threads = 1;

  void operator()(ModalSettings& modal) const {
    if (count > 0) modal.modes = count;
    if (geometric) modal.geometric = true;
    if (!state.empty()) modal.state = state == "gravity" ? ModalSettings::State::gravity : ModalSettings::State::intact;
  }
};

py::dict modes_of(const ModalSource& source) {
  Modes found;
  {
    const py::gil_scoped_release others;
    found = find_modes(source.assembly, source.model, source.state, source.c.settings.modal.modes, source.tangent,
                       source.wrenches ? &*source.wrenches : nullptr);
  }
  const std::vector<Mode>& modes = found.modes;
  py::dict d;
  d["about"] = source.about;
  d["mass"] = found.mass;
  d["frequency"] = column<double>(modes, [](const Mode& mode) { return mode.frequency; });
  d["effective_mass"] = vectors(modes, [](const Mode& mode) { return mode.effective; });
  d["participation"] = vectors(modes, [](const Mode& mode) { return mode.participation; });
  d["modal_mass"] = column<double>(modes, [](const Mode& mode) { return mode.modal_mass; });
  d["damping_ratio"] = column<double>(modes, [&](const Mode& mode) {
    const DampingSettings& damping = source.c.settings.damping;
    return damping.kind == DampingSettings::Kind::none ? 0.0 : damped_mode(damping, mode.frequency).ratio;
  });
  std::vector<std::string> words;
  for (const Mode& mode : modes) words.push_back(mode.words.text());
  d["words"] = words;
  const std::size_t blocks = source.assembly.blocks.size(), nodes = source.assembly.fill.nodes.size();
  py::array_t<double> shapes({modes.size(), blocks, std::size_t(6)}), of_nodes({modes.size(), nodes, std::size_t(3)});
  double *to = shapes.mutable_data(), *to_nodes = of_nodes.mutable_data();
  for (const Mode& mode : modes) {
    to = std::copy_n(mode.shape.data(), blocks * 6, to);
    if (nodes > 0) to_nodes = std::copy_n(mode.nodes.data(), nodes * 3, to_nodes);
  }
  d["shapes"] = shapes;
  d["fill_shapes"] = of_nodes;
  return d;
}

template <class From>
py::dict modal(const From& make_source) {
  std::optional<ModalSource> source;
  {
    const py::gil_scoped_release others;
    source.emplace(make_source());
  }
  return modes_of(*source);
}

}  // namespace

void bind_modal(py::module_& m) {
  m.def("_modal_of_case", [](const Case& c, int count, const std::string& state, bool geometric, int threads) {
    const ModesWanted wanted{count, state, geometric, threads};
    return modal([&] { return modal_source(c, wanted, threads, true); });
  });
  m.def("_modal_of_state", [](const std::string& from, int count, bool geometric, bool as_stored, int threads) {
    const ModesWanted wanted{count, "", geometric, threads};
    return modal([&] { return modal_source(from, wanted, as_stored, threads, true); });
  });
}

}  // namespace voussoir::python

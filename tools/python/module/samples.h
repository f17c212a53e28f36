// The arguments of callbacks as Python dictionaries. All values are in SI units.
#pragma once
#include "solver/run/simulation.h"
#include "tools/python/module/arrays.h"

namespace voussoir::python {

inline py::dict energies_of(const Energies& energies) {
  py::dict d;
  for (const auto& [name, term] : energy_terms()) d[name] = energies.*term;
  return d;
}

inline py::array_t<double> array_of(const Vec3& v) {
  return table<double>(3, 0, [&](std::size_t i, std::size_t) { return v[Eigen::Index(i)]; });
}

inline py::dict sample_of(const Simulation& run, const Sample& s) {
  py::dict d, reactions;
  for (std::size_t i = 0; i < s.reactions.size(); ++i)
    reactions[run.held_groups()[i].c_str()] = array_of(s.reactions[i]);
  d["time"] = s.time;
  d["stage"] = s.stage;
  d["energies"] = energies_of(s.energies);
  d["balance_error"] = s.balance_error;
  d["base_displacement"] = array_of(s.base_displacement);
  d["base_acceleration"] = array_of(s.base_acceleration);
  d["contacts"] = s.contacts;
  d["reactions"] = reactions;
  d["accelerations"] = column<double>(s.accelerations, [](double a) { return a; });
  d["multiplier"] = s.step.multiplier;
  d["displacement"] = s.step.displacement;
  d["force"] = s.step.force;
  return d;
}

inline py::dict progress_of(const Progress& p) {
  py::dict d;
  d["stage"] = p.stage, d["timed"] = p.timed, d["time"] = p.time, d["end"] = p.end;
  d["share"] = p.share, d["speed"] = p.speed, d["left"] = p.left, d["note"] = p.note;
  return d;
}

}  // namespace voussoir::python

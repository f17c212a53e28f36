// voussoir-bench-fields: the cost of writing a set of fields for ParaView from a checkpoint of a run, with each
// compression.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>

#include "io/case/case.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/checkpoint_file.h"
#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/program.h"
#include "solver/contact/grouping.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {
namespace {

namespace fs = std::filesystem;
constexpr int repeats = 5;

template <class F>
double seconds_of(const F& work) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

/// The newest checkpoint of a run directory.
struct Stored {
  Assembly assembly;
  Model model;
  State state;
};
Stored read_stored(const std::string& directory) {
  const Case c = read_case(directory + "/case.toml");
  Stored s{read_assembly(directory + "/assembly.h5"), {}, {}};
  s.model = build_model(s.assembly, c.settings);
  s.state = initial_state(s.model);
  const std::vector<std::string> files = list_checkpoints(directory + "/checkpoints");
  if (files.empty()) throw InputError("{} has no checkpoint", directory);
  CheckpointHeader header;
  read_checkpoint(files.front(), header, s.state.arrays());
  s.state.unpack(s.model);
  take_joint_order(s.model, s.state);
  fmt::print("{}: t = {:.3f} s, {}, {}, {}, {}; medians of {}\n", files.front(), s.state.time(),
             counted(s.assembly.blocks.size(), "block"), counted(s.assembly.joints.size(), "joint"),
             counted(s.state.contact_count(), "contact"),
             counted(s.assembly.fill.tets.size(), "tetrahedron", "tetrahedra"), repeats);
  return s;
}

int run(int argc, char** argv) {
  if (argc != 2) throw InputError("the run directory is missing. Usage: voussoir-bench-fields DIR");
  const Stored s = read_stored(argv[1]);
  Snapshot snapshot;
  fmt::print("{:<28} {:>8.3f} s\n", "snapshot", seconds_of([&] { snapshot = make_snapshot(s.model, s.state); }));
  vtkSmartPointer<vtkUnstructuredGrid> blocks, fill;
  vtkSmartPointer<vtkPolyData> joints;
  fmt::print("{:<28} {:>8.3f} s\n", "grid of the blocks",
             seconds_of([&] { blocks = block_grid(s.assembly, snapshot); }));
  fmt::print("{:<28} {:>8.3f} s\n", "polygons of the joints",
             seconds_of([&] { joints = joint_polydata(s.assembly, snapshot); }));
  if (!snapshot.fill.empty())
    fmt::print("{:<28} {:>8.3f} s\n", "grid of the fill", seconds_of([&] { fill = fill_grid(s.assembly, snapshot); }));
  const fs::path folder = fs::temp_directory_path() / fmt::format("voussoir-bench-fields-{}", ::getpid());
  const std::array<std::string, 3> names = {(folder / "b.vtu").string(), (folder / "j.vtp").string(),
                                            (folder / "f.vtu").string()};
  for (const auto& [packing, name] : {std::pair{Packing::none, "none"},
                                      {Packing::lz4, "LZ4"},
                                      {Packing::zlib_fast, "zlib, level 1"},
                                      {Packing::zlib, "zlib, default level of VTK (5)"}}) {
    const double writing = seconds_of([&, packing = packing] {
      write_vtu(blocks, names[0], packing);
      write_vtp(joints, names[1], packing);
      if (fill) write_vtu(fill, names[2], packing);
    });
    const double reading = seconds_of([&] {
      read_vtu(names[0]);
      read_vtp(names[1]);
      if (fill) read_vtu(names[2]);
    });
    std::uintmax_t bytes = 0;
    for (const std::string& file : names)
      if (fs::exists(file)) bytes += fs::file_size(file);
    fmt::print("{:<28} {:>8.3f} s {:>8.1f} MB, read back in {:.3f} s\n", fmt::format("written, {}", name), writing,
               1e-6 * double(bytes), reading);
  }
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-bench-fields", voussoir::run, argc, argv);
}

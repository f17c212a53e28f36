// The frames of a run for ParaView: DIR/vtk/blocks.pvd and joints.pvd with one .vtu and one .vtp a frame, and fill.pvd
// with one more .vtu where there is a deformable fill.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "io/vtk/packing.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// A .pvd collection: which file shows which time. Rewritten whole after each change, so that a reader never meets
/// half.
class PvdSeries {
 public:
  struct Frame {
    double time = 0.0;  // s
    std::string file;   // relative to the folder of the .pvd
  };
  /// Loads the frames of an existing file; a missing one means no frames. Throws InputError when it is not a .pvd.
  explicit PvdSeries(std::string path);

  /// Adds a frame and rewrites the file. Times ascend: one at the time of the frame before, or earlier, is entered a
  /// microsecond after it, so that ParaView shows both ends of two stages that take no time. Throws RunError when that
  /// fails.
  void add(double time, const std::string& file);
  /// Drops all frames but the first `count`, as when a run resumes from an earlier checkpoint, and rewrites the file.
  void keep_first(std::size_t count);

  const std::vector<Frame>& frames() const { return frames_; }
  /// The file of the frame of exactly this time (s), as seen from the working folder; empty when there is none.
  std::string file_at(double time) const;
  const std::string& path() const { return path_; }
  std::string file_path(const Frame& frame) const;  // as seen from the working folder

 private:
  void write() const;
  std::string path_;
  std::vector<Frame> frames_;  // ascending in time
};

/// The series of a run directory. The first frame of a fresh run and the first after a resume go the same way.
class VtkSeries {
 public:
  explicit VtkSeries(const std::string& run_directory, Packing packing = usual_packing);
  /// Forgets all frames but the first `count`.
  void keep_first(std::size_t count);
  /// Writes vtk/blocks_000012.500.vtu, vtk/joints_000012.500.vtp and, with a fill, vtk/fill_000012.500.vtu, each in a
  /// thread while there are some, and adds them to the series; another frame of the same millisecond gets _2 behind its
  /// time. Throws RunError when one cannot be written.
  void write(const Assembly& assembly, const Snapshot& snapshot, int threads = 1);

  const PvdSeries& blocks() const { return blocks_; }
  const PvdSeries& joints() const { return joints_; }
  const PvdSeries& fill() const { return fill_; }

 private:
  PvdSeries blocks_, joints_, fill_;
  Packing packing_;
};

}  // namespace voussoir

// The frames of a run for ParaView: DIR/vtk/blocks.pvd and joints.pvd with one .vtu and one .vtp for each frame, and
// fill.pvd with a further .vtu if there is a deformable fill.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "io/vtk/packing.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// A .pvd collection: the files of the frames with their times. It is written atomically after each change.
class PvdSeries {
 public:
  struct Frame {
    double time = 0.0;  // s
    std::string file;   // relative to the folder of the .pvd
  };
  /// Loads the frames of an existing file; without the file there are no frames. Throws InputError if it is not a .pvd.
  explicit PvdSeries(std::string path);

  /// Adds a frame and writes the file. Times ascend: a frame less than a microsecond later than the previous one gets a
  /// time one microsecond after it, so that ParaView shows the ends of stages without duration. Throws RunError.
  void add(double time, const std::string& file);
  /// Keeps only the first `count` frames, for a restart from an earlier checkpoint, and writes the file.
  void keep_first(std::size_t count);

  const std::vector<Frame>& frames() const { return frames_; }
  /// The path of the file of the frame at exactly this time (s), relative to the working folder; empty if there is
  /// none.
  std::string file_at(double time) const;
  const std::string& path() const { return path_; }
  std::string file_path(const Frame& frame) const;  // relative to the working folder

 private:
  void write() const;
  std::string path_;
  std::vector<Frame> frames_;  // ascending in time
};

/// The series of a run directory, for new and for resumed runs.
class VtkSeries {
 public:
  explicit VtkSeries(const std::string& run_directory, Packing packing = usual_packing);
  /// Keeps only the first `count` frames.
  void keep_first(std::size_t count);
  /// Writes vtk/blocks_000012.500.vtu, vtk/joints_000012.500.vtp and, with a fill, vtk/fill_000012.500.vtu, each in its
  /// own thread if there are enough, and adds them to the series. A second frame of the same millisecond gets _2 after
  /// its time. Throws RunError if a file cannot be written.
  void write(const Assembly& assembly, const Snapshot& snapshot, int threads = 1);

  const PvdSeries& blocks() const { return blocks_; }
  const PvdSeries& joints() const { return joints_; }
  const PvdSeries& fill() const { return fill_; }

 private:
  PvdSeries blocks_, joints_, fill_;
  Packing packing_;
};

}  // namespace voussoir

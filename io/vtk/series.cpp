#include "io/vtk/series.h"

#include <vtkCommand.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "io/vtk/quiet.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/parallel.h"

namespace voussoir {
namespace {

namespace fs = std::filesystem;
constexpr double least_apart = 1e-6;  // s, between frames

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::vector<PvdSeries::Frame> read_frames(const std::string& path) {
  bool failed = false;
  auto parser = vtkSmartPointer<vtkXMLDataParser>::New();
  parser->AddObserver(vtkCommand::ErrorEvent, error_flag(failed));
  parser->SetFileName(path.c_str());
  vtkXMLDataElement* root = parser->Parse() && !failed ? parser->GetRootElement() : nullptr;
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
    throw InputError("{}: is not a ParaView collection (.pvd). Remove it; the frames remain readable.", path);
  std::vector<PvdSeries::Frame> frames;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    PvdSeries::Frame frame;
    const char* file = entry->GetAttribute("file");
    if (!file || !entry->GetScalarAttribute("timestep", frame.time))
      throw InputError("{}: entry {} has no file or no timestep. Remove the .pvd; the frames remain readable.", path,
                       i);
    frame.file = file;
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace

PvdSeries::PvdSeries(std::string path) : path_(std::move(path)) {
  if (fs::exists(path_)) frames_ = read_frames(path_);
}

void PvdSeries::add(double time, const std::string& file) {
  frames_.push_back({frames_.empty() ? time : std::max(time, frames_.back().time + least_apart), file});
  write();
}

void PvdSeries::keep_first(std::size_t count) {
  if (count >= frames_.size()) return;
  frames_.resize(count);
  write();
}

std::string PvdSeries::file_path(const Frame& frame) const {
  return (fs::path(path_).parent_path() / frame.file).string();
}

std::string PvdSeries::file_at(double time) const {
  for (const Frame& frame : frames_)
    if (frame.time == time) return file_path(frame);
  return {};
}

void PvdSeries::write() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (const Frame& frame : frames_)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, escaped(frame.file));
  text += "  </Collection>\n</VTKFile>\n";
  make_folder_of(path_);
  write_atomically(path_, text);
}

VtkSeries::VtkSeries(const std::string& run_directory, Packing packing)
    : blocks_((fs::path(run_directory) / "vtk" / "blocks.pvd").string()),
      joints_((fs::path(run_directory) / "vtk" / "joints.pvd").string()),
      fill_((fs::path(run_directory) / "vtk" / "fill.pvd").string()),
      packing_(packing) {}

void VtkSeries::keep_first(std::size_t count) {
  blocks_.keep_first(count);
  joints_.keep_first(count);
  fill_.keep_first(count);
}

void VtkSeries::write(const Assembly& assembly, const Snapshot& snapshot, int threads) {
  struct Part {
    PvdSeries* series;
    std::string file;
    std::function<void(const std::string& path)> write;
  };
  const std::vector<PvdSeries::Frame>& before = blocks_.frames();
  const auto taken = [&](const std::string& file) {
    return std::any_of(before.begin(), before.end(), [&](const PvdSeries::Frame& f) { return f.file == file; });
  };
  std::string suffix;
  for (int i = 2; taken(fmt::format("blocks_{:010.3f}{}.vtu", snapshot.time, suffix)); ++i)
    suffix = fmt::format("_{}", i);
  const auto name = [&](const char* of, const char* kind) {
    return fmt::format("{}_{:010.3f}{}.{}", of, snapshot.time, suffix, kind);
  };
  std::vector<Part> parts = {{&joints_, name("joints", "vtp"),
                              [&](const auto& path) { write_vtp(joint_polydata(assembly, snapshot), path, packing_); }},
                             {&blocks_, name("blocks", "vtu"),
                              [&](const auto& path) { write_vtu(block_grid(assembly, snapshot), path, packing_); }}};
  if (!snapshot.fill.empty())
    parts.push_back({&fill_, name("fill", "vtu"),
                     [&](const auto& path) { write_vtu(fill_grid(assembly, snapshot), path, packing_); }});
  const fs::path folder = fs::path(blocks_.path()).parent_path();
  for_each(parts.size(), threads, 1, [&](std::size_t i) { parts[i].write((folder / parts[i].file).string()); });
  for (const Part& part : parts) part.series->add(snapshot.time, part.file);
}

}  // namespace voussoir

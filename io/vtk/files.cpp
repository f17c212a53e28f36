#include "io/vtk/files.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <filesystem>
#include <new>

#include "io/vtk/quiet.h"
#include "io/vtk/sound.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"

namespace voussoir {
namespace {

void set_packing(vtkXMLWriter* writer, Packing packing) {
  switch (packing) {
    case Packing::none:
      return writer->SetCompressorTypeToNone();
    case Packing::lz4:
      return writer->SetCompressorTypeToLZ4();
    case Packing::zlib_fast:
      writer->SetCompressorTypeToZLib();
      return writer->SetCompressionLevel(1);
    case Packing::zlib:
      return writer->SetCompressorTypeToZLib();
  }
}

/// VTK makes the bytes and the program writes them, because VTK prints errors of a disk to the terminal.
template <class Writer, class Data>
void write(Data* data, const std::string& path, Packing packing) {
  make_folder_of(path);
  bool failed = false;
  auto writer = vtkSmartPointer<Writer>::New();
  writer->AddObserver(vtkCommand::ErrorEvent, error_flag(failed));
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  set_packing(writer, packing);
  if (writer->Write() == 0 || failed || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw RunError("{}: VTK could not write the file", path);
  write_atomically(path, writer->GetOutputString());
}

template <class Reader>
auto read(const std::string& path, const char* kind) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError("{}: there is no such file. Give a {} file.", path, kind);
  const Silence silence;
  bool failed = false;
  const auto flag = error_flag(failed);
  auto reader = vtkSmartPointer<Reader>::New();
  reader->AddObserver(vtkCommand::ErrorEvent, flag);
  if (!reader->CanReadFile(path.c_str())) throw InputError("{}: is not a {} file", path, kind);
  if (!head_is_sound(path)) throw InputError("{}: is damaged and cannot be read; write it again", path);
  reader->SetFileName(path.c_str());
  reader->SetReaderErrorObserver(flag);
  reader->SetParserErrorObserver(flag);
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {  // a damaged count
    failed = true;
  }
  if (failed || reader->GetErrorCode() != vtkErrorCode::NoError)
    throw InputError("{}: is damaged and cannot be read; write it again", path);
  vtkSmartPointer output = reader->GetOutput();
  if (!is_sound(output)) throw InputError("{}: is damaged: its parts do not agree; write it again", path);
  return output;
}

}  // namespace

Packing packing_of(const std::string& word) {
  if (word == "lz4") return Packing::lz4;
  if (word == "zlib") return Packing::zlib_fast;
  if (word == "none") return Packing::none;
  throw InputError("--compression is '{}'. It must be lz4, zlib or none.", word);
}

void write_vtu(vtkUnstructuredGrid* grid, const std::string& path, Packing packing) {
  write<vtkXMLUnstructuredGridWriter>(grid, path, packing);
}
void write_vtp(vtkPolyData* data, const std::string& path, Packing packing) {
  write<vtkXMLPolyDataWriter>(data, path, packing);
}

vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::string& path) {
  return read<vtkXMLUnstructuredGridReader>(path, ".vtu");
}
vtkSmartPointer<vtkPolyData> read_vtp(const std::string& path) {
  return read<vtkXMLPolyDataReader>(path, ".vtp");
}

}  // namespace voussoir

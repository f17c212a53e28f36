// How the fuzzer of HDF5 assemblies changes its inputs: anywhere but in the superblock, without which HDF5 reads
// nothing. It begins with an assembly of its own, so that its corpus may be empty.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "geometry/joints.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/atomic_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace voussoir;

constexpr std::size_t superblock = 96;  // bytes, of version 0

/// A stone on a fixed one, as a file.
std::string seed() {
  Assembly assembly;
  assembly.materials = {{"stone", 2000.0, 4e9, 1.6e9, 0.0, 0.0, 0.5}};
  for (int i = 0; i < 2; ++i) {
    Block block;
    block.cells = {make_box(Vec3(0, 0, i), Vec3(1, 1, i + 1))};
    block.fixed = i == 0;
    assembly.blocks.push_back(block);
  }
  assembly.groups["base"] = {0};
  assembly.sensors = {{"s", Vec3(0.5, 0.5, 1.5), Vec3(1, 0, 0), 1}};
  finish_blocks(assembly);
  const std::string path = (std::filesystem::temp_directory_path() / fmt::format("seed-{}.h5", ::getpid())).string();
  write_assembly(path, assembly);
  const std::string bytes = read_text(path);
  std::filesystem::remove(path);
  return bytes;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned int) {
  static const std::string own = seed();
  const bool is_hdf5 = size > superblock && std::memcmp(data, own.data(), 8) == 0;
  if (!is_hdf5) {
    if (own.size() > most) return size;
    std::copy(own.begin(), own.end(), data);
    size = own.size();
  }
  return superblock + LLVMFuzzerMutate(data + superblock, size - superblock, most - superblock);
}

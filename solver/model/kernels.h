// The innermost loops of a time step, compiled for several instruction sets in one program. The set is chosen when the
// program starts.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace voussoir {

struct Model;
struct State;
struct PatchPass;
struct PassReport;
struct FillModel;
struct FillMemory;
struct FillPass;
struct FillReport;
struct BodyPass;
struct BodyReport;

/// Table of functions. The arguments are those of the member functions with the same names.
struct Kernels {
  const char* name;          // for VOUSSOIR_KERNELS: "sse2", "avx2", "avx512" or "plain"
  const char* instructions;  // in words: "AVX-512"
  PassReport (*joints)(const PatchPass& pass, std::size_t tile);
  PassReport (*contacts)(const PatchPass& pass, std::size_t tile, const std::int32_t* begin, const std::int32_t* end);
  bool (*interface)(const PatchPass& pass, std::size_t tile);
  void (*volumes)(const FillPass& pass, std::size_t tile);
  void (*means)(const FillPass& pass, std::size_t tile);
  FillReport (*stresses)(const FillPass& pass, std::size_t tile);
  FillReport (*nodes)(const FillPass& pass, std::size_t tile);
  BodyReport (*bodies)(const BodyPass& pass, std::size_t begin, std::size_t end);
  void (*list_pairs)(const Model& model, State& state, const std::vector<char>& stale, int threads);
  std::vector<std::array<double, 6>> (*cauchy_stress)(const FillModel& fill, const FillMemory& memory);
};

/// The kernels in use: those named by the environment variable VOUSSOIR_KERNELS, else the widest that this processor
/// supports. They are chosen at the first call. Throws InputError, which lists the usable names, for a name that this
/// program does not contain or this processor does not support.
const Kernels& kernels();

/// The kernels that this program contains and this processor supports, from the narrowest to the widest.
std::vector<const Kernels*> usable_kernels();

}  // namespace voussoir

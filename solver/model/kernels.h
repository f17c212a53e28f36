// The innermost loops of a step, compiled for several instruction sets in one program; which one is at work is settled
// when the program starts.
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

/// What is called through a table; arguments as the member functions of the same names have them.
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

/// Those at work: the environment's VOUSSOIR_KERNELS, else the widest that this processor runs. Settled at the first
/// call. Throws InputError for a name that this program does not have, or that the processor does not run, naming those
/// that there are.
const Kernels& kernels();

/// Those that this program holds and this processor runs, from the narrowest to the widest.
std::vector<const Kernels*> usable_kernels();

}  // namespace voussoir

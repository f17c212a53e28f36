// The table of one instruction set. Compiled with the kernels themselves once for each set, with VOUSSOIR_KERNEL_TABLE
// as the name of its table, which is all that is seen of them from outside (tools/kernels.cmake).
#include "solver/contact/pairs.h"
#include "solver/contact/patch_kernel.h"
#include "solver/fill/fill_pass.h"
#include "solver/fill/tet_stress.h"
#include "solver/model/kernels.h"
#include "solver/step/body_pass.h"

#ifndef VOUSSOIR_KERNEL_TABLE
#define VOUSSOIR_KERNEL_TABLE voussoir_kernels_plain
#endif

// What lanes.h makes of the instructions that it is allowed.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512BW__) && defined(__BMI2__)
#define VOUSSOIR_KERNEL_NAME "avx512"
#define VOUSSOIR_KERNEL_WORDS "AVX-512"
#elif defined(__AVX2__)
#define VOUSSOIR_KERNEL_NAME "avx2"
#define VOUSSOIR_KERNEL_WORDS "AVX2"
#elif defined(__SSE2__)
#define VOUSSOIR_KERNEL_NAME "sse2"
#define VOUSSOIR_KERNEL_WORDS "SSE2"
#else
#define VOUSSOIR_KERNEL_NAME "plain"
#define VOUSSOIR_KERNEL_WORDS "plain C++"
#endif

extern "C" const voussoir::Kernels VOUSSOIR_KERNEL_TABLE;

extern "C" const voussoir::Kernels VOUSSOIR_KERNEL_TABLE = {
    VOUSSOIR_KERNEL_NAME,
    VOUSSOIR_KERNEL_WORDS,
    [](const voussoir::PatchPass& pass, std::size_t tile) { return pass.joints(tile); },
    [](const voussoir::PatchPass& pass, std::size_t tile, const std::int32_t* begin, const std::int32_t* end) {
      return pass.contacts(tile, begin, end);
    },
    [](const voussoir::PatchPass& pass, std::size_t tile) { return pass.interface(tile); },
    [](const voussoir::FillPass& pass, std::size_t tile) { pass.volumes(tile); },
    [](const voussoir::FillPass& pass, std::size_t tile) { pass.means(tile); },
    [](const voussoir::FillPass& pass, std::size_t tile) { return pass.stresses(tile); },
    [](const voussoir::FillPass& pass, std::size_t tile) { return pass.nodes(tile); },
    [](const voussoir::BodyPass& pass, std::size_t begin, std::size_t end) { return pass.bodies(begin, end); },
    voussoir::list_pairs,
    voussoir::cauchy_stress};

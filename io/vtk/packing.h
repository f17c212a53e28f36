// How the numbers of VTK files are packed.
#pragma once
#include <string>

namespace voussoir {

/// VTK 8.1 and ParaView 5.5 or later read all of them, other readers (meshio) not LZ4. What each costs:
/// docs/developer/performance-notes.md, "Output".
enum class Packing { none, lz4, zlib_fast, zlib };
constexpr Packing usual_packing = Packing::lz4;

/// "lz4", "zlib" (at its fast level) or "none". Throws InputError for another word.
Packing packing_of(const std::string& word);

}  // namespace voussoir

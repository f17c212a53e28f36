// Compression of the numbers in VTK files.
#pragma once
#include <string>

namespace voussoir {

/// VTK 8.1 and ParaView 5.5 or later read all of them; other readers (meshio) do not read LZ4. For their costs see
/// docs/developer/performance-notes.md, "Output".
enum class Packing { none, lz4, zlib_fast, zlib };
constexpr Packing usual_packing = Packing::lz4;

/// "lz4", "zlib" (at its fast level) or "none". Throws InputError for another word.
Packing packing_of(const std::string& word);

}  // namespace voussoir

#include "viz/arrangement_picture.h"

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "viz/chart_picture.h"

namespace voussoir {

void write_arrangement(const Assembly& assembly, const ArrangementNotes& notes, const std::string& stem) {
  if (assembly.blocks.empty() && assembly.fill.empty()) throw InputError("{}: there is nothing to draw", notes.name);
  const Arrangement arrangement(assembly, notes);
  make_folder_of(stem + ".svg");
  write_atomically(stem + ".svg", arrangement.svg());
  write_picture([&](Drawing& drawing) { arrangement.draw(drawing); }, arrangement.width(), arrangement.height(),
                stem + ".png", arrangement.pixels());
}

}  // namespace voussoir

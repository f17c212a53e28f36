#include "viz/arrangement_picture.h"

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "viz/page/cairo_drawing.h"

namespace voussoir {

void write_arrangement(const Assembly& assembly, const ArrangementNotes& notes, const std::string& stem) {
  if (assembly.blocks.empty() && assembly.fill.empty()) throw InputError("{}: there is nothing to draw", notes.name);
  const Arrangement arrangement(assembly, notes);
  make_folder_of(stem + ".svg");
  write_atomically(stem + ".svg", arrangement.svg());
  const DrawOn draw_on = [&](Drawing& drawing) { arrangement.draw(drawing); };
  write_pdf({draw_on}, arrangement.width(), arrangement.height(), stem + ".pdf");
  write_png(draw_on, arrangement.width(), arrangement.height(), stem + ".png", arrangement.pixels());
}

}  // namespace voussoir

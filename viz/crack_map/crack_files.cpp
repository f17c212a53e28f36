#include "viz/crack_map/crack_files.h"

#include "solver/base/atomic_file.h"
#include "solver/base/folder.h"
#include "viz/page/cairo_drawing.h"

namespace voussoir {

std::vector<std::string> write_crack_map(const CrackMap& map, const std::vector<CrackState>& states,
                                         const std::vector<std::string>& formats, const std::string& stem) {
  std::vector<std::string> files;
  make_folder_of(stem);
  for (const std::string& format : formats) {
    std::vector<DrawOn> pages;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const CrackState state = states[i];
      const std::string file = stem + (i == 0 ? "." : "_now.") + format;
      pages.push_back([&map, state](Drawing& drawing) { map.draw(drawing, state); });
      if (format == "pdf" && i > 0) continue;
      files.push_back(file);
      if (format == "svg") write_atomically(file, map.svg(state));
      if (format == "png") write_png(pages.back(), map.width(), map.height(), file, map.pixels());
    }
    if (format == "pdf") write_pdf(pages, map.width(), map.height(), stem + ".pdf");
  }
  return files;
}

}  // namespace voussoir

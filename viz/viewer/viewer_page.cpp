#include "viz/viewer/viewer_page.h"

#include "solver/base/error.h"
#include "viz/page/base64.h"
#include "viz/page/svg.h"
#include "viz/viewer/viewer_files.h"

namespace voussoir {

bool has_viewer() {
  return !viewer_files::three.empty();
}

void require_viewer() {
  if (!has_viewer())
    throw RunError(
        "this program was built without three.js, which these pages need. Install the Debian package libjs-three, or "
        "give its three.min.js and licence by cmake -DVOUSSOIR_THREE=FILE -DVOUSSOIR_THREE_LICENCE=FILE, and build "
        "again");
}

std::string viewer_page(const ViewerScene& scene) {
  require_viewer();
  const ViewerData data = viewer_data(scene);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n",
      escaped(scene.title));
  page.append(viewer_files::style).append("</style>\n</head>\n<body>\n").append(viewer_files::body);
  page.append("<script id=\"licence\" type=\"text/plain\">\n")
      .append(viewer_files::licence)
      .append("</script>\n<script>\n");
  page.append(viewer_files::three).append("\n</script>\n<script id=\"scene\" type=\"application/json\">");
  page.append(script_json(data.scene)).append("</script>\n<script id=\"numbers\" type=\"text/plain\">");
  page.append(base64(data.bytes)).append("</script>\n<script>\n\"use strict\";\n");
  return page.append(viewer_files::program).append("</script>\n</body>\n</html>\n");
}

}  // namespace voussoir

// view.html: a page that shows a scene in three dimensions, to turn and to ask. One file, with three.js (MIT) in it.
#pragma once
#include <nlohmann/json.hpp>

#include "viz/viewer/viewer_scene.h"

namespace voussoir {

/// Whether three.js was there when the program was built.
bool has_viewer();

/// Throws RunError, which says what to install, where it was not.
void require_viewer();

/// The page. Throws as require_viewer(), InputError for a scene
/// without stones or without frames.
std::string viewer_page(const ViewerScene& scene);

/// The numbers of a scene as the page holds them: what it is in words and where the numbers lie ("sections"), and the
/// compressed bytes. For tests.
struct ViewerData {
  nlohmann::json scene;
  std::string bytes;
};
ViewerData viewer_data(const ViewerScene& scene);

/// JSON that can stand inside a script element whatever its texts are.
std::string script_json(const nlohmann::json& json);

}  // namespace voussoir

// view.html: an interactive page with a scene in three dimensions. One file that contains three.js (MIT).
#pragma once
#include <nlohmann/json.hpp>

#include "viz/viewer/viewer_scene.h"

namespace voussoir {

/// Whether three.js was found during the build.
bool has_viewer();

/// Throws RunError that says what to install if it was not found.
void require_viewer();

/// The page. Throws like require_viewer(), and InputError for a scene without stones or without frames.
std::string viewer_page(const ViewerScene& scene);

/// The data of a scene in the page: a JSON description with the position of the numbers ("sections"), and the
/// compressed bytes. For tests.
struct ViewerData {
  nlohmann::json scene;
  std::string bytes;
};
ViewerData viewer_data(const ViewerScene& scene);

/// JSON that is safe inside a script element for any texts.
std::string script_json(const nlohmann::json& json);

}  // namespace voussoir

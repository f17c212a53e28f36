// The page of a rating.
#pragma once
#include <string>

#include "tools/rate/passages.h"
#include "viz/page/html.h"

namespace voussoir {

/// Texts and pictures of the page.
struct RatePageWords {
  std::string title;        // "Rating: prestwood"
  std::string beside = {};  // results of another method; may be empty
  std::vector<PassageSeries> passages = {};
  std::vector<std::string> remarks;   // assumptions of the loading
  std::vector<PagePicture> pictures;  // pictures of the worst place
  std::string thrust = {};            // thrust_chart() of the worst place; may be empty
};

/// Adequacy factor against the position of the middle of the axles: one curve for each vehicle, lane and direction, as
/// SVG. A circle is a limit, a triangle a lower bound (RatedPlace::found is false).
std::string influence_chart(const Rating& rating, const RateRequest& request);

std::string rate_page(const Rating& rating, const RateRequest& request, const RatePageWords& words);

}  // namespace voussoir

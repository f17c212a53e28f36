// The page of a rating.
#pragma once
#include <string>

#include "tools/rate/passages.h"
#include "viz/page/html.h"

namespace voussoir {

/// What is said beside the figures.
struct RatePageWords {
  std::string title;        // "Rating: prestwood"
  std::string beside = {};  // another method's figures; may be empty
  std::vector<PassageSeries> passages = {};
  std::vector<std::string> remarks;   // how the bridge was loaded
  std::vector<PagePicture> pictures;  // of the worst place
  std::string thrust = {};            // thrust_chart() of the worst place; may be empty
};

/// Adequacy factor over where the middle of the axles is: one curve a vehicle, lane and direction. As SVG.
std::string influence_chart(const Rating& rating, const RateRequest& request);

std::string rate_page(const Rating& rating, const RateRequest& request, const RatePageWords& words);

}  // namespace voussoir

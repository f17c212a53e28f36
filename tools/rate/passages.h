// Repeated passages of a vehicle: whether what they do to a bridge settles or goes on.
#pragma once
#include "tools/rate/rate.h"

namespace voussoir {

/// The bridge after a passage, without the vehicle.
struct AfterPassage {
  double crown = 0.0;    // m, displacement downwards of the crown that has gone farthest since gravity
  double opening = 0.0;  // m, of the joint that stands open most
  double slip = 0.0;     // m, of the joint that has slid most, since the start
  double slips = 0.0;    // m, sum of all joints' slip weighted by area over all area
  double plastic = 0.0;  // mean plastic shear strain of the fill
  double largest = 0.0;  // m, displacement of the stone that has gone farthest since gravity
};

enum class PassageEnd { settles, grows, collapses, undecided };
/// "settles", "grows", "collapses", "undecided".
const char* passage_word(PassageEnd end);

struct PassageSeries {
  double factor = 0.0;
  std::vector<AfterPassage> after;  // of each passage; the first entry is the bridge before any
  PassageEnd end = PassageEnd::undecided;
};

struct PassageRequest {
  RateRequest rate;  // its first vehicle, first lane
  int passages = 10;
  int places = 12;  // at which the vehicle stands in turn, evenly over its way
  std::vector<double> factors;
  double settled = 1e-6;  // m a passage: less is none
};

/// Drives the vehicle over the bridge so many times with each factor: at one place after the other the bridge is
/// brought to equilibrium, and at the end of each passage without the vehicle. In the order of the factors.
std::vector<PassageSeries> passages(const Case& c, const Assembly& assembly, const PassageRequest& request,
                                    const std::function<void(const std::string&)>& say);

/// How increments of the displacement of a series end (docs/theory/shakedown.md).
PassageEnd judge(const std::vector<AfterPassage>& after, double settled);

/// The factors in ascending order: the last of those that settle and the first that does not, against the adequacy
/// factor.
std::string passages_text(const std::vector<PassageSeries>& all, double adequacy);
std::string passages_csv(const std::vector<PassageSeries>& all);
/// Displacement over the number of passages: one curve a factor. As SVG.
std::string ratchet_chart(const std::vector<PassageSeries>& all);

}  // namespace voussoir

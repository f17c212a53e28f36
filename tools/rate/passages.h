// Repeated passages of a vehicle: whether the displacements settle or grow (shakedown).
#pragma once
#include "tools/rate/rate.h"

namespace voussoir {

/// The bridge after a passage, without the vehicle.
struct AfterPassage {
  double crown = 0.0;    // m, displacement of the crown that moved most since gravity, downwards positive
  double opening = 0.0;  // m, largest present opening of a joint
  double slip = 0.0;     // m, largest present slip of a joint
  double slips = 0.0;    // m, mean present slip of all joints, weighted by area
  double plastic = 0.0;  // mean plastic shear strain of the fill
  double largest = 0.0;  // m, largest displacement of a stone since gravity
};

enum class PassageEnd { settles, grows, collapses, undecided };
/// "settles", "grows", "collapses", "undecided".
const char* passage_word(PassageEnd end);

struct PassageSeries {
  double factor = 0.0;
  std::vector<AfterPassage> after;  // after each passage; the first entry is the bridge before the first passage
  PassageEnd end = PassageEnd::undecided;
};

struct PassageRequest {
  RateRequest rate;  // uses its first vehicle and first lane
  int passages = 10;
  int places = 12;            // number of places of the vehicle in a passage, at equal distances
  bool towards_right = true;  // direction of all passages: along +x
  std::vector<double> factors;
  double settled = 1e-6;                    // m per passage; smaller increments count as none
  const std::atomic<bool>* stop = nullptr;  // set by a signal
};

/// The places of the front of the vehicle in one passage (x in m), in the order of travel.
std::vector<double> fronts_of_passage(const std::vector<SpanExtent>& spans, const PassageRequest& request);

/// Drives the vehicle over the bridge repeatedly with each factor. The bridge is brought to equilibrium with the
/// vehicle at one place after the other, and without the vehicle at the end of each passage. The results are in the
/// order of the factors; there are none if it was stopped.
std::vector<PassageSeries> passages(const Case& c, const Assembly& assembly, const PassageRequest& request,
                                    const std::function<void(const std::string&)>& say);

/// The end state of the displacement increments of a series (docs/theory/shakedown.md).
PassageEnd judge(const std::vector<AfterPassage>& after, double settled);

/// Text for factors in ascending order: the last that settles and the first that does not, compared with the adequacy
/// factor.
std::string passages_text(const std::vector<PassageSeries>& all, double adequacy);
std::string passages_csv(const std::vector<PassageSeries>& all);
/// Displacement against the number of passages, one curve for each factor, as SVG.
std::string ratchet_chart(const std::vector<PassageSeries>& all);

}  // namespace voussoir

// What is usual for masonry, and the units in which people give values by mistake. Private to io/case.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// A unit that is taken for the right one: the value times `factor`, or one over it, is in the right one.
struct Slip {
  double factor = 1.0;
  const char* unit = "";
  bool inverse = false;
  double mended(double value) const { return inverse ? factor / value : factor * value; }
};

/// A kind of quantity. Zero and signs are not judged: whether they may stand is the reader's business.
struct Usual {
  const char* what;  // "for masonry, stone and fill"
  const char* unit;
  double low, high;              // inclusive; beyond them a value is remarked
  double meant_low, meant_high;  // where a slip must land to be worth a word
  std::vector<Slip> slips;       // in the order of their likelihood
};

/// Of a key in a section of a case ("materials", "joints", "stage.pulse"); null where nothing is known.
const Usual* usual_of_key(const std::string& section, const std::string& key);
/// Of a generator's parameter, by its unit ("m", "Pa/m") or, of angles, by its name: only friction has a usual range.
const Usual* usual_of_parameter(const std::string& name, const std::string& unit);
/// By the name of the quantity: "peak", "extent", "modal period" …; of those the program asks for itself.
const Usual& usual(const std::string& name);

/// "usual for … is … to …; if it was meant in GPa, write 4e+09"; empty for a usual value.
std::string unusual(const Usual& usual, double value);

}  // namespace voussoir

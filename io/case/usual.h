// Usual ranges of values for masonry, and units that are often used by mistake. Private to io/case.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// A unit used by mistake. value * factor is the value in the right unit; if `inverse`, factor / value is.
struct Slip {
  double factor = 1.0;
  const char* unit = "";
  bool inverse = false;
  double mended(double value) const { return inverse ? factor / value : factor * value; }
};

/// A kind of quantity with its usual range. Zero and signs are not judged here; the reader checks them.
struct Usual {
  const char* what;  // "for masonry, stone and fill"
  const char* unit;
  double low, high;              // usual range, inclusive; a value outside it gives a remark
  double meant_low, meant_high;  // range in which the corrected value must lie for a suggestion
  std::vector<Slip> slips;       // the most likely first
};

/// The usual range of a key in a section of a case ("materials", "joints", "stage.pulse"); null if there is none.
const Usual* usual_of_key(const std::string& section, const std::string& key);
/// The usual range of a parameter of a generator, by its unit ("m", "Pa/m") or, for friction angles, by its name.
const Usual* usual_of_parameter(const std::string& name, const std::string& unit);
/// The usual range of a quantity by its name: "peak", "extent", "modal period" … The name must exist.
const Usual& usual(const std::string& name);

/// "usual for … is … to …; if it was meant in GPa, write 4e+09"; empty for a usual value.
std::string unusual(const Usual& usual, double value);

}  // namespace voussoir

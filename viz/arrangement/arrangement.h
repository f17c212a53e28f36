// The general arrangement drawing of an assembly: elevation, plan, sections, dimensions, title block. All that it says
// was measured from the stones or stands in the notes.
#pragma once
#include <memory>
#include <string>

#include "geometry/assembly.h"
#include "viz/page/drawing.h"

namespace voussoir {

struct ArrangementParts;

struct ArrangementNotes {
  std::string name;    // of what is drawn: "two-spans"
  std::string source;  // where it is from: "generator bridge"
};

/// Bridges (stones of component arch) have their spans, rings, supports, fill and widths measured; all else its overall
/// size. A3, A2 or A1 by what there is to show.
class Arrangement {
 public:
  Arrangement(const Assembly& assembly, const ArrangementNotes& notes);
  ~Arrangement();
  double width() const;   // px of the drawing; printed at 96 to the inch it has its scale
  double height() const;  // px
  int pixels() const;     // width of a picture that can be read
  void draw(Drawing& drawing) const;
  std::string svg() const;

 private:
  std::unique_ptr<ArrangementParts> parts_;
};

}  // namespace voussoir

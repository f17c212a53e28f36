// The general arrangement drawing of an assembly: elevation, plan, sections, dimensions, title block. All its content
// is measured from the stones or given in the notes.
#pragma once
#include <memory>
#include <string>

#include "geometry/assembly.h"
#include "viz/page/drawing.h"

namespace voussoir {

struct ArrangementParts;

struct ArrangementNotes {
  std::string name;    // name of the object: "two-spans"
  std::string source;  // its origin: "generator bridge"
};

/// For bridges (stones of component arch) the drawing measures spans, rings, supports, fill and widths; for other
/// assemblies only the overall size. The sheet has a format from A3 to A1 (see paper.cpp), depending on the content.
class Arrangement {
 public:
  Arrangement(const Assembly& assembly, const ArrangementNotes& notes);
  ~Arrangement();
  double width() const;   // px; at 96 px per inch the print is true to scale
  double height() const;  // px
  int pixels() const;     // px, width of a readable picture
  void draw(Drawing& drawing) const;
  std::string svg() const;

 private:
  std::unique_ptr<ArrangementParts> parts_;
};

}  // namespace voussoir

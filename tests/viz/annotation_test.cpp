// Words around a picture: none of them covers another or leaves the sheet, whatever the width.
#include "viz/annotation.h"

#include <gtest/gtest.h>
#include <vtkActor2DCollection.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "viz/offscreen.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

struct Written {
  std::string words;
  double left = 0.0, right = 0.0, foot = 0.0, head = 0.0;  // pixels
};

/// The texts of an overlay, from the baseline to the height of a capital.
std::vector<Written> texts_of(vtkRenderer* renderer) {
  std::vector<Written> texts;
  vtkActor2DCollection* actors = renderer->GetActors2D();
  actors->InitTraversal();
  while (vtkActor2D* actor = actors->GetNextActor2D()) {
    auto* text = vtkTextActor::SafeDownCast(actor);
    if (!text) continue;
    const double size = text->GetTextProperty()->GetFontSize() / double(kOversampling);
    const double width = Overlay::text_width(text->GetInput(), size), x = text->GetPosition()[0] / kOversampling;
    const int align = text->GetTextProperty()->GetJustification();
    const double left = align == VTK_TEXT_LEFT ? x : align == VTK_TEXT_RIGHT ? x - width : x - 0.5 * width;
    const double y = text->GetPosition()[1] / kOversampling;
    texts.push_back({text->GetInput(), left, left + width, y, y + size});
  }
  return texts;
}

bool cover(const Written& a, const Written& b) {
  return a.left < b.right && b.left < a.right && a.foot < b.head && b.foot < a.head;
}

void expect_legible(int width, const Colouring& colouring, const Words& words) {
  vtkNew<vtkRenderer> renderer;
  Overlay overlay(renderer);
  Sheet sheet{width, width / 2, letter_size(width), 20.0 / width};
  sheet.raised = raised_height(sheet, colouring, words);
  draw_annotation(overlay, sheet, find_view("front"), colouring, words);
  const std::vector<Written> texts = texts_of(renderer);
  EXPECT_GE(texts.size(), 5U) << width;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_GE(texts[i].left, 0.0) << width << ": " << texts[i].words;
    EXPECT_LE(texts[i].right, width) << width << ": " << texts[i].words;
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(cover(texts[i], texts[k])) << width << ": " << texts[k].words << " | " << texts[i].words;
    }
  }
}

Words long_words() {
  Words words;
  words.title = "A bridge of three spans with a deformable fill: the state after the third stage";
  words.time = "t = 12.50 s";
  words.deform = "deformations × 200";
  words.hidden = "hidden: backfill, spandrel, parapet; cut at y = 1.25 m; 12 stones far away";
  words.lines = {{"outline: undeformed", kInk}, {"opened or slipped > 0.15 mm", kInk}};
  return words;
}

TEST(Annotation, NoWordsCoverOthersAtAnyWidth) {
  const Colouring classes{.legend = {{"within the kern (e/d ≤ 1/6)", kInk},
                                     {"≤ 1/3", kInk},
                                     {"≤ 0.45", kInk},
                                     {"at the edge or outside", kInk},
                                     {"outlines only: almost no compression", kInk}}};
  Colouring scale{.title = "utilisation: shear force / shear resistance (friction and cohesion); outlines only"};
  scale.top = 0.0015, scale.bottom = -0.0015, scale.exceeded = true;
  for (const int width : {320, 480, 700, 800, 1200, 1600, 3000, 6000}) {
    expect_legible(width, classes, long_words());
    expect_legible(width, scale, long_words());
  }
}

TEST(Annotation, AShortLegendLiesBesideTheCornerAndALongOneAboveIt) {
  Colouring colouring{.legend = {{"arch", kInk}, {"pier", kInk}}};
  Words words;
  words.deform = "true deformations";
  const Sheet sheet{1200, 800, letter_size(1200)};
  EXPECT_EQ(raised_height(sheet, colouring, words), 0.0);
  for (int i = 0; i < 30; ++i) colouring.legend.emplace_back("spandrel", kInk);
  const double raised = raised_height(sheet, colouring, words);
  EXPECT_GT(raised, 2.0 * sheet.letter) << "several rows";
  Sheet lifted = sheet;
  lifted.raised = raised;
  EXPECT_EQ(bottom_strip(lifted), bottom_strip(sheet) + raised);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

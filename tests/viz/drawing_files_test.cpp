// Drawings as PDF and PNG files.
#include <gtest/gtest.h>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "viz/page/cairo_drawing.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

void draw_square(Drawing& drawing) {
  drawing.rectangle(10.0, 10.0, 30.0, 30.0, {"#d55e00", "#1f1f24", 2.0, "4 2"});
  drawing.curve({{0.0, 0.0}, {5.0, 5.0}, {NAN, NAN}, {20.0, 20.0}}, "#0072b2");
  drawing.text(20.0, 45.0, "y− 3°", {.anchor = "middle"});
}

TEST(DrawingFiles, PdfHasItsSizeAndAPageForEachDrawing) {
  const Folder folder;
  // A4 upright at 96 px an inch.
  const double width = 210.0 / 25.4 * 96.0, height = 297.0 / 25.4 * 96.0;
  write_pdf({draw_square, draw_square}, width, height, folder / "in/two.pdf");
  const std::string pdf = read_text(folder / "in/two.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
  EXPECT_NE(pdf.find("/Count 2"), std::string::npos);
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 595.275591 841.889764 ]"), std::string::npos) << "points: 72 an inch";
}

TEST(DrawingFiles, TheSameDrawingGivesTheSameBytes) {
  const Folder folder;
  for (const char* name : {"a", "b"}) {
    write_pdf({draw_square}, 100.0, 50.0, folder / (std::string(name) + ".pdf"));
    write_png(draw_square, 100.0, 50.0, folder / (std::string(name) + ".png"), 300);
  }
  EXPECT_EQ(read_text(folder / "a.pdf"), read_text(folder / "b.pdf"));
  EXPECT_EQ(read_text(folder / "a.png"), read_text(folder / "b.png"));
}

TEST(DrawingFiles, PngIsSoManyPixelsWide) {
  const Folder folder;
  write_png(draw_square, 100.0, 50.0, folder / "square.png", 300);
  const std::string png = read_text(folder / "square.png");
  ASSERT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
  const auto number = [&](std::size_t at) {
    return int(std::uint8_t(png[at + 2])) * 256 + int(std::uint8_t(png[at + 3]));
  };
  EXPECT_EQ(number(16), 300);
  EXPECT_EQ(number(20), 150);
}

TEST(DrawingFiles, AFileThatCannotBeWrittenIsNamed) {
  const Folder folder;
  folder.write("file", "");
  EXPECT_NE(message_of<RunError>([&] { write_pdf({draw_square}, 10.0, 10.0, folder / "file/x.pdf"); }).find("file"),
            std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

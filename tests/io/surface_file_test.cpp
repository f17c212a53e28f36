// Surfaces in files that are not quite as they should be.
#include "io/vtk/surface_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// A tetrahedron as a binary STL file whose head begins with these words.
std::string binary_stl(const std::string& head) {
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string bytes = head;
  bytes.resize(80, ' ');
  const std::uint32_t count = 4;
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (const int corner : face) bytes.append(reinterpret_cast<const char*>(corners[corner]), sizeof corners[corner]);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(SurfaceFile, BytesBehindTheLastFacetArePassedOverWithANote) {
  for (const char* head : {"solid as exported", "binary"})
    for (const std::size_t more : {0, 1, 2, 49, 50, 1000}) {
      const Surface surface = parse_stl(binary_stl(head) + std::string(more, 'x'), "stone.stl");
      EXPECT_EQ(surface.faces.size(), 4u);
      EXPECT_EQ(surface.vertices.size(), 4u);
      ASSERT_EQ(surface.notes.size(), more > 0 ? 1u : 0u);
      if (surface.notes.empty()) continue;
      EXPECT_EQ(surface.notes[0], fmt::format("stone.stl: the {} bytes after its 4 facets were ignored", more));
    }
}

TEST(SurfaceFile, ACutBinaryFileIsRefused) {
  const std::string whole = binary_stl("binary");
  for (const std::size_t size : {80, 83, 90, 283})
    EXPECT_NE(test::message_of<InputError>([&] {
                parse_stl(whole.substr(0, size), "stone.stl");
              }).find("stone.stl: is not an STL file, or is cut off"),
              std::string::npos)
        << size;
}

TEST(SurfaceFile, ValuesOfMegabytesAreNotEchoedWhole) {
  const std::string huge(2000000, '7');
  const auto length = [](auto&& work) { return test::message_of<InputError>(work).size(); };
  for (const std::size_t size : {
           length([&] { parse_obj("v 0 0 0\nf " + huge + "\n", "a.obj"); }),
           length([&] { parse_ply("ply\nformat " + huge + "\n", "a.ply"); }),
           length([&] { parse_ply("ply\n" + huge + "\n", "a.ply"); }),
           length([&] { parse_ply("ply\nformat ascii 1.0\nelement " + huge + " 5\nend_header\n", "a.ply"); }),
       }) {
    EXPECT_GT(size, 20u);
    EXPECT_LT(size, 400u);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

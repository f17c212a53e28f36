// Joints coloured by what they carry, and resultants over pictures.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>

#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "viz/joint_colours.h"
#include "viz/render.h"
#include "viz/resultants_overlay.h"
#include "viz/scene.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

/// The joint of two cubes as a face, with these tractions (Pa).
vtkSmartPointer<vtkPolyData> joint_with(double normal, double shear, double eccentricity = 0.0,
                                        double utilisation = 0.0) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  PatchSnapshot& patch = snapshot.patches[0];
  patch.normal_traction = normal, patch.shear_traction = shear;
  patch.eccentricity = eccentricity, patch.utilisation = utilisation;
  return joint_faces(joint_polydata(assembly, snapshot), Hidden({}), 1.0, [](vtkIdType) { return true; });
}

/// Of its only face.
void expect_colour(const ColouredJoints& joints, const Colour& expected) {
  ASSERT_EQ(joints.faces->GetNumberOfPolys(), 1);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(joints.faces->GetCellData()->GetScalars()->GetComponent(0, c) / 255.0, expected[std::size_t(c)], 0.003);
}

void expect_bare(const ColouredJoints& joints) {
  EXPECT_EQ(joints.faces->GetNumberOfPolys(), 0);
  EXPECT_EQ(joints.bare->GetNumberOfPolys(), 1);
}

TEST(JointColours, NormalStressGoesFromTensionToCompression) {
  const ColouredJoints pressed = colour_joints(joint_with(-0.75e6, 0.0), "normal", 0.0);
  EXPECT_EQ(pressed.colouring.top, 0.8);
  EXPECT_EQ(pressed.colouring.bottom, 0.0) << "no tension, no other side";
  expect_colour(pressed, scale_colour(0.75 / 0.8));
  const ColouredJoints pulled = colour_joints(joint_with(0.3e6, 0.0), "normal", 1.0);
  EXPECT_NEAR(pulled.colouring.bottom, -0.4, 1e-12) << "two parts of 0.2 MPa";
  EXPECT_NE(pulled.colouring.title.find("tension"), std::string::npos);
  expect_colour(pulled, other_side_colour(0.75));
  expect_bare(colour_joints(joint_with(0.0, 0.0), "normal", 0.0));
  expect_bare(colour_joints(joint_with(-0.04e6, 0.0), "normal", 1.0));
}

TEST(JointColours, ShearAndUtilisation) {
  const auto faces = joint_with(-1e6, 0.15e6, 0.0, 0.4);
  EXPECT_NEAR(colour_joints(faces, "shear", 0.0).colouring.top, 0.15, 1e-12);
  expect_colour(colour_joints(faces, "shear", 0.2), scale_colour(0.75));
  EXPECT_EQ(colour_joints(faces, "utilisation", 0.0).colouring.top, 1.0);
  expect_colour(colour_joints(faces, "utilisation", 0.0), scale_colour(0.4));
  expect_colour(colour_joints(faces, "utilisation", 0.5), scale_colour(0.8));
}

TEST(JointColours, EccentricitiesFallIntoClasses) {
  const auto coloured = [](double normal, double eccentricity) {
    return colour_joints(joint_with(normal, 0.0, eccentricity), "eccentricity", 0.0);
  };
  const Colouring legend = coloured(-1e5, 0.0).colouring;
  ASSERT_EQ(legend.legend.size(), 5u);
  const auto expect_class = [&](double eccentricity, std::size_t which) {
    SCOPED_TRACE(eccentricity);
    expect_colour(coloured(-1e5, eccentricity), legend.legend[which].second);
  };
  expect_class(0.0, 0), expect_class(1.0 / 6.0, 0);
  expect_class(0.17, 1), expect_class(1.0 / 3.0, 1);
  expect_class(0.34, 2), expect_class(0.45, 2);
  expect_class(0.46, 3), expect_class(2.0, 3);
  expect_bare(coloured(1.0, 0.0)), expect_bare(coloured(0.0, 0.0));
}

TEST(JointColours, AFrameOfAnEarlierVersionIsNamed) {
  const auto faces = joint_with(-1.0, 0.0);
  faces->GetCellData()->RemoveArray("utilisation");
  const std::string message = message_of<InputError>([&] { colour_joints(faces, "utilisation", 0.0); });
  EXPECT_NE(message.find("utilisation"), std::string::npos) << message;
  EXPECT_NE(message.find("earlier version"), std::string::npos) << message;
  EXPECT_NE(message.find("checkpoint"), std::string::npos) << message;
}

TEST(JointColours, TiesAreNoJoints) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  EXPECT_TRUE(is_shown_as_joint(joint_polydata(assembly, snapshot), 0));
  snapshot.patches[0].tie = true;
  EXPECT_FALSE(is_shown_as_joint(joint_polydata(assembly, snapshot), 0));
}

/// Share of a picture's pixels near a colour.
double share_of(const std::string& png, const Colour& colour) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  vtkIdType near = 0;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i) {
    bool is = true;
    for (int c = 0; c < 3; ++c) is &= std::abs(pixels->GetComponent(i, c) / 255.0 - colour[std::size_t(c)]) < 0.05;
    near += is;
  }
  return double(near) / double(pixels->GetNumberOfTuples());
}

RenderOptions sized(const std::string& colour, const std::string& view) {
  RenderOptions options;
  options.width = 480, options.height = 300;
  options.colour = colour, options.view = view;
  options.amplification = 1.0;
  return options;
}

TEST(Ties, AreDrawnOverEverythingAndSayWhatHasYielded) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  PatchSnapshot& tie = snapshot.patches[0];
  tie.tie = true;
  tie.polygon = {{0.2, 0.4, 0.5}, {0.2, 0.6, 0.5}, {0.8, 0.6, 1.5}, {0.8, 0.4, 1.5}};  // inside of the cubes
  const Colour holds = {0.0, 0.447, 0.698}, yielded = {0.835, 0.369, 0.0};
  const Folder folder;
  const auto share = [&](const Colour& colour) {
    render_picture(assembly, snapshot, sized("stone", "front"), folder / "ties.png");
    return share_of(folder / "ties.png", colour);
  };
  EXPECT_GT(share(holds), 1e-3);
  EXPECT_LT(share(yielded), 1e-4);
  tie.yielded = 2e-3;
  EXPECT_GT(share(yielded), 1e-3);
  EXPECT_LT(share(holds), 1e-4);
  tie.tie = false;
  EXPECT_LT(share(yielded), 1e-4);
}

TEST(Marks, AreWhiteDiscsAtTheirPlaces) {
  const Assembly assembly = test::two_cubes();
  const Snapshot snapshot = rest_snapshot(assembly);
  RenderOptions options = sized("stone", "front");
  const Folder folder;
  const auto black = [&] {
    render_picture(assembly, snapshot, options, folder / "marks.png");
    return share_of(folder / "marks.png", kInk);
  };
  const double without = black();
  options.marks = {{Vec3(0.5, 0.0, 1.5), "1"}, {Vec3(0.5, 0.0, 0.5), "12"}};
  EXPECT_GT(black(), without + 1e-4);
}

/// Bed joints are seen as faces from above, and as lines from the front.
TEST(StressPictures, JointsAreSeenFromAllSides) {
  const Folder folder;
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.patches[0].normal_traction = -1e6, snapshot.patches[0].shear_traction = 1.0;
  const std::string png = folder / "joints.png";
  const Colour full = scale_colour(1.0);
  RenderOptions options = sized("normal", "plan");
  render_picture(assembly, snapshot, options, png);
  EXPECT_GT(share_of(png, full), 0.1);
  options.view = "front";
  render_picture(assembly, snapshot, options, png);
  const double line = share_of(png, full);
  EXPECT_GT(line, 1e-3);
  options.hide = {"wall"};
  render_picture(assembly, snapshot, options, png);
  EXPECT_LT(share_of(png, full), 0.7 * line) << "hidden: only the scale is left";
}

TEST(StressPictures, ResultantsAreDrawnOverEverything) {
  const Folder folder;
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = rest_snapshot(assembly);
  RenderOptions options = sized("stone", "front");
  const std::string png = folder / "thrust.png";
  render_picture(assembly, snapshot, options, png);
  const Colour thrust = {0.835, 0.369, 0.0};
  EXPECT_EQ(share_of(png, thrust), 0.0);
  for (int i = 0; i < 5; ++i) {
    BedJoint bed;
    bed.number = i, bed.centre = {-2.0 + i, 0.6, 3.0}, bed.depth = 0.6, bed.width = 1.2, bed.normal = 1e5;
    options.resultants.push_back(bed);
  }
  render_picture(assembly, snapshot, options, png);
  const double whole = share_of(png, thrust);
  EXPECT_GT(whole, 0.0);
  options.resultants[2].normal = -1.0, options.resultants[2].eccentricity = std::nan("");
  render_picture(assembly, snapshot, options, png);
  EXPECT_LT(share_of(png, thrust), 0.9 * whole) << "the line breaks where nothing is pressed";
  options.amplification = 2.0;
  const std::string message = message_of<InputError>([&] { render_picture(assembly, snapshot, options, png); });
  EXPECT_NE(message.find("It must be 1 for resultants"), std::string::npos) << message;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir

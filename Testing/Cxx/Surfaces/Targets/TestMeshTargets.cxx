// Warnings about a mesh or image as target: parts too thin for the voxels, and invalid polygons.

#include "Shapes/MeshShapes.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkReverseSense.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

using namespace activesurface;

namespace TestMeshTargets
{

namespace
{

constexpr double Voxel = 0.05;
constexpr double Pi = 3.14159265358979323846;

// Three times the random error of a fraction; see SurfaceSample.
double Sampling(double share)
{
  return 3.0 * std::sqrt(share * (1.0 - share) / 8192.0);
}

vtkSmartPointer<vtkPolyData> MakeBox(double x, double y, double z, double middle = 0.0)
{
  vtkNew<vtkCubeSource> box;
  box->SetXLength(x);
  box->SetYLength(y);
  box->SetZLength(z);
  box->SetCenter(middle, 0.0, 0.0);
  box->Update();
  return box->GetOutput();
}

vtkSmartPointer<vtkPolyData> Turn(vtkPolyData* mesh)
{
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(34.0, 0.3, -0.5, 0.8);
  turn->Translate(0.013, 0.027, -0.019);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTransform(turn);
  filter->Update();
  return filter->GetOutput();
}

double FindShare(vtkDataSet* data, double thickness = 0.0)
{
  vtkNew<vtkGridPotential> potential;
  potential->SetWarnOfDefects(false);
  potential->SetInput(data);
  potential->SetVoxelSize(Voxel);
  potential->SetMeshThickness(thickness);
  return potential->FindThinShare(2.0 * Voxel);
}

// The faces of a slab of 4 x 4 count as thin, its rims do not.
double GetShareOfSlab(double thickness)
{
  return 2.0 * 16.0 / (2.0 * 16.0 + 4.0 * 4.0 * thickness);
}

using Function = std::function<double(double x, double y, double z)>;

// Image in the box +-1.5.
vtkSmartPointer<vtkImageData> MakeImage(double pixel, const Function& function)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const int half = static_cast<int>(1.5 / pixel);
  image->SetExtent(-half, half, -half, half, -half, half);
  image->SetSpacing(pixel, pixel, pixel);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    values->SetValue(i, static_cast<float>(function(x[0], x[1], x[2])));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

double Ball(double x, double y, double z)
{
  return std::sqrt(x * x + y * y + z * z) - 0.5;
}

// A fin from x = 0 to 1, |y| < 0.4, 1.5 voxels thick.
double Fin(double x, double y, double z)
{
  return std::max({ std::fabs(x - 0.5) - 0.5, std::fabs(y) - 0.4, std::fabs(z) - 0.75 * Voxel });
}

double BallWithFin(double x, double y, double z)
{
  return std::min(Ball(x, y, z), Fin(x, y, z));
}

// Area of both sides of the fin outside the ball: the rectangle without the disk that the ball cuts
// out of the plane of a side. Points within half a voxel of the ball may count or not, because the
// line along the normal runs along the ball there.
struct Exposed
{
  double Area;
  double Doubt;
};

Exposed FindExposedFin()
{
  const double square = 0.25 - 0.5625 * Voxel * Voxel, angle = std::asin(0.4 / std::sqrt(square));
  const double covered = 0.4 * std::sqrt(square - 0.16) + square * angle;
  return { 2.0 * (0.8 - covered), 2.0 * 0.5 * Voxel * 2.0 * angle * std::sqrt(square) };
}

}

TEST(TestMeshTargets, SlabsThinnerThanTwoVoxelsAreThin)
{
  for (const double voxels : { 0.3, 0.9, 1.5, 1.9 })
  {
    const double share = GetShareOfSlab(voxels * Voxel);
    const auto slab = MakeBox(4.0, 4.0, voxels * Voxel);
    EXPECT_NEAR(FindShare(slab), share, Sampling(share)) << voxels << " voxels";
    EXPECT_NEAR(FindShare(Turn(slab)), share, Sampling(share)) << "turned";
  }
  EXPECT_EQ(FindShare(MakeBox(4.0, 4.0, 2.0 * Voxel)), 0.0) << "two voxels";
  EXPECT_EQ(FindShare(MakeBox(4.0, 4.0, 2.1 * Voxel)), 0.0) << "more";
  EXPECT_EQ(FindShare(Turn(MakeBox(4.0, 4.0, 3.0 * Voxel))), 0.0) << "three voxels, turned";
}

// A tetrahedron is thin only at its corners, which interpolation rounds off. They are at most three
// voxels long, on sides of 57 voxels: 3 corners x 3^2 of the 57^2 of each face.
TEST(TestMeshTargets, ThickBodiesAreNot)
{
  EXPECT_EQ(FindShare(MakeSphere(0.5, 40)), 0.0) << "ball";
  EXPECT_EQ(FindShare(MakeSphere(1.5 * Voxel, 40)), 0.0) << "droplet of 3 voxels";
  EXPECT_EQ(FindShare(MakeBox(1.0, 1.0, 1.0)), 0.0) << "cube";
  EXPECT_EQ(FindShare(Turn(MakeBox(1.0, 1.0, 1.0))), 0.0) << "cube, turned";
  const auto tetrahedron = MakeMesh({ { 1, 1, 1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, -1, -1 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 2, 3 }, { 1, 2, 3 } });
  const double corners = 3.0 * 9.0 / (57.0 * 57.0);
  EXPECT_LT(FindShare(tetrahedron), corners) << "tetrahedron";
  EXPECT_LT(FindShare(Turn(tetrahedron)), corners) << "tetrahedron, turned";
}

// Two bodies that overlap. The orientation of the polygons does not matter.
TEST(TestMeshTargets, AFinIsItsShareOfTheArea)
{
  const auto ball = MakeSphere(0.5, 80);
  const auto fin = MakeBox(1.0, 0.8, 1.5 * Voxel, 0.5);
  const double share = FindShare(Append(ball, fin));
  const Exposed exposed = FindExposedFin();
  const double whole = 4.0 * Pi * 0.25 + 1.6 + 2.0 * 1.5 * Voxel * 1.8;
  EXPECT_NEAR(share, (exposed.Area - 0.5 * exposed.Doubt) / whole,
    0.5 * exposed.Doubt / whole + Sampling(share))
    << "share";
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(fin);
  reverse->ReverseCellsOn();
  reverse->Update();
  EXPECT_NEAR(FindShare(Append(ball, reverse->GetOutput())), share, Sampling(share))
    << "with the fin turned over, and so other points of it";
}

TEST(TestMeshTargets, ShellsAreAsThickAsTheyAreMade)
{
  const auto bowl = MakeSphere(0.8, 40, 90.0);
  EXPECT_EQ(FindShare(bowl, 2.1 * Voxel), 0.0) << "more than two voxels";
  // The tolerance is the part of the area within a voxel of the rim.
  EXPECT_NEAR(FindShare(bowl, 1.5 * Voxel), 1.0, Voxel / 0.8) << "less";
  EXPECT_EQ(FindShare(bowl), 0.0) << "an open mesh has no thickness";
}

// The image holds distances, or a mask of 0 and 1, with finer or coarser pixels.
TEST(TestMeshTargets, PartsOfImagesAreThinToo)
{
  const Exposed exposed = FindExposedFin();
  const double rims = 1.5 * Voxel * (0.8 + 2.0 * (1.0 - std::sqrt(0.25 - 0.16)));
  const double base = 1.5 * Voxel * 2.0 * std::asin(0.8) * 0.5;
  const double whole = 4.0 * Pi * 0.25 - base + rims + exposed.Area;
  const double share = (exposed.Area - 0.5 * exposed.Doubt) / whole;
  const double doubt = 0.5 * exposed.Doubt / whole + Sampling(share);
  for (const double pixel : { 0.02, 0.03 })
  {
    // The rows of pixels resolve the fin's outline to half a pixel.
    const double outline = 0.5 * pixel * 2.0 * (0.8 + 2.0 * 0.7 + 0.93) / whole;
    EXPECT_NEAR(FindShare(MakeImage(pixel, BallWithFin)), share, doubt + outline) << "distance";
  }
  const double thin = FindShare(MakeImage(
    0.025, [](double x, double y, double z) { return BallWithFin(x, y, z) < 0.0 ? -0.5 : 0.5; }));
  // 3 pixels are inside, |z| <= 0.025: the same thickness. A mask has a stepped surface with a
  // larger area: on a ball by at most half (|n_x| + |n_y| + |n_z| is 1.5 in the mean), on the fin
  // by nothing.
  EXPECT_LT(exposed.Area / (1.5 * whole) - doubt, thin) << "mask, at least";
  EXPECT_LT(thin, share + doubt + 0.05) << "mask, at most";
}

TEST(TestMeshTargets, ThickPartsOfImagesAreNot)
{
  for (const double pixel : { 0.02, 0.05, 0.1 })
  {
    EXPECT_EQ(FindShare(MakeImage(pixel, Ball)), 0.0) << "ball";
    EXPECT_EQ(FindShare(MakeImage(pixel,
                [](double x, double y, double z) { return Ball(x, y, z) < 0.0 ? -0.5 : 0.5; })),
      0.0)
      << "mask of a ball";
    EXPECT_EQ(FindShare(MakeImage(pixel,
                [](double x, double y, double z) {
                  return std::max({ std::fabs(x), std::fabs(y), std::fabs(z) }) - 0.507;
                })),
      0.0)
      << "cube";
  }
}

namespace
{
vtkSmartPointer<vtkActiveImplicitSurface> MakeFilter(vtkAlgorithm* source)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetVoxelSize(Voxel);
  filter->SetModelBounds(-2.5, 2.5, -2.5, 2.5, -1.0, 1.0);
  return filter;
}

const char* const Thin = "parts thinner than two voxels";

int CountWarnings(vtkAlgorithm* source, const std::string& words)
{
  auto filter = MakeFilter(source);
  MessageCapture messages(filter);
  for (const double time : { 0.0, 1.0, 0.5, 2.0, 0.0, 1.5 })
  {
    filter->UpdateTimeStep(time);
  }
  return MessageCapture::Count(messages.Warnings, words);
}
}

TEST(TestMeshTargets, ThinPartsAreOneWarning)
{
  const auto slab = [](double) { return MakeBox(4.0, 4.0, 1.5 * Voxel); };
  const std::string words = "The target, a mesh, at the time step 0: about 97 % of its surface "
                            "belongs to parts thinner than two voxels";
  EXPECT_EQ(CountWarnings(MakeSource(slab), words), 1) << "mesh";
  EXPECT_EQ(CountWarnings(MakeSource(slab, { 0.0, 1.0, 2.0 }), Thin), 1) << "moving mesh";
  const auto image = [](double) { return MakeImage(0.03, BallWithFin); };
  EXPECT_EQ(CountWarnings(MakeSource(image), "The target, an image, at the time step 0: about"), 1)
    << "image";
}

TEST(TestMeshTargets, ThickTargetsAreNoWarning)
{
  const auto ball = [](double) { return MakeSphere(0.5, 40); };
  EXPECT_EQ(CountWarnings(MakeSource(ball), ""), 0) << "mesh";
  const auto image = [](double) { return MakeImage(0.03, Ball); };
  EXPECT_EQ(CountWarnings(MakeSource(image), ""), 0) << "image";
}

// After a change of the voxel size, the thickness is checked again.
TEST(TestMeshTargets, TheWarningIsOfTheVoxels)
{
  auto source = MakeSource([](double) { return MakeBox(1.0, 1.0, 3.0 * Voxel); });
  auto filter = MakeFilter(source);
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, Thin), 0) << "three voxels";
  filter->SetVoxelSize(2.0 * Voxel);
  filter->Update();
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, Thin), 1) << "one and a half";
}

// Regression test: such polygons crashed the program.
TEST(TestMeshTargets, PolygonsWithMissingPointsAreLeftOut)
{
  const auto broken = [](double)
  {
    const auto cube = MakeBox(1.0, 1.0, 1.0);
    cube->GetPolys()->InsertNextCell({ 0, 1, 1000000000 });
    cube->GetPolys()->InsertNextCell({ -7, 1, 2 });
    return cube;
  };
  const auto source = MakeSource(broken);
  auto filter = MakeFilter(source);
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0); // bounds of the mesh
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_EQ(MessageCapture::Count(messages.Warnings,
              "2 polygons with a point that is missing, beyond 1e100 or not finite"),
    1)
    << "warnings";
  EXPECT_NEAR(filter->GetOutput()->GetBounds()[1], 0.5, 0.1 * Voxel) << "the cube is there";
}

}

// Bodies, voids and handles through the pipeline: skins and histories have those of the moving
// target. The target's topology comes from its formula, polygonised by vtkFlyingEdges3D.

#include "Support/HistoryTools.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkAppendPolyData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestFilterTopology
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

// A potential at a time, negative inside.
using Formula = std::function<double(const Point&)>;

// A moving input and its formula, in the box +-1 and at the times 0, 1 .. LastStep.
struct Scene
{
  std::function<vtkSmartPointer<vtkDataSet>(double time)> Input;
  std::function<Formula(double time)> Inside;
  int LastStep;
  std::string Story; // sequence of DescribeTopology results
};

// The lattice is finer than that of the finest skin, 0.025.
std::string GetTopologyOf(const Formula& formula)
{
  constexpr int half = 50;
  vtkNew<vtkImageData> image;
  image->SetExtent(-half, half, -half, half, -half, half);
  image->SetSpacing(1.0 / half, 1.0 / half, 1.0 / half);
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Point point;
    image->GetPoint(i, point.data());
    values->SetValue(i, -formula(point));
  }
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> polygons;
  polygons->SetInputData(image);
  polygons->SetValue(0, 0.0);
  polygons->Update();
  return DescribeTopology(GetMesh(polygons->GetOutput()));
}

// Expected topology at each step. The string is empty next to an event, where the lag and the
// lattice decide. At all other steps an event is at least one step away, which is 50 times the lag.
std::vector<std::string> GetExpected(const Scene& scene)
{
  std::vector<std::string> all;
  std::string story;
  for (int step = 0; step <= scene.LastStep; ++step)
  {
    all.push_back(GetTopologyOf(scene.Inside(step)));
    const bool isNew = step == 0 || all[step] != all[step - 1];
    story += !isNew ? "" : (step == 0 ? "" : ", ") + all[step];
  }
  EXPECT_EQ(story, scene.Story) << "what the target goes through";
  std::vector<std::string> expected = all;
  for (int step = 0; step <= scene.LastStep; ++step)
  {
    const bool isSure = all[std::max(step - 1, 0)] == all[step] &&
      all[std::min(step + 1, scene.LastStep)] == all[step];
    expected[step] = isSure ? all[step] : "";
  }
  return expected;
}

struct Resolution
{
  double VoxelSize;
  double Tension;

  std::string Describe() const
  {
    return ", voxels of " + std::to_string(VoxelSize) + ", tension " + std::to_string(Tension);
  }
};

vtkSmartPointer<vtkActiveImplicitSurface> MakeFineSkin(
  ShapeSource* source, const Resolution& resolution)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "radius");
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetAttraction(50.0);
  filter->SetVoxelSize(resolution.VoxelSize);
  filter->SetTension(resolution.Tension);
  filter->SetTargetNoise(0.0);
  return filter;
}

void IsFollowed(const Scene& scene, const std::vector<std::string>& expected)
{
  std::vector<double> steps(scene.LastStep + 1);
  std::iota(steps.begin(), steps.end(), 0.0);
  for (const Resolution& resolution :
    { Resolution{ 0.05, 0.0 }, Resolution{ 0.05, 0.005 }, Resolution{ 0.025, 0.0 } })
  {
    const auto source = MakeSource(scene.Input, steps);
    auto filter = MakeFineSkin(source, resolution);
    for (int step = 0; step <= scene.LastStep; ++step)
    {
      const std::string name = " at " + std::to_string(step) + resolution.Describe();
      filter->UpdateTimeStep(step);
      const Mesh mesh = GetMesh(filter->GetOutput());
      EXPECT_EQ(CountDefects(mesh), 0u) << "defects" << name;
      EXPECT_EQ(CountRows(filter), step + 1) << "rows" << name;
      const std::string row = DescribeTopology(filter, step);
      EXPECT_EQ(row, DescribeTopology(mesh)) << "the history's and the mesh's" << name;
      EXPECT_TRUE(expected[step].empty() || row == expected[step])
        << "it is " << row << ", expected " << expected[step] << name;
    }
  }
}

void IsFollowed(const Scene& scene)
{
  IsFollowed(scene, GetExpected(scene));
}

struct Blob
{
  Point Centre;
  double Radius; //< kernel radius
};
constexpr double ReachPerRadius = 4.5; // ratio for the filter's balls
using Cloud = std::function<std::vector<Blob>(double time)>;

vtkSmartPointer<vtkPolyData> MakeBlobs(const std::vector<Blob>& blobs)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  vtkNew<vtkIntArray> ids;
  ids->SetName("id");
  for (const Blob& blob : blobs)
  {
    ids->InsertNextValue(static_cast<int>(points->InsertNextPoint(blob.Centre.data())));
    radii->InsertNextValue(blob.Radius / ReachPerRadius);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  data->GetPointData()->AddArray(ids);
  return data;
}

Scene MakeScene(const Cloud& cloud, int lastStep, const std::string& story)
{
  const auto inside = [cloud](double time) -> Formula
  {
    std::vector<double> places, radii;
    for (const Blob& blob : cloud(time))
    {
      places.insert(places.end(), blob.Centre.begin(), blob.Centre.end());
      radii.push_back(blob.Radius);
    }
    auto potential = vtkSmartPointer<vtkSkeletonPotential>::New();
    potential->SetElements(
      static_cast<vtkIdType>(radii.size()), places.data(), radii.data(), nullptr);
    return [potential](const Point& point)
    {
      Point place = point;
      return potential->EvaluateFunction(place.data());
    };
  };
  return { [cloud](double time) { return MakeBlobs(cloud(time)); }, inside, lastStep, story };
}

// Seven particles that form a ball of radius about 0.32, times a scale.
void AddBall(std::vector<Blob>& blobs, const Point& centre, double scale)
{
  blobs.push_back({ centre, 0.4 * scale });
  for (int i = 0; i < 6; ++i)
  {
    Point place = centre;
    place[i / 2] += (i % 2 == 0 ? 0.12 : -0.12) * scale;
    blobs.push_back({ place, 0.4 * scale });
  }
}

// Particles on a spiral around a sphere, nearly evenly spaced.
std::vector<Blob> MakeShellOfParticles(double radius)
{
  constexpr int count = 150;
  std::vector<Blob> blobs;
  for (int i = 0; i < count; ++i)
  {
    const double height = 1.0 - (2.0 * i + 1.0) / count;
    const double width = std::sqrt(1.0 - height * height);
    const double turn = Pi * (3.0 - std::sqrt(5.0)) * i;
    blobs.push_back(
      { { radius * width * std::cos(turn), radius * width * std::sin(turn), radius * height },
        0.35 });
  }
  return blobs;
}

}

TEST(TestFilterTopology, TwoCloudsMeetAndPart)
{
  const Cloud cloud = [](double time)
  {
    const double apart = 0.1 + 0.1 * std::abs(5.0 - time);
    std::vector<Blob> blobs;
    AddBall(blobs, { -apart, 0.01, 0.02 }, 1.0);
    AddBall(blobs, { apart, 0.03, -0.01 }, 1.0);
    return blobs;
  };
  IsFollowed(MakeScene(cloud, 10, "2 0 4, 1 0 2, 2 0 4"));
}

TEST(TestFilterTopology, OneOfTwoCloudsVanishes)
{
  const Cloud shrinking = [](double time)
  {
    std::vector<Blob> blobs;
    AddBall(blobs, { -0.5, 0.01, 0.02 }, 1.0);
    AddBall(blobs, { 0.45, 0.03, -0.01 }, std::max(0.0, 1.2 - 0.3 * time));
    return blobs;
  };
  IsFollowed(MakeScene(shrinking, 7, "2 0 4, 1 0 2"));
  const Cloud leaving = [](double time)
  {
    std::vector<Blob> blobs;
    AddBall(blobs, { -0.5, 0.01, 0.02 }, 1.0);
    if (time < 3.0)
    {
      AddBall(blobs, { 0.45, 0.03, -0.01 }, 1.0);
    }
    return blobs;
  };
  IsFollowed(MakeScene(leaving, 6, "2 0 4, 1 0 2"));
}

TEST(TestFilterTopology, RingClosesAndOpens)
{
  const Cloud cloud = [](double time)
  {
    const double ring = 0.15 + 0.1 * std::abs(5.0 - time);
    std::vector<Blob> blobs;
    for (int i = 0; i < 24; ++i)
    {
      const double turn = Pi * i / 12.0;
      blobs.push_back(
        { { 0.01 + ring * std::cos(turn), 0.02 + ring * std::sin(turn), 0.013 }, 0.4 });
    }
    return blobs;
  };
  IsFollowed(MakeScene(cloud, 10, "1 0 0, 1 0 2, 1 0 0"));
}

TEST(TestFilterTopology, VoidOfAShellCloses)
{
  const Cloud cloud = [](double time) { return MakeShellOfParticles(0.7 - 0.1 * time); };
  IsFollowed(MakeScene(cloud, 6, "1 1 4, 1 0 2"));
}

TEST(TestFilterTopology, VoidClosesAndOpens)
{
  const Cloud cloud = [](double time)
  { return MakeShellOfParticles(0.2 + 0.1 * std::abs(4.0 - time)); };
  IsFollowed(MakeScene(cloud, 8, "1 1 4, 1 0 2, 1 1 4"));
}

namespace
{

// Weight of the second of two shapes: 0, 0.1 .. 1 .. 0.1, 0.
double GetShare(double time)
{
  return 1.0 - 0.1 * std::abs(10.0 - time);
}

Formula BlendBallAndTorus(double time)
{
  const auto ball = MakeBall({ 0.01, 0.02, 0.013 }, 0.5).Value;
  const auto torus = MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.22).Value;
  const double share = GetShare(time);
  return [ball, torus, share](const Point& point)
  { return (1.0 - share) * ball(point) + share * torus(point); };
}

vtkSmartPointer<vtkImageData> MakeFormulaImage(const Formula& formula)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-25, 25, -25, 25, -25, 25);
  image->SetSpacing(0.04, 0.04, 0.04);
  vtkNew<vtkDoubleArray> values;
  values->SetName("values");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Point point;
    image->GetPoint(i, point.data());
    values->InsertNextValue(formula(point));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

}

// The value at the centre changes by 0.083 from step to step, and the slope of the blend is at most
// 1, so the surface moves by at least 0.083.
TEST(TestFilterTopology, ImageOfABallBecomesATorusAndABall)
{
  IsFollowed({ [](double time) { return MakeFormulaImage(BlendBallAndTorus(time)); },
    BlendBallAndTorus, 20, "1 0 2, 1 0 0, 1 0 2" });
}

TEST(TestFilterTopology, MeshesMeetAndPart)
{
  const auto apart = [](double time) { return 0.15 + 0.1 * std::abs(4.0 - time); };
  const auto meshes = [apart](double time)
  {
    vtkNew<vtkAppendPolyData> both;
    both->AddInputData(MakeBallMesh(0.35, apart(time)));
    both->AddInputData(MakeBallMesh(0.3, -apart(time)));
    both->Update();
    return vtkSmartPointer<vtkPolyData>(both->GetOutput());
  };
  const auto balls = [apart](double time)
  {
    const Shape shape =
      MakeBalls({ { { apart(time), 0.0, 0.0 }, 0.35 }, { { -apart(time), 0.0, 0.0 }, 0.3 } });
    return shape.Value;
  };
  IsFollowed({ meshes, balls, 8, "2 0 4, 1 0 2, 2 0 4" });
}

}

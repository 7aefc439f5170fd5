// Results from particles do not depend on their order in the input.

#include "Support/PipelineTools.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestParticleOrder
{

namespace
{

constexpr int Count = 400;
constexpr int Twins = 20;

// Random particles in an order given by a seed (0: in the order of drawing). The last 20 are twins
// of the first 20: their strengths of 1e8 and -1e8 cancel except for rounding, so the result
// depends on the order of the sum.
vtkSmartPointer<vtkPolyData> MakeParticles(unsigned seed)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(0.0, 1.0);
  std::vector<std::array<double, 4>> drawn(Count);
  for (auto& particle : drawn)
  {
    particle = { side(random), side(random), side(random), 0.15 + 0.1 * side(random) };
  }
  std::copy_n(drawn.begin(), Twins, drawn.end() - Twins);
  std::vector<int> order(Count);
  std::iota(order.begin(), order.end(), 0);
  if (seed > 0)
  {
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  vtkNew<vtkDoubleArray> strengths;
  strengths->SetName("strength");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("id");
  for (const int i : order)
  {
    points->InsertNextPoint(drawn[i].data());
    radii->InsertNextValue(drawn[i][3]);
    strengths->InsertNextValue(i < Twins ? 1e8 : i >= Count - Twins ? -1e8 : 1.0);
    ids->InsertNextValue((i * 37) % Count);
  }
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  particles->SetPoints(points);
  particles->GetPointData()->AddArray(radii);
  particles->GetPointData()->AddArray(strengths);
  particles->GetPointData()->AddArray(ids);
  return particles;
}

std::string MakeSkin(unsigned seed, bool hasIds)
{
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInputDataObject(0, MakeParticles(seed));
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "radius");
  filter->SetInputArrayToProcess(2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "strength");
  if (hasIds)
  {
    filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  }
  filter->SetParticleModel(vtkActiveImplicitSurface::SUM);
  filter->SetVoxelSize(0.04);
  filter->SetAttraction(4.0);
  filter->PassTargetArraysOn();
  return GetBytesAt(filter, 0.2);
}

}

TEST(TestParticleOrder, WithoutIdsItIsThatOfTheirPlaces)
{
  const std::string expected = MakeSkin(0, false);
  for (const unsigned seed : { 1u, 2u })
  {
    EXPECT_TRUE(AreSameSkins(MakeSkin(seed, false), expected)) << "in the order " << seed;
  }
}

TEST(TestParticleOrder, WithIdsItIsTheirs)
{
  const std::string expected = MakeSkin(0, true);
  for (const unsigned seed : { 1u, 2u })
  {
    EXPECT_TRUE(AreSameSkins(MakeSkin(seed, true), expected)) << "in the order " << seed;
  }
}

// If these bytes were equal, the tests above could not fail.
TEST(TestParticleOrder, AnotherOrderWouldGiveOtherBytes)
{
  EXPECT_FALSE(AreSameSkins(MakeSkin(0, true), MakeSkin(0, false)));
}

}

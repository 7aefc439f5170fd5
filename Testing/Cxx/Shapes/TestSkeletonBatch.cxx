// vtkSkeletonPotential at many points at once, evaluated together if they share their cells. The
// results are bitwise identical to those of the same points one by one.

#include "Support/MessageCapture.h"
#include "Support/SkeletonShapes.h"

#include "Base/InstructionSets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkeletonBatch
{
constexpr InstructionSet AllSets[] = { InstructionSet::Baseline, InstructionSet::Avx2,
  InstructionSet::Avx512 };

// Clusters of up to forty points near the elements, with half sides from a hundredth of `size` to
// `size`.
std::vector<Point> Crowds(SkeletonBuilder& shape, Random& random, double size)
{
  std::vector<Point> places;
  for (const Point& x : PlacesNear(shape, random, 120))
  {
    const int count = static_cast<int>(random.Between(1.0, 40.0));
    const double half = size * std::pow(100.0, -random.Between(0.0, 1.0));
    for (int i = 0; i < count; ++i)
    {
      const Point by = random.In(-half, half);
      places.push_back({ x[0] + by[0], x[1] + by[1], x[2] + by[2] });
    }
  }
  return places;
}

bool IsSame(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

// Number of points where a batch and a single evaluation differ in any bit.
int CountDifferent(vtkSkeletonPotential* potential, const std::vector<Point>& places)
{
  std::vector<double> values(places.size()), valuesOnly(places.size());
  std::vector<Point> gradients(places.size());
  const auto count = static_cast<vtkIdType>(places.size());
  potential->Build();
  potential->EvaluateBatch(count, places[0].data(), values.data(), gradients[0].data());
  potential->EvaluateBatch(count, places[0].data(), valuesOnly.data(), nullptr);
  int different = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Point gradient = GradientAt(potential, places[i]);
    bool same =
      IsSame(values[i], valuesOnly[i]) && IsSame(values[i], ValueAt(potential, places[i]));
    for (int axis = 0; axis < 3; ++axis)
    {
      same = same && IsSame(gradients[i][axis], gradient[axis]);
    }
    different += same ? 0 : 1;
  }
  return different;
}

void FillOneLattice(SkeletonBuilder& shape, Random& random)
{
  for (int i = 0; i < 700; ++i)
  {
    shape.Add(random.In(0.0, 1.0), random.Between(0.1, 0.11), random.Between(-0.5, 1.0));
  }
}

TEST(TestSkeletonBatch, CrowdsGiveTheBitsOfSinglePlaces)
{
  const InstructionSet usual = GetInstructionSet();
  for (const std::string name : { "one lattice", "many lattices", "segments" })
  {
    Random random(8);
    SkeletonBuilder shape;
    if (name == "one lattice")
    {
      FillOneLattice(shape, random);
    }
    else
    {
      Fill(shape, random, 500, name == "segments" ? 300 : 0, 0.4, 1.0);
    }
    const std::vector<Point> places = Crowds(shape, random, 0.1);
    for (const int kernel : { 0, 1, 2 })
    {
      vtkNew<vtkSkeletonPotential> potential;
      shape.GiveTo(potential);
      potential->SetKernel(kernel);
      for (const InstructionSet set : AllSets)
      {
        SetInstructionSet(set);
        EXPECT_EQ(CountDifferent(potential, places), 0)
          << name << ", kernel " << kernel << ", instruction set " << (static_cast<int>(set))
          << ": points that differ";
      }
    }
  }
  SetInstructionSet(usual);
}

TEST(TestSkeletonBatch, PlacesThatAreNotFiniteLeaveTheirCrowdAlone)
{
  Random random(9);
  SkeletonBuilder shape;
  FillOneLattice(shape, random);
  std::vector<Point> places = Crowds(shape, random, 0.05);
  for (std::size_t i = 3; i < places.size(); i += 5)
  {
    places[i][i % 3] = i % 2 == 0 ? NaN : i % 4 == 1 ? Infinity : -Infinity;
  }
  places[1] = { 1e300, -1e300, 1e300 };
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  EXPECT_EQ(CountDifferent(potential, places), 0) << "points that differ";
  SkeletonBuilder nothing;
  vtkNew<vtkSkeletonPotential> empty;
  nothing.GiveTo(empty);
  MessageCapture messages(empty);
  EXPECT_EQ(CountDifferent(empty, places), 0) << "points that differ, without elements";
}

TEST(TestSkeletonBatch, ValuesHaveOneComponentWhateverTheirArrayHadBefore)
{
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 });
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  vtkNew<vtkDoubleArray> places, values;
  places->SetNumberOfComponents(3);
  places->InsertNextTuple3(0.0, 0.0, 0.0);
  places->InsertNextTuple3(2.0, 0.0, 0.0);
  values->SetNumberOfComponents(3);
  potential->FunctionValue(places, values);
  ASSERT_EQ(values->GetNumberOfComponents(), 1) << "components";
  ASSERT_EQ(values->GetNumberOfTuples(), 2) << "values";
  EXPECT_EQ(values->GetValue(0), -0.5) << "inside";
  EXPECT_EQ(values->GetValue(1), 0.5) << "outside";
}

// All points beyond 2^31 of the finest cells fall into the last one, but into different coarse
// cells.
TEST(TestSkeletonBatch, PlacesBeyondTheFinestCellsAreNotTakenTogether)
{
  Random random(10);
  SkeletonBuilder shape;
  shape.Add({ 0.0, 0.0, 0.0 }, 1e-3);
  std::vector<Point> places;
  for (int i = 0; i < 300; ++i)
  {
    const Point p = random.In(1e7, 1e7 + 20.0);
    shape.Add(p, random.Between(1.2, 1.3));
    places.push_back({ p[0] + 0.5, p[1], p[2] });
  }
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  EXPECT_EQ(CountDifferent(potential, places), 0) << "points that differ";
}
}

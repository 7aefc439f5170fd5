// Sums of vtkSkeletonPotential compared with sums over all elements one by one, and with all
// methods of evaluation. == means bitwise identical.

#include "Support/SkeletonShapes.h"

#include "Base/InstructionSets.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

using namespace activesurface;

namespace TestSkeletonCells
{
constexpr double Lost = 1e-300;
double Round(double value)
{
  return std::fabs(value) < 1e-290 ? 0.0 : value;
}

const char* const KernelNames[] = { "Wyvill", "cubic spline", "metaball" };

// Elements of a shape whose segments share no points, each in a potential of its own, in the order
// of insertion. Beside a contribution, the threshold is lost by rounding, so F is the negated
// contribution.
std::vector<vtkNew<vtkSkeletonPotential>> TakeApart(SkeletonBuilder& shape, int points, int kernel)
{
  const int elements = points + static_cast<int>(shape.Lines->GetNumberOfCells());
  std::vector<vtkNew<vtkSkeletonPotential>> parts(elements);
  for (int i = 0; i < elements; ++i)
  {
    SkeletonBuilder part;
    const vtkIdType first = i < points ? i : points + 2 * (i - points);
    for (vtkIdType id = first; id < first + (i < points ? 1 : 2); ++id)
    {
      Point p;
      shape.Points->GetPoint(id, p.data());
      part.Add(p, shape.Radii->GetValue(id), shape.Strengths->GetValue(id));
    }
    if (i >= points)
    {
      part.Join({ 0, 1 });
    }
    part.GiveTo(parts[i]);
    parts[i]->SetKernel(kernel);
    parts[i]->SetThreshold(Lost);
  }
  return parts;
}

void CheckAgainstParts(SkeletonBuilder& shape, int points, int kernel,
  const std::vector<Point>& places, const std::string& sentence)
{
  vtkNew<vtkSkeletonPotential> whole;
  shape.GiveTo(whole);
  whole->SetKernel(kernel);
  whole->SetThreshold(Lost);
  const auto parts = TakeApart(shape, points, kernel);
  int different = 0;
  int touched = 0;
  for (const Point& x : places)
  {
    double value = 0.0;
    Point gradient = { 0.0, 0.0, 0.0 };
    for (const auto& part : parts)
    {
      const Point own = GradientAt(part, x);
      value += ValueAt(part, x);
      for (int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += own[axis];
      }
    }
    touched += Round(value) != 0.0 ? 1 : 0;
    different +=
      Round(value) != Round(ValueAt(whole, x)) || gradient != GradientAt(whole, x) ? 1 : 0;
  }
  EXPECT_EQ(different, 0) << sentence << ": points where the bits differ";
  EXPECT_TRUE(touched > static_cast<int>(places.size()) / 4) << sentence << ": supports are met";
}

// Radii vary by a factor of 100: many lattices are merged.
TEST(TestSkeletonCells, CellsGiveTheSumOverAllElements)
{
  for (const int kernel : { 0, 1, 2 })
  {
    Random random(4);
    SkeletonBuilder shape;
    Fill(shape, random, 700, 300, 0.5, 1.0);
    const std::vector<Point> places = PlacesNear(shape, random, 400);
    CheckAgainstParts(shape, 700, kernel, places, KernelNames[kernel]);
  }
}

// The number of elements is so large that several tasks list them.
TEST(TestSkeletonCells, CellsOfManyElementsGiveTheSumOverAll)
{
  Random random(11);
  SkeletonBuilder shape;
  Fill(shape, random, 6500, 2500, 0.5, 1.0);
  CheckAgainstParts(shape, 6500, 0, PlacesNear(shape, random, 60), "9000 elements");
}

TEST(TestSkeletonCells, CellsAreRightForAnyLayout)
{
  Random random(5);
  struct Cloud
  {
    const char* Name;
    Point Size;
    Point Offset;
    double Radius;
  };
  for (const Cloud& cloud : { Cloud{ "dense", { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 }, 0.3 },
         Cloud{ "far from the origin", { 1.0, 1.0, 1.0 }, { 1e9, -1e9, 1e9 }, 0.2 },
         Cloud{ "radius below the rounding", { 1e3, 1e3, 1e3 }, { 1e9, 0.0, 0.0 }, 1e-12 },
         Cloud{ "sparse", { 1e12, 1e12, 1e12 }, { 0.0, 0.0, 0.0 }, 1e-3 },
         Cloud{ "all in one place", { 0.0, 0.0, 0.0 }, { 1.0, 2.0, 3.0 }, 0.1 },
         Cloud{ "in a plane", { 1.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, 0.1 } })
  {
    SkeletonBuilder shape;
    for (int i = 0; i < 600; ++i)
    {
      const Point p = random.In(0.0, 1.0);
      shape.Add({ cloud.Offset[0] + p[0] * cloud.Size[0], cloud.Offset[1] + p[1] * cloud.Size[1],
                  cloud.Offset[2] + p[2] * cloud.Size[2] },
        cloud.Radius * random.Between(0.6, 1.0), random.Between(-0.5, 1.0));
    }
    CheckAgainstParts(shape, 600, 0, PlacesNear(shape, random, 400), cloud.Name);
  }
}

// Moves all points by up to `way` along each axis; radii are multiplied by about `growth`.
void Move(SkeletonBuilder& shape, Random& random, double way, double growth)
{
  for (vtkIdType id = 0; id < shape.Points->GetNumberOfPoints(); ++id)
  {
    Point p;
    const Point by = random.In(-way, way);
    shape.Points->GetPoint(id, p.data());
    shape.Points->SetPoint(id, p[0] + by[0], p[1] + by[1], p[2] + by[2]);
    const double factor = growth * random.Between(0.995, 1.005);
    shape.Radii->SetValue(id, shape.Radii->GetValue(id) * factor);
  }
  shape.Points->Modified();
  shape.Radii->Modified();
}

// Short displacements keep the cells, long ones do not. Far from the origin, displacements are
// rounded.
TEST(TestSkeletonCells, ElementsThatMoveGiveTheBitsOfFreshOnes)
{
  for (const double offset : { 0.0, 1e9 })
  {
    Random random(6);
    SkeletonBuilder shape;
    for (int i = 0; i < 400; ++i)
    {
      const Point p = random.In(0.0, 1.0);
      shape.Add({ p[0] + offset, p[1] - offset, p[2] }, random.Between(0.1, 0.3), 1.0);
    }
    for (vtkIdType id = 300; id < 400; id += 2)
    {
      shape.Join({ id, id + 1 });
    }
    vtkNew<vtkSkeletonPotential> moved;
    shape.GiveTo(moved);
    int different = 0, touched = 0;
    for (int step = 0; step < 40; ++step)
    {
      Move(shape, random, step % 8 == 7 ? 0.2 : 0.004, step > 30 ? 0.95 : 1.0);
      vtkNew<vtkSkeletonPotential> fresh;
      shape.GiveTo(fresh);
      for (const Point& x : PlacesNear(shape, random, 100))
      {
        const double value = ValueAt(moved, x);
        touched += value != moved->GetThreshold() ? 1 : 0;
        different += value != ValueAt(fresh, x) || GradientAt(moved, x) != GradientAt(fresh, x);
      }
    }
    EXPECT_EQ(different, 0) << "points where the bits differ, offset " << offset;
    EXPECT_TRUE(touched > 3000) << "supports are met";
  }
}

// One lattice of cells, and several merged lattices.
TEST(TestSkeletonCells, AnyInstructionSetGivesTheSameBits)
{
  const InstructionSet usual = GetInstructionSet();
  for (const bool isMerged : { false, true })
  {
    Random random(7);
    SkeletonBuilder shape;
    for (int i = 0; i < (isMerged ? 0 : 500); ++i)
    {
      shape.Add(random.In(0.0, 1.0), random.Between(0.1, 0.11), 1.0);
    }
    if (isMerged)
    {
      Fill(shape, random, 500, 200, 0.5, 1.0);
    }
    for (const int kernel : { 0, 1, 2 })
    {
      vtkNew<vtkSkeletonPotential> potential;
      shape.GiveTo(potential);
      potential->SetKernel(kernel);
      int different = 0;
      for (const Point& x : PlacesNear(shape, random, 300))
      {
        SetInstructionSet(InstructionSet::Baseline);
        const double value = ValueAt(potential, x);
        const Point gradient = GradientAt(potential, x);
        for (const InstructionSet set : { InstructionSet::Avx2, InstructionSet::Avx512 })
        {
          SetInstructionSet(set);
          different += ValueAt(potential, x) != value || GradientAt(potential, x) != gradient;
        }
      }
      EXPECT_EQ(different, 0) << "points that differ, " << KernelNames[kernel];
    }
  }
  SetInstructionSet(usual);
}

TEST(TestSkeletonCells, BatchesAndArraysGiveTheSameBits)
{
  Random random(6);
  SkeletonBuilder shape;
  Fill(shape, random, 500, 100, 0.4, 1.0);
  const std::vector<Point> places = PlacesNear(shape, random, 5000);
  const auto count = static_cast<vtkIdType>(places.size());
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);

  std::vector<double> values(places.size());
  std::vector<Point> gradients(places.size());
  potential->Build();
  potential->EvaluateBatch(count, places[0].data(), values.data(), gradients[0].data());
  std::vector<double> valuesOnly(places.size());
  potential->EvaluateBatch(count, places[0].data(), valuesOnly.data(), nullptr);
  EXPECT_TRUE(values == valuesOnly) << "a batch without gradients";

  vtkNew<vtkDoubleArray> points;
  points->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> doubles;
  vtkNew<vtkFloatArray> floats;
  for (const Point& x : places)
  {
    points->InsertNextTuple(x.data());
  }
  potential->FunctionValue(points, doubles);
  potential->FunctionValue(points, floats);
  int different = doubles->GetNumberOfTuples() == count ? 0 : 1;
  for (vtkIdType i = 0; i < count; ++i)
  {
    different += doubles->GetValue(i) != values[i] ? 1 : 0;
    different += floats->GetValue(i) != static_cast<float>(values[i]) ? 1 : 0;
    different += GradientAt(potential, places[i]) != gradients[i] ? 1 : 0;
  }
  EXPECT_EQ(different, 0) << "arrays and single gradients that differ";
}

// Four threads make the first evaluation at the same time, which reads the input.
TEST(TestSkeletonCells, ThreadsThatReadTheInputTogetherGiveTheSameBits)
{
  Random random(7);
  SkeletonBuilder shape;
  Fill(shape, random, 2000, 100, 0.2, 1.0);
  const std::vector<Point> places = PlacesNear(shape, random, 200);
  vtkNew<vtkSkeletonPotential> potential;
  shape.GiveTo(potential);
  std::vector<double> expected;
  for (const Point& x : places)
  {
    expected.push_back(ValueAt(potential, x));
  }
  int different = 0;
  for (int round = 0; round < 20; ++round)
  {
    potential->Modified();
    std::atomic<int> waiting{ 4 };
    std::vector<std::vector<double>> values(4);
    std::vector<std::thread> threads;
    for (std::vector<double>& own : values)
    {
      threads.emplace_back(
        [&]
        {
          --waiting;
          while (waiting > 0)
          {
          }
          for (const Point& x : places)
          {
            own.push_back(ValueAt(potential, x));
          }
        });
    }
    for (int i = 0; i < 4; ++i)
    {
      threads[i].join();
      different += values[i] != expected ? 1 : 0;
    }
  }
  EXPECT_EQ(different, 0) << "threads that differ";
}
}

// Helpers for the tests of vtkSkeletonPotential: skeletons made point by point, and random points.
#ifndef SkeletonShapes_h
#define SkeletonShapes_h

#include "Support/Point.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace activesurface
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
inline double ValueAt(vtkSkeletonPotential* potential, Point x)
{
  return potential->EvaluateFunction(x.data());
}

inline Point GradientAt(vtkSkeletonPotential* potential, Point x)
{
  Point gradient;
  potential->EvaluateGradient(x.data(), gradient.data());
  return gradient;
}

inline double Distance(const Point& a, const Point& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class Random
{
public:
  explicit Random(unsigned seed)
    : Generator(seed)
  {
  }

  double Between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Generator);
  }

  Point In(double low, double high)
  {
    return { this->Between(low, high), this->Between(low, high), this->Between(low, high) };
  }

  Point Direction()
  {
    for (;;)
    {
      const Point p = this->In(-1.0, 1.0);
      const double length = Distance(p, { 0.0, 0.0, 0.0 });
      if (length > 0.1 && length < 1.0)
      {
        return { p[0] / length, p[1] / length, p[2] / length };
      }
    }
  }

private:
  std::mt19937_64 Generator;
};

class SkeletonBuilder
{
public:
  SkeletonBuilder()
  {
    this->Radii->SetName("r");
    this->Strengths->SetName("s");
    this->Data->SetPoints(this->Points);
    this->Points->SetDataTypeToDouble();
    this->Data->GetPointData()->AddArray(this->Radii);
    this->Data->GetPointData()->AddArray(this->Strengths);
    this->Data->SetLines(this->Lines);
    this->Data->SetVerts(this->Verts);
  }

  vtkIdType Add(const Point& p, double radius = 1.0, double strength = 1.0)
  {
    this->Radii->InsertNextValue(radius);
    this->Strengths->InsertNextValue(strength);
    return this->Points->InsertNextPoint(p.data());
  }

  void Join(const std::vector<vtkIdType>& ids)
  {
    this->Lines->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }

  void Mark(vtkIdType id) { this->Verts->InsertNextCell(1, &id); }

  void GiveTo(vtkSkeletonPotential* potential)
  {
    potential->SetInput(this->Data);
    potential->SetRadiusArrayName("r");
    potential->SetStrengthArrayName("s");
  }

  vtkNew<vtkPolyData> Data;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Radii;
  vtkNew<vtkDoubleArray> Strengths;
  vtkNew<vtkCellArray> Lines;
  vtkNew<vtkCellArray> Verts;
};

// Adds points and tapered segments of various sizes, some of them long and thin. The points and the
// starts of the segments lie in a cube of side `spread`.
inline void Fill(
  SkeletonBuilder& shape, Random& random, int points, int segments, double radius, double spread)
{
  const auto add = [&](const Point& p)
  {
    const double r = radius * std::pow(100.0, -random.Between(0.0, 1.0));
    return shape.Add(p, r, random.Between(-0.5, 1.0));
  };
  for (int i = 0; i < points; ++i)
  {
    add(random.In(0.0, spread));
  }
  for (int i = 0; i < segments; ++i)
  {
    const Point start = random.In(0.0, spread);
    const Point direction = random.Direction();
    const double length = spread * std::pow(1000.0, -random.Between(0.0, 1.0));
    const vtkIdType first = add(start);
    const vtkIdType last = add({ start[0] + length * direction[0], start[1] + length * direction[1],
      start[2] + length * direction[2] });
    shape.Join({ first, last });
  }
}

// Points near the elements: anywhere in a random support, or just inside or outside its boundary.
inline std::vector<Point> PlacesNear(SkeletonBuilder& shape, Random& random, int count)
{
  std::vector<Point> places;
  for (int i = 0; i < count; ++i)
  {
    const auto id = static_cast<vtkIdType>(
      random.Between(0.0, static_cast<double>(shape.Points->GetNumberOfPoints()) - 0.5));
    const double radius = shape.Radii->GetValue(id);
    const double edge = 1.0 + random.Between(-4.0, 4.0) * Epsilon;
    const double distance = radius * (i % 2 == 0 ? random.Between(0.0, 1.0) : edge);
    const Point direction = random.Direction();
    Point p;
    shape.Points->GetPoint(id, p.data());
    places.push_back({ p[0] + distance * direction[0], p[1] + distance * direction[1],
      p[2] + distance * direction[2] });
  }
  return places;
}

}

#endif

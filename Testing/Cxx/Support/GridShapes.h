// Helpers for the tests of vtkGridPotential: values at points, concurrent evaluation by threads,
// and images.
#ifndef GridShapes_h
#define GridShapes_h

#include "Support/SkeletonShapes.h"

#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

namespace activesurface
{

inline double ValueAt(vtkGridPotential* potential, Point x)
{
  return potential->EvaluateFunction(x.data());
}

inline Point GradientAt(vtkGridPotential* potential, Point x)
{
  Point gradient;
  potential->EvaluateGradient(x.data(), gradient.data());
  return gradient;
}

// Compares bitwise: NaN equals NaN.
inline bool AreSameBytes(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// Values and gradients (4 numbers for each point), one point after the other.
inline std::vector<double> SampleAll(vtkGridPotential* potential, const std::vector<Point>& points)
{
  std::vector<double> samples;
  for (const Point& x : points)
  {
    const Point gradient = GradientAt(potential, x);
    samples.push_back(ValueAt(potential, x));
    samples.insert(samples.end(), gradient.begin(), gradient.end());
  }
  return samples;
}

// SampleAll by several threads at once: the first of them reads the input.
inline std::vector<std::vector<double>> SampleByThreads(
  vtkGridPotential* potential, const std::vector<Point>& points)
{
  std::vector<std::vector<double>> samples(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& own : samples)
  {
    threads.emplace_back([&own, potential, &points] { own = SampleAll(potential, points); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  return samples;
}

// Geometry of an image. The axes of a turned image are rotated about z by an angle of cosine 0.8,
// then cyclically exchanged.
struct Place
{
  explicit Place(bool isTurned)
  {
    if (isTurned)
    {
      this->Direction = { 0.0, 0.0, 1.0, 0.8, -0.6, 0.0, 0.6, 0.8, 0.0 };
    }
  }

  Point At(const Point& pixel) const
  {
    Point x = this->Origin;
    for (int d = 0; d < 3; ++d)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        x[d] += this->Direction[3 * d + axis] * this->Spacing[axis] * pixel[axis];
      }
    }
    return x;
  }

  // Gradient in space from a gradient per pixel.
  Point Turn(const Point& rise) const
  {
    Point gradient = { 0.0, 0.0, 0.0 };
    for (int d = 0; d < 3; ++d)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        gradient[d] += this->Direction[3 * d + axis] * rise[axis] / this->Spacing[axis];
      }
    }
    return gradient;
  }

  Point Origin = { 1.0, -2.0, 3.0 };
  Point Spacing = { 0.5, 0.25, 2.0 };
  std::array<int, 6> Extent = { 2, 6, -3, 2, 10, 16 };
  std::array<double, 9> Direction = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
};

using Field = std::function<double(double i, double j, double k)>;

inline double Linear(double i, double j, double k)
{
  return 2.0 * i + 3.0 * j + 5.0 * k - 40.0; // 5 to 58: fits every type
}

inline vtkSmartPointer<vtkImageData> MakeImage(const Place& place, int type, const Field& field)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  auto extent = place.Extent;
  image->SetExtent(extent.data());
  image->SetOrigin(place.Origin.data());
  image->SetSpacing(place.Spacing.data());
  image->SetDirectionMatrix(place.Direction.data());
  image->AllocateScalars(type, 1);
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        image->SetScalarComponentFromDouble(i, j, k, 0, field(i, j, k));
      }
    }
  }
  return image;
}

inline Point PixelIn(const Place& place, Random& random)
{
  const auto& e = place.Extent;
  return { random.Between(e[0], e[1]), random.Between(e[2], e[3]), random.Between(e[4], e[5]) };
}

inline vtkSmartPointer<vtkImageData> MakeNoise(const Place& place, unsigned seed)
{
  Random random(seed);
  return MakeImage(
    place, VTK_DOUBLE, [&random](double, double, double) { return random.Between(-1.0, 1.0); });
}

inline vtkSmartPointer<vtkImageData> MakeSmallImage(int x, int y, int z, int components = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(x, y, z);
  image->AllocateScalars(VTK_FLOAT, components);
  image->GetPointData()->GetScalars()->Fill(-1.0);
  return image;
}

}

#endif

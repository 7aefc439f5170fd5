// What the tests of vtkGridPotential share: values at points, and threads that take them at once.
#ifndef GridShapes_h
#define GridShapes_h

#include "SkeletonShapes.h"

#include "vtkGridPotential.h"

#include <cstddef>
#include <cstring>
#include <thread>
#include <vector>

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

// Bit by bit: NaN equals NaN.
inline bool AreSameBytes(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// Values and gradients (4 numbers each), one point after the other.
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

// SampleAll by several threads at once, of which the first to come reads the input.
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

#endif

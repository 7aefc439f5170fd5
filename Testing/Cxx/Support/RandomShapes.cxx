#include "Support/RandomShapes.h"

#include <cmath>

namespace activesurface
{
namespace
{

/** Number in [-1, 1) for the corner of a cell: a hash of the corner's coordinates. */
double NoiseAt(const std::int64_t corner[3])
{
  std::uint64_t bits = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    bits = (bits + static_cast<std::uint64_t>(corner[axis])) * 6364136223846793005ull;
    bits ^= bits >> 29;
  }
  return std::ldexp(static_cast<double>(bits >> 11), -52) - 1.0;
}

double NoiseWithin(const Point& x, double cell)
{
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::int64_t at[3];
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double below = std::floor(x[axis] / cell), part = x[axis] / cell - below;
      const int upper = (corner >> axis) & 1;
      at[axis] = static_cast<std::int64_t>(below) + upper;
      weight *= upper ? part : 1.0 - part;
    }
    sum += weight * NoiseAt(at);
  }
  return sum;
}

}

RandomShapes::RandomShapes(std::uint32_t seed)
  : Generator(seed)
{
}

double RandomShapes::DrawBetween(double least, double most)
{
  return least + (most - least) * (this->Generator() / 4294967296.0);
}

Point RandomShapes::DrawPointNear(const Point& point)
{
  constexpr double reach = 0.05;
  Point drawn = point;
  for (double& coordinate : drawn)
  {
    coordinate += this->DrawBetween(-reach, reach);
  }
  return drawn;
}

double RandomShapes::DrawLengthNear(double length)
{
  return this->DrawBetween(0.9 * length, 1.1 * length);
}

Ball RandomShapes::DrawBallNear(const Ball& ball)
{
  return { this->DrawPointNear(ball.Centre), this->DrawLengthNear(ball.Radius) };
}

Shape MakeNoisy(const Shape& shape, double cell, double amplitude)
{
  Shape noisy = shape;
  noisy.Value = [smooth = shape.Value, cell, amplitude](const Point& x)
  { return smooth(x) + amplitude * NoiseWithin(x, cell); };
  noisy.Slope = [value = noisy.Value, step = 1e-4 * cell](const Point& x)
  {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      Point above = x, below = x;
      above[axis] += step;
      below[axis] -= step;
      const double slope = .5 * (value(above) - value(below)) / step;
      square += slope * slope;
    }
    return std::sqrt(square);
  };
  return noisy;
}
}

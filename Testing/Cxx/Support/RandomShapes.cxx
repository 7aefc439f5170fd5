#include "Support/RandomShapes.h"

namespace activesurface
{
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
}

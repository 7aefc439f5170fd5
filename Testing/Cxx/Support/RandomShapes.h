/**
 * Centres and lengths drawn at random near given ones: scenes for which no constant of the scheme
 * was chosen.
 *
 * The numbers are the same on every platform, because only the bits of std::mt19937 are used. The
 * distributions of the C++ standard library differ between platforms.
 *
 * Draw into variables or within braces, because the compiler chooses the order in which the
 * arguments of a call are evaluated.
 */
#ifndef RandomShapes_h
#define RandomShapes_h

#include "Support/AnalyticShapes.h"

#include <cstdint>
#include <random>

namespace activesurface
{
class RandomShapes
{
public:
  explicit RandomShapes(std::uint32_t seed);

  /** Uniform in [least, most). */
  double DrawBetween(double least, double most);

  /** Point within 0.05 along each axis. */
  Point DrawPointNear(const Point& point);

  /** Length within 10 %. */
  double DrawLengthNear(double length);

  Ball DrawBallNear(const Ball& ball);

private:
  std::mt19937 Generator;
};

/** The shape plus noise in [-amplitude, amplitude], drawn at the corners of cells and trilinear in
 * between, as in an image of spacing `cell`. */
Shape MakeNoisy(const Shape& shape, double cell, double amplitude);
}

#endif

/**
 * Centres and lengths drawn at random near given ones: scenes for which no constant of the scheme
 * was chosen.
 *
 * The same numbers in every run and on every platform: the bits are those of std::mt19937, which
 * the C++ standard fixes; its distributions, which differ between libraries, are not used.
 *
 * Each test has a generator with its own seed, so that its numbers do not depend on other tests.
 * Draw into variables or within braces, in the order of the text: the order in which a call's
 * arguments are evaluated is the compiler's.
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

  /** Uniform in [least, most): least + (most - least) * bits / 2^32. */
  double DrawBetween(double least, double most);

  /** Point within 0.05 along each axis. */
  Point DrawPointNear(const Point& point);

  /** Length within 10 %. */
  double DrawLengthNear(double length);

  /** Ball whose centre and radius are drawn as above. */
  Ball DrawBallNear(const Ball& ball);

private:
  std::mt19937 Generator;
};

/** The shape plus noise in [-amplitude, amplitude], drawn at the corners of cells and trilinear in
 * between, as in an image of this spacing. */
Shape MakeNoisy(const Shape& shape, double cell, double amplitude);
}

#endif

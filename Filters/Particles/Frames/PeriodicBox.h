// Copies of points in a periodic box.

#ifndef PeriodicBox_h
#define PeriodicBox_h

#include "Base/Walls.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

struct PeriodicBox : Periods
{
  // Distance from the box [length] within which a copy of a particle affects the surface in the
  // box: the ellipsoid of the copy may overlap the box, or the copy may change the ellipsoid and
  // the strength of a particle in the box.
  static double GetMargin(double kernelRadius) { return 3.2 * kernelRadius; }

  // Returns the shortest difference that equals `difference` modulo the length of the box.
  double Nearest(std::size_t axis, double difference) const
  {
    const double length = this->Length[axis];
    return length > 0.0 ? difference - length * std::round(difference / length) : difference;
  }

  // Moves a point to its copy within the box.
  void Wrap(double (&place)[3]) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double length = this->Length[axis];
      place[axis] -=
        length > 0.0 ? length * std::floor((place[axis] - this->Low[axis]) / length) : 0.0;
    }
  }
  bool Holds(const double (&place)[3]) const
  {
    double wrapped[3] = { place[0], place[1], place[2] };
    this->Wrap(wrapped);
    return std::equal(place, place + 3, wrapped);
  }

  // Returns the first and last offset, in lengths of the box, at which a copy of a particle is in
  // the box or its margin. Both offsets are 0 along an axis without period.
  std::array<int, 2> FindCopies(std::size_t axis, double x, double margin) const
  {
    const double length = this->Length[axis];
    if (!(length > 0.0))
    {
      return { 0, 0 };
    }
    const double low = (this->Low[axis] - margin - x) / length;
    const double high = (this->Low[axis] + length + margin - x) / length;
    const auto whole = [](double number)
    {
      constexpr double most = 1e9;
      return static_cast<int>(std::min(std::max(number, -most), most));
    };
    return { whole(std::ceil(low)), whole(std::floor(high)) };
  }
};

}

#endif

// A box of particles that goes on across its sides.

#ifndef PeriodicBox_h
#define PeriodicBox_h

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

struct PeriodicBox
{
  std::array<double, 3> Low = {};
  std::array<double, 3> Length = {}; // 0: not periodic along the axis
  double Margin = 0.0;               // around the box in which copies of particles count

  bool IsPeriodic() const
  {
    return std::any_of(
      this->Length.begin(), this->Length.end(), [](double length) { return length > 0.0; });
  }

  // The shortest of the differences that are the same but for whole lengths of the box.
  double Nearest(std::size_t axis, double difference) const
  {
    const double length = this->Length[axis];
    return length > 0.0 ? difference - length * std::round(difference / length) : difference;
  }

  // The coordinate within the box.
  double Wrap(std::size_t axis, double x) const
  {
    const double length = this->Length[axis];
    return length > 0.0 ? x - length * std::floor((x - this->Low[axis]) / length) : x;
  }

  // The first and the last number of lengths by which a copy is in the box or its margin; the first
  // is larger if none is.
  std::array<int, 2> FindCopies(std::size_t axis, double x) const
  {
    const double length = this->Length[axis];
    if (!(length > 0.0))
    {
      return { 0, 0 };
    }
    const double low = (this->Low[axis] - this->Margin - x) / length;
    const double high = (this->Low[axis] + length + this->Margin - x) / length;
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

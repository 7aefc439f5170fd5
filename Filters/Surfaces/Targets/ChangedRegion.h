// Where something has changed: a set of boxes, of which is asked whether another box touches one.
// The answer errs on the safe side: boxes are kept as cells of a lattice.

#ifndef ChangedRegion_h
#define ChangedRegion_h

#include <array>
#include <vector>

namespace activesurface
{

class ChangedRegion
{
public:
  using Box = std::array<double, 6>; // xmin xmax ymin ymax zmin zmax

  // Only what these boxes touch has changed. They have to be finite.
  void Set(const std::vector<Box>& boxes);

  // All of space has.
  void SetEverywhere();

  bool Touches(const double bounds[6]) const;

private:
  // The cells that a box touches, if it touches Bounds: first and last along each axis.
  std::array<int, 6> FindCells(const double bounds[6]) const;

  bool IsEverywhere = true;
  std::array<int, 3> Side{}; // cells along each axis; 0: nothing has changed
  Box Bounds{};
  std::vector<char> Cells;
};

}

#endif

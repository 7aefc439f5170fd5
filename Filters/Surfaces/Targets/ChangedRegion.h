// Region in which something has changed: a set of boxes, with a test whether another box touches
// one. The test is conservative, as the boxes are stored as cells of a lattice.

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

  // Only the inside of these boxes has changed. They must be finite.
  void Set(const std::vector<Box>& boxes);

  // All of space has changed.
  void SetEverywhere();

  bool Touches(const double bounds[6]) const;

private:
  // Range of the cells that a box touches: first and last index along each axis. The box must touch
  // Bounds.
  std::array<int, 6> FindCells(const double bounds[6]) const;

  bool IsEverywhere = true;
  std::array<int, 3> Side{}; // cells along each axis; 0: nothing has changed
  Box Bounds{};
  std::vector<char> Cells;
};

}

#endif

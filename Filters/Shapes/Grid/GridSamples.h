// A function in space given by samples, which a vtkGridPotential evaluates.

#ifndef GridSamples_h
#define GridSamples_h

#include "Grid/SurfaceSample.h"
#include "vtkActiveShapesModule.h"

namespace activesurface
{

struct LatticeShape;

// Immutable and thread-safe. Evaluation allocates no memory.
class VTKACTIVESHAPES_EXPORT GridSamples
{
public:
  virtual ~GridSamples() = default;

  // Returns the value, negative inside; NaN if x is not finite, or in a cell with a sample of value
  // NaN. gradient: three numbers, or null.
  virtual double Evaluate(const double x[3], double* gradient) const = 0;

  // Finds a box outside which the function is not negative. For a level set, finds the box of the
  // active voxels: outside, the function may be negative within a voxel of this box, or everywhere
  // if the background is inside. Caps across the holes of several open bodies may extend beyond the
  // box of a mesh. Returns false, without setting `bounds`, if there is no box.
  virtual bool GetBounds(double bounds[6]) const = 0;

  // Finds the region below a level, on the lattice of the samples. Returns false if the region is
  // unavailable or unbounded.
  virtual bool FindShape(double level, LatticeShape& shape) const
  {
    static_cast<void>(level);
    static_cast<void>(shape);
    return false;
  }

  // Samples the surface; returns an empty sample if unavailable.
  virtual SurfaceSample SampleSurface() const { return {}; }

protected:
  GridSamples() = default;

private:
  GridSamples(const GridSamples&) = delete;
  void operator=(const GridSamples&) = delete;
};

}

#endif

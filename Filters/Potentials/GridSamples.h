// A function of space known by samples: what a vtkGridPotential evaluates.

#ifndef GridSamples_h
#define GridSamples_h

#include "SurfaceSample.h"
#include "vtkActivePotentialsModule.h"

namespace activesurface
{

struct LatticeShape;

// Immutable. Any of the methods may be called by several threads at once; evaluation allocates
// nothing.
class VTKACTIVEPOTENTIALS_EXPORT GridSamples
{
public:
  virtual ~GridSamples() = default;

  // Negative inside; gradient: three numbers, or null. NaN where x is not finite.
  virtual double Evaluate(const double x[3], double* gradient) const = 0;

  // Box outside which it is not negative; false, and untouched, where it never is.
  virtual bool GetBounds(double bounds[6]) const = 0;

  // What is below a level, on the lattice of the samples; false if that is not known, or has no
  // end.
  virtual bool FindShape(double level, LatticeShape& shape) const
  {
    static_cast<void>(level);
    static_cast<void>(shape);
    return false;
  }

  // Points of its surface; none where they are not known.
  virtual SurfaceSample SampleSurface() const { return {}; }

protected:
  GridSamples() = default;

private:
  GridSamples(const GridSamples&) = delete;
  void operator=(const GridSamples&) = delete;
};

}

#endif

/**
 * Measures area and volume of the skin from its triangles (paper, sections 5.1 and 5.2).
 */
#ifndef SkinMeasure_h
#define SkinMeasure_h

#include "Leaves/LeafTable.h"

#include <cmath>

namespace activesurface
{

struct SkinMeasure
{
  double Area = 0.0;
  double Volume = 0.0; //< enclosed, without the voids
};

/** Gain of a sphere's area per outward displacement: dA/dr = sqrt(16 pi A). */
inline double AreaGainOfSphere(double area)
{
  constexpr double pi = 3.14159265358979323846;
  return std::sqrt(16.0 * pi * area);
}

/** Measures in voxels. Leaves are summed in the order of the tree, so the result does not depend
 * on the number of threads. */
SkinMeasure MeasureSkin(const LeafTable& table);

}

#endif

/**
 * Measures area and volume of the skin from its triangles (sections 5.1 and 5.2 of the paper, see
 * NarrowBand.h).
 */
#ifndef SkinMeasure_h
#define SkinMeasure_h

#include "Base/FixedSum.h"
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

/** Sums over leaves, independent of the order [voxels^2, voxels^3]. */
struct SkinSums
{
  FixedSum Area, Volume;

  void Add(const SkinSums& other)
  {
    this->Area.Add(other.Area);
    this->Volume.Add(other.Volume);
  }
  SkinMeasure Get() const { return { this->Area.Get(), this->Volume.Get() }; }
};

/** Sums over the leaves of this rank. The volume is valid only as a total over all ranks, because
 * only the whole surface is closed. */
SkinSums SumSkin(const LeafTable& table);

/** Measures [voxels^2, voxels^3] of a band that this rank owns entirely. */
inline SkinMeasure MeasureSkin(const LeafTable& table)
{
  return SumSkin(table).Get();
}

}

#endif

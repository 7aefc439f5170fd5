/**
 * Area and volume of the skin, from its triangles (paper, sections 5.1 and 5.2).
 */
#ifndef SkinMeasure_h
#define SkinMeasure_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

struct SkinMeasure
{
  double Area = 0.0;
  double Volume = 0.0; //< that of the voids is taken off
};

/** In voxels. Summed leaf by leaf in the order of the tree, so that the number of threads leaves no
 * trace. */
SkinMeasure MeasureSkin(const LeafTable& table);

}

#endif

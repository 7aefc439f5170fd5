/**
 * The state of a surface at a time step, from which a motion can resume. SavedGrid.h converts this
 * state to a grid for files.
 */
#ifndef SavedState_h
#define SavedState_h

#include "HistoryRow.h"

#include <array>
#include <memory>
#include <vector>

namespace activesurface
{

class NarrowBand;

struct SavedState
{
  std::shared_ptr<const NarrowBand> Band;
  std::array<double, 3> Origin = {}; //< world position of the band's node (0, 0, 0)
  double Time = 0.0;                 //< pipeline time of the time step
  std::vector<HistoryRow> History;   //< up to Time
  double Spacing = 0.0;              //< particle spacing in use [length]; 0: unknown
  double Bounds[6] = {};             //< of the lattice's domain, relative to Origin
  double Reach = 0.0;                //< reach of the target [length]; 0: the state has no domain
};

}

#endif

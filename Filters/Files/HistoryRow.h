/**
 * Measures of a surface at a time step, and of the motion since the previous time step.
 */
#ifndef HistoryRow_h
#define HistoryRow_h

#include <cstddef>
#include <string>

namespace activesurface
{

struct HistoryRow
{
  double Time = 0.0;        //< pipeline time
  std::size_t Substeps = 0; //< since the previous row
  double MaxSpeed = 0.0;    //< largest speed of attraction [length/time], explicit substeps
  double Area = 0.0;        //< of the skin [length^2]
  double Volume = 0.0;      //< of the skin [length^3]
  std::size_t ActiveVoxels = 0;
  int Components = 0;
  int Voids = 0;
  long long EulerCharacteristic = 0;
  double Outside = 0.0; //< fraction of the target outside the skin, in [0,1]; NaN: unavailable
  std::string Event;
};

}

#endif

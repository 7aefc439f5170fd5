/**
 * What has become of a surface since the time step before.
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
  std::size_t Substeps = 0; //< since the row before, as MaxSpeed
  double MaxSpeed = 0.0;    //< largest speed of attraction
  double Area = 0.0;        //< of the skin, as the rest
  double Volume = 0.0;
  std::size_t ActiveVoxels = 0;
  int Components = 0;
  int Voids = 0;
  long long EulerCharacteristic = 0;
  double Outside = 0.0; //< share of the target outside the skin, in [0,1]; NaN: not known
  std::string Event;
};

}

#endif

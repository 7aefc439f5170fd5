// What has become of a surface, step by step.

#ifndef SurfaceHistory_h
#define SurfaceHistory_h

#include <cstddef>
#include <string>
#include <vector>

class vtkTable;

namespace activesurface
{

class NarrowBand;

struct HistoryRow
{
  double Time = 0.0;        // pipeline time
  std::size_t Substeps = 0; // since the row before, as MaxSpeed
  double MaxSpeed = 0.0;    // largest speed of attraction
  double Area = 0.0;        // of the skin, as the rest
  double Volume = 0.0;
  std::size_t ActiveVoxels = 0;
  int Components = 0;
  int Voids = 0;
  long long EulerCharacteristic = 0;
  std::string Event;
};

// Of a surface that has just arrived at a time; its work is that since the row before.
HistoryRow MakeHistoryRow(const NarrowBand& band, double time, const std::string& event);

// One row each, one column for each member, by its name.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif

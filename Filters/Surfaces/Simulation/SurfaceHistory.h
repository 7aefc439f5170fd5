// What has become of a surface, step by step.

#ifndef SurfaceHistory_h
#define SurfaceHistory_h

#include "SkinParts.h"

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

// Makes the rows of a surface on its way. It remembers the parts of the skin at the row before, to
// tell what has happened to them.
class HistoryWriter
{
public:
  // Of a surface that has just arrived at a time; its work is that since the row before.
  HistoryRow MakeRow(const NarrowBand& band, double time);

  // The surface is at another place: this is the one of the row before, from now on.
  void Restart(const NarrowBand& band);

private:
  std::vector<SkinPart> Parts;
  bool HasParts = false;
};

// One row each, one column for each member, by its name.
void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table);

}

#endif

// The elements near a place, for elements that move from one build to the next.

#ifndef ElementIndex_h
#define ElementIndex_h

#include "SkeletonCells.h"
#include "vtkActivePotentialsModule.h"

#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT ElementIndex
{
public:
  // Throws as SkeletonCells does. Elements that move by little between two builds keep their cells,
  // which then list them with a margin: what is out of reach is listed too, and has to add nothing.
  // bounds contain all capsules.
  void Build(const std::vector<Capsule>& capsules, const double bounds[6]);

  const SkeletonCells& GetCells() const { return this->Cells; }

private:
  bool Includes(const std::vector<Capsule>& capsules) const;

  std::vector<Capsule> Listed; // what the cells were built for
  SkeletonCells Cells;
};

}

#endif

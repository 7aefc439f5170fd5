// Elements by their supports, and the cells in which those near a place are looked up; for elements
// that move from one build to the next.

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
  // Forgets the elements, keeps the memory.
  void Clear() { this->Supports.clear(); }

  // Numbers are finite, radii > 0.
  void AddBall(const double centre[3], double radius);
  void Add(const Capsule& support);

  // Comes after the last element and before the first use of the cells. Throws as SkeletonCells
  // does. Elements that move by little between two builds keep their cells, which then list them
  // with a margin: what is out of reach is listed too, and has to add nothing.
  void Build();

  std::size_t Size() const { return this->Supports.size(); }
  const Capsule& operator[](std::size_t i) const { return this->Supports[i]; }

  // The box of all supports: xmin xmax ymin ... Meaningless without elements.
  const double* GetBounds() const { return this->Bounds; }

  const SkeletonCells& GetCells() const { return this->Cells; }

private:
  bool AreListed() const;

  std::vector<Capsule> Supports;
  double Bounds[6];
  std::vector<Capsule> Listed; // what the cells were built for
  SkeletonCells Cells;
};

}

#endif

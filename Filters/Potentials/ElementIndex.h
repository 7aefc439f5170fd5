// Stores the supports of elements and the cells that find the elements near a point. Elements may
// move between builds.

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
  // Removes the elements; keeps allocated memory.
  void Clear() { this->Supports.clear(); }

  // Numbers have to be finite, and radii > 0.
  void AddBall(const double centre[3], double radius);
  void Add(const Capsule& support);

  // Builds the cells, after the last element and before the first use. Throws as SkeletonCells
  // does. Elements that move little between two builds keep their cells, which list them with a
  // margin. Elements out of reach are then listed, too, and have to add nothing.
  void Build();

  std::size_t Size() const { return this->Supports.size(); }
  const Capsule& operator[](std::size_t i) const { return this->Supports[i]; }

  // Bounding box of all supports: xmin xmax ymin ... Undefined without elements.
  const double* GetBounds() const { return this->Bounds; }

  const SkeletonCells& GetCells() const { return this->Cells; }

private:
  bool AreListed() const;

  std::vector<Capsule> Supports;
  double Bounds[6];
  std::vector<Capsule> Listed; // supports from which the cells were built
  SkeletonCells Cells;
};

}

#endif

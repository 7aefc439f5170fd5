// Which places are near some others: by cells, so that a few more are.

#ifndef NearCells_h
#define NearCells_h

#include "BlockTable.h"

namespace activesurface
{

class NearCells
{
public:
  explicit NearCells(double cellSize)
    : InverseSize(1.0 / cellSize)
  {
    this->Cells.Clear();
  }

  // The cell of a place (x y z, finite).
  void Add(const double x[3]) { this->Cells.Add(this->GetCell(x)); }

  // By all cells within so many of those that are there: places that are less than as many cell
  // sizes from the ones before are in them.
  void Widen(int cells);

  // Several threads may call it at once.
  bool Has(const double x[3]) const
  {
    return this->Cells.Find(this->GetCell(x)) != BlockTable::None;
  }

private:
  BlockTable::Block GetCell(const double x[3]) const;

  double InverseSize;
  BlockTable Cells;
};

}

#endif

// The skin of a surface as an implicit function for others.

#ifndef SkinFunction_h
#define SkinFunction_h

#include "vtkSmartPointer.h"

#include <array>
#include <memory>

class vtkGridPotential;

namespace activesurface
{

class NarrowBand;
class SkinDistance;

class SkinFunction
{
public:
  SkinFunction();
  ~SkinFunction();

  // The same object always. The first time it is asked for it becomes that of this skin, later it
  // is that of the skin for which it was last renewed; null: outside everywhere. The band's
  // positions are relative to the origin.
  vtkGridPotential* Get(const NarrowBand* band, const std::array<double, 3>& origin);

  // Takes a snapshot, if anybody has asked for the function.
  void Renew(const NarrowBand* band, const std::array<double, 3>& origin);

private:
  vtkSmartPointer<vtkGridPotential> Function; // null until somebody asks for it
};

}

#endif

/**
 * Data of an input port that becomes a shape: the data set, its chosen arrays, and the particle
 * arrays to keep.
 */
#ifndef InputData_h
#define InputData_h

#include <string>

class vtkAbstractArray;
class vtkDataSet;

namespace activesurface
{

/**
 * Point arrays that the user has chosen, by purpose. Each function except FindValues returns null
 * if no array is chosen. All throw std::invalid_argument if the chosen array is missing.
 */
class ChosenArrays
{
public:
  virtual ~ChosenArrays() = default;

  virtual vtkAbstractArray* FindRadii() const = 0;
  virtual vtkAbstractArray* FindIds() const = 0;
  virtual vtkAbstractArray* FindStrengths() const = 0;
  virtual vtkAbstractArray* FindVelocities() const = 0;

  /**
   * Returns the chosen values of an image or, if none are chosen, its active scalars. Without
   * scalars, returns null for an image with an attached grid, and throws for any other image.
   */
  virtual vtkAbstractArray* FindValues() const = 0;
};

/** Arrays of particles to keep besides radii, ids and strengths. */
struct ParticleArrays
{
  bool All = false;       //< copies of all arrays, for the skin
  std::string Velocities; //< description of the chosen array; empty: no velocities

  bool operator==(const ParticleArrays& other) const
  {
    return this->All == other.All && this->Velocities == other.Velocities;
  }
};

struct InputData
{
  vtkDataSet* Data;
  const ChosenArrays& Chosen;
  const ParticleArrays& Kept;
};

}

#endif
